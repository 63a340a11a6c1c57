// Computes coefficients of the radius from a mesh in place: (M8), lumped vertices, fast sums.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/pass_result.h"

namespace rholm {

// Chosen: for closed meshes of up to this many faces, a second reading measures the error
// (verify.h). For larger meshes mesh_pass() itself does, on a sample (sampled_error.h).
inline constexpr std::size_t kMostVerified = 100'000;

// Throws InvalidInput for coordinates that are not finite, indices out of range, a `check` that
// fails, and a surface through the centre. Throws Cancelled.
MeshPassResult mesh_pass(const MeshView& mesh, const MeshPassOptions& options,
                         const Context& caller);

}  // namespace rholm
