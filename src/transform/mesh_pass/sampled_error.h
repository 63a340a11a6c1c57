// Measures the errors of the rules and the windows of a mesh pass, on a sample of a large mesh.
#pragma once

#include <span>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// l2 norms over the degrees, in scaled lengths.
struct SampledError {
  double rules = 0;    // error of rules, 1 <= l <= L
  double band = 0;     // error of rules for l > 3L/4
  double doubt = 0;    // with twice its standard deviation `rules` is at most this much larger
  double windows = 0;  // error of windows beyond the error of random sources
  double share = 0;    // part of the faces on which `rules` is measured
};

// Part of the faces that is sampled, chosen for 1.6 to 2 million faces; see RunCount.
inline constexpr double kSampleShare = 0.005;

// Takes runs of faces from all over the mesh, about `share` of it, with their edges and vertices.
// Measures their sources by the plan's rules minus their sources by much finer rules. Measures also
// their sources by the windows of `transform` minus those by much finer windows. It does so at
// degrees where this costs less than a tenth of the pass, or always with a share of 1. The mesh has
// been passed; `block_errors` of the pass decide where the runs are. With a share of 1 all is
// taken, and `rules` and `windows` are the norms of the whole errors.
SampledError sample_error(const MeshView& mesh, const MeshPassOptions& options,
                          const MeshPlan& plan, const NonuniformPlan& transform,
                          std::span<const float> block_errors, const Context& context,
                          double share = kSampleShare);

}  // namespace rholm
