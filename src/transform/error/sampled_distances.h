// Distances between a mesh and a model by the closest points of a sample, where faces are many:
// method 5.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"
#include "transform/error/radial_model.h"

namespace rholm {

// Points of a mesh and their errors to first order.
struct MeasuredPoints {
  const ErrorPoints& points;
  const PointErrors& errors;
};

struct SampledDistances {
  double rms = 0;        // over area, the larger of both ways
  double rms_error = 0;  // relative standard error that the sample leaves
  double ratio = 1;      // of the way to the model: rms by closest points over that to first order
  double max = 0;        // of both ways, at the worst points and at the model's on the same rays
  // Of the worst points: to the model, 0 where it is not among the largest.
  std::vector<double> to_model;

  // Faces are small, the sample is large enough, and the closest points of the model are those near
  // the rays.
  bool suffice(const MeshView& mesh) const;
};
// `over_area` is spread evenly over the area; `worst` are those of the largest errors, or none. The
// model is that of a mesh about its centre.
SampledDistances sampled_distances(const MeshView& mesh, const Vec3& center,
                                   const RadialModel& model, const MeasuredPoints& over_area,
                                   const MeasuredPoints& worst, const Context& context);

// From points of the mesh to the closest point of the model that steps from the ray lead to.
std::vector<double> distances_to_model(const RadialModel& model, const ErrorPoints& points);

}  // namespace rholm
