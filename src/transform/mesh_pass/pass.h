// From a mesh where it lies to the coefficients of its radius: (M8), vertices lumped, fast sums.
#pragma once

#include <cstddef>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/pass_result.h"

namespace rholm {

// Chosen: the error of closed meshes of up to so many triangles is measured by a second reading
// (verify.h), that of larger ones by mesh_pass() itself, on a sample (sampled_error.h).
inline constexpr std::size_t kMostVerified = 100'000;

// Throws InvalidInput for coordinates that are not finite, indices out of range, `check` that
// fails, a surface through the centre; Cancelled.
MeshPassResult mesh_pass(const MeshView& mesh, const MeshPassOptions& options,
                         const Context& caller);

}  // namespace rholm
