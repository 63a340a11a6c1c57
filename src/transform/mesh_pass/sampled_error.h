// What the rules and the windows of a mesh pass leave, measured on a sample of a large mesh.
#pragma once

#include <span>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// l2 over the degrees, scaled lengths.
struct SampledError {
  double rules = 0;    // what rules leave, 1 <= l <= L
  double band = 0;     // and for l > 3L/4
  double doubt = 0;    // with twice its standard deviation `rules` is at most that much larger
  double windows = 0;  // what windows leave more than their errors of sources that are random
  double share = 0;    // of the faces that `rules` are measured on
};

// Chosen: of 1.6 to 2 million triangles; see RunCount.
inline constexpr double kSampleShare = 0.005;

// Of runs of triangles from all over the mesh, about `share` of it, with their edges and vertices:
// their sources as the plan has them minus those of much finer rules; and their sources by the
// windows of `transform` minus the same by much finer ones, at degrees where that costs less than a
// tenth of the pass, or at all with a share of 1. The mesh is that of a pass that was done, whose
// `block_errors` say where the runs lie. With a share of 1 all is taken, and `rules` and `windows`
// are the norms of the whole errors of both.
SampledError sample_error(const MeshView& mesh, const MeshPassOptions& options,
                          const MeshPlan& plan, const NonuniformPlan& transform,
                          std::span<const float> block_errors, const Context& context,
                          double share = kSampleShare);

}  // namespace rholm
