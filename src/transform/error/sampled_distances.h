// Distances between a mesh of many faces and a model,
// by the closest points of a sample: method 5.
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
  double rms = 0;        // over the area, the larger one of both ways
  double rms_error = 0;  // relative standard error of the rms from the sample
  double ratio = 1;      // mesh to model: rms by closest points over rms to first order
  double max = 0;        // of both ways, at the worst points and the model's points on their rays
  // For each of the worst points: its distance to the model, or 0 if it is not among the largest.
  std::vector<double> to_model;

  // Returns true if faces are small, the sample is large enough, and the closest points of the
  // model are near the rays.
  bool suffice(const MeshView& mesh) const;
};
// `over_area` are points spread evenly over the area; `worst` are points with the largest errors,
// or none. The model is of a mesh about its centre.
SampledDistances sampled_distances(const MeshView& mesh, const Vec3& center,
                                   const RadialModel& model, const MeasuredPoints& over_area,
                                   const MeasuredPoints& worst, const Context& context);

// Returns the distances of mesh points to the closest model points that steps from the rays find.
std::vector<double> distances_to_model(const RadialModel& model, const ErrorPoints& points);

}  // namespace rholm
