// The error of a mesh pass, measured: the mesh is read a second time, finer and from another side.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// Chosen: meshes of more triangles are not read a second time, and keep the error of the model.
inline constexpr std::size_t kMostVerified = 100'000;

// `result`: of mesh_pass() with the same arguments, for a closed mesh. Measures its error if the
// mesh has at most kMostVerified triangles, by this process alone; where that is above the wish,
// finer coefficients with a measured error take their place. Throws as mesh_pass() does.
void verify_pass(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                 MeshPassResult& result);

}  // namespace rholm
