// Points of a mesh at which the error of an expansion is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

struct ErrorPoints {
  std::vector<Vec3> directions;
  std::vector<double> radii;
  // cos gamma of the face a point lies on; 0 at vertices, which have none.
  std::vector<double> cosines;
  // Its face t, or -1 - i for vertex i; empty where nobody asks.
  std::vector<std::int64_t> owners;

  std::size_t size() const { return directions.size(); }
  void reserve(std::size_t n);
  ErrorPoints subset(const std::vector<std::size_t>& indices) const;
  ErrorPoints first(std::size_t n) const;
  void append(const ErrorPoints& more);
};

// Where the largest errors of degree L are: all vertices and, where faces are long against 1/L, up
// to 7 points more on each.
ErrorPoints extreme_points(const MeshView& mesh, const Vec3& center, int degree);

// About n points, evenly over the area: one in each of n equal parts of it, in the order of the
// faces.
ErrorPoints area_points(const MeshView& mesh, const Vec3& center, std::size_t n);

struct PointErrors {
  std::vector<double> radial;  // |r - r_L|
  // Distances: from the shape to the model, and from the model (on the same ray) to the shape.
  std::vector<double> to_model, to_shape;
  // Area of the model per area of the shape.
  std::vector<double> stretch;
};
// Of the first L degrees. `slopes`: distances as well. `precision` as in SumOptions.
PointErrors point_errors(const ErrorPoints& points, const Expansion& expansion, int degree,
                         bool slopes, double precision, const Context& context);

double largest(const std::vector<double>& values);
// The indices of at most n values, of those that are at least half of the largest: the largest
// first, ties by index.
std::vector<std::size_t> indices_of_largest(const std::vector<double>& values, std::size_t n);
// Root mean squares over area points, which are those from `first` on.
double rms_over_solid_angle(const ErrorPoints& points, const PointErrors& errors,
                            std::size_t first);
double rms_distance(const PointErrors& errors, std::size_t first);  // the larger of both ways

}  // namespace rholm
