// Makes one pass through the faces of a mesh, with a given plan.
#pragma once

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/pass_result.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// Throws like mesh_pass(). The result is complete only for Outcome::kDone, except for the number of
// passes and the flag that the precision was reached.
Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result);

}  // namespace rholm
