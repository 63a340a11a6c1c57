// One way through the triangles of a mesh, with a given plan.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

enum class Outcome {
  kDone,
  kOutOfRange,   // a vertex has left the range of its integers: double precision is needed
  kTooManyNodes  // to be kept until their number is known
};
// Throws as mesh_pass() does. The result is complete only if it is done, but for the number of
// passes and whether the precision was reached.
Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result);

// Throws InvalidInput if `options.check` says that these are no triangles.
void check_triangles(const MeshPassOptions& options, std::size_t first, std::size_t n);

}  // namespace rholm
