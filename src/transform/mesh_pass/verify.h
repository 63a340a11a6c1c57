// The error of a mesh pass, measured: the mesh is read a second time, finer and from another side.
#pragma once

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// `result`: of mesh_pass() with the same arguments, for a closed mesh. Measures its error if the
// mesh has at most kMostVerified triangles, by this process alone; where that is above the wish,
// finer coefficients with a measured error take their place. Throws as mesh_pass() does.
void verify_pass(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                 MeshPassResult& result);

}  // namespace rholm
