// What the rules of a mesh pass leave, measured on a sample of the elements of a large mesh.
#pragma once

#include <span>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// l2 over the degrees, scaled lengths.
struct SampledRules {
  double error = 0;  // 1 <= l <= L
  double band = 0;   // l > 3L/4
  double doubt = 0;  // with twice its standard deviation `error` is at most that much larger
  double share = 0;  // of the faces
};

// Chosen: of 600 000 to 3 million triangles; at least 3072, at most 16 384.
inline constexpr double kSampleShare = 0.005;

// Of runs of triangles from all over the mesh, about `share` of it, with their edges: their sources
// as the plan has them minus those of much finer rules, transformed. The mesh is that of a pass
// that was done, whose `block_errors` say where the runs lie. With a share of 1 all is taken, and
// the error is exact.
SampledRules sample_rules(const MeshView& mesh, const MeshPassOptions& options,
                          const MeshPlan& plan, std::span<const float> block_errors,
                          const Context& context, double share = kSampleShare);

}  // namespace rholm
