// Points of a mesh at which the error of an expansion is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/face_scan.h"
#include "transform/error/radial_model.h"

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
  void resize(std::size_t n);
  void add(const Vec3& direction, double radius, double cosine, std::int64_t owner);
  ErrorPoints subset(const std::vector<std::size_t>& indices) const;
  ErrorPoints first(std::size_t n) const;
  void append(const ErrorPoints& more);
};

// cos gamma at the point x of face t, which is from the centre and times scan.sizes.scale; none of
// a degenerate face, and at the centre.
std::optional<double> face_cosine(const MeshView& mesh, std::size_t t, const Vec3& center,
                                  const FaceScan& scan, const Vec3& x);
// Where the largest errors of degree L are: all vertices, and points on long faces.
ErrorPoints extreme_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan,
                           int degree);

// About n points, evenly over the area: one in each of n equal parts of it, in the order of the
// faces.
ErrorPoints area_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan,
                        std::size_t n, const Context& context = {});

struct PointErrors {
  std::vector<double> radial;  // |r - r_L|
  // Distances: from the shape to the model, and from the model (on the same ray) to the shape.
  std::vector<double> to_model, to_shape;
  // Area of the model per area of the shape.
  std::vector<double> stretch;

  PointErrors subset(const std::vector<std::size_t>& indices) const;
  void append(const PointErrors& more);
};
// Of the first L degrees. `slopes`: distances as well. `precision` as in SumOptions.
PointErrors point_errors(const ErrorPoints& points, const Expansion& expansion, int degree,
                         bool slopes, double precision, const Context& context);
PointErrors point_errors(const ErrorPoints& points, const RadialModel& model, bool slopes,
                         const Context& context);

double largest(const std::vector<double>& values);
// The indices of at most n values, of those that are at least half of the largest: the largest
// first, ties by index.
std::vector<std::size_t> indices_of_largest(const std::vector<double>& values, std::size_t n);
// Root mean squares over area points, which are those from `first` on.
double rms_over_solid_angle(const ErrorPoints& points, const PointErrors& errors,
                            std::size_t first);
double rms_distance(const PointErrors& errors, std::size_t first);  // the larger of both ways

}  // namespace rholm
