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
  // cos gamma of the face on which a point lies; 0 at vertices, which have no face.
  std::vector<double> cosines;
  // Face t of the point, or -1 - i for vertex i; empty if it is not needed.
  std::vector<std::int64_t> owners;

  std::size_t size() const { return directions.size(); }
  void reserve(std::size_t n);
  void resize(std::size_t n);
  void add(const Vec3& direction, double radius, double cosine, std::int64_t owner);
  ErrorPoints subset(const std::vector<std::size_t>& indices) const;
  ErrorPoints first(std::size_t n) const;
  void append(const ErrorPoints& more);
};

// Returns cos gamma at the point x of face t; x is relative to the centre and times
// scan.sizes.scale. Returns nothing for a degenerate face, and at the centre.
std::optional<double> face_cosine(const MeshView& mesh, std::size_t t, const Vec3& center,
                                  const FaceScan& scan, const Vec3& x);
// Returns points with the largest errors of degree L: all vertices, and points on long faces.
ErrorPoints extreme_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan,
                           int degree);

// Returns about n points spread evenly over the area: one in each of n equal parts of the area, in
// the order of the faces.
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
// Computes errors of the first L degrees; `slopes`: distances, too. `precision`: see SumOptions.
PointErrors point_errors(const ErrorPoints& points, const Expansion& expansion, int degree,
                         bool slopes, double precision, const Context& context);
PointErrors point_errors(const ErrorPoints& points, const RadialModel& model, bool slopes,
                         const Context& context);

double largest(const std::vector<double>& values);
// Returns the indices of at most n values that are at least half of the largest one. The largest
// value comes first; equal values are in the order of indices.
std::vector<std::size_t> indices_of_largest(const std::vector<double>& values, std::size_t n);
// Return root mean squares over area points, which begin at index `first`.
double rms_over_solid_angle(const ErrorPoints& points, const PointErrors& errors,
                            std::size_t first);
double rms_distance(const PointErrors& errors, std::size_t first);  // the larger one of both ways

}  // namespace rholm
