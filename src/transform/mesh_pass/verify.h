// Measures the error of a mesh pass: the mesh is read a second time, finer and rotated.
#pragma once

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// `result` is from mesh_pass() with the same arguments, for a closed mesh. Measures its error if
// the mesh has at most kMostVerified faces, in this process alone. If the error is above the
// precision, finer coefficients with a measured error replace it. Throws like mesh_pass().
void verify_pass(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                 MeshPassResult& result);

}  // namespace rholm
