// Whether distances to first order can be believed: method 5.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"

namespace rholm {

// Faces so few and long that closest points rule whatever a sample says (chosen).
bool is_coarse(const MeshView& mesh);
// Whether closest points make sense: a model whose size compares with the mesh's, which is not too
// large for a tree of it in memory.
bool may_be_refined(const MeshView& mesh, const Expansion& expansion, double largest_radial_error,
                    double diagonal);

// So many points tell the ratio of root mean squares, and among so many of the worst is the
// farthest.
inline constexpr std::size_t kDistanceSample = 500, kMostWorstPoints = 2048;

// What distances to second order are of those to first order: by steps down from points of the
// mesh to the closest point of the model near the ray. Root mean square of five hundred of the
// points over the area, the larger of both ways, and the largest of all.
struct SecondOrder {
  double rms_ratio = 1, max_ratio = 1;

  // First order is within 2 % (rms) and 4 % (largest).
  bool first_order_holds() const;
  // The ratios say all: faces are small, and distances are not so far from first order that the
  // closest points of many lie elsewhere.
  bool suffices(const MeshView& mesh) const;
};
// `points` and their errors: those over the area are from `first` on.
SecondOrder second_order(const ErrorPoints& points, const PointErrors& errors, std::size_t first,
                         const RadialModel& model);

}  // namespace rholm
