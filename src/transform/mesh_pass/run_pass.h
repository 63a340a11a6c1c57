// One way through the triangles of a mesh, with a given plan.
#pragma once

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/pass_result.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// Throws as mesh_pass() does. The result is complete only if it is done, but for the number of
// passes and whether the precision was reached.
Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result);

}  // namespace rholm
