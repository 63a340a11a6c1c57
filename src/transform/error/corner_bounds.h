// Bounds how far the radial error of a face exceeds the error at its corners, in an inner loop.
#pragma once

#include <cstddef>

#include "rholm/mesh_view.h"
#include "rholm/vec3.h"

namespace rholm {

// Where the error is largest within a face or an edge, its slope is zero. On the way to the nearest
// corner it falls by at most s^2/2 times the second derivative. Sets this bound for the faces begin
// ... end - 1, lengths times `scale`; `model_bend` bounds the second derivatives of the model.
// Bounds are infinite for faces that are long, seen edge-on or without area. Throws InvalidInput
// for an index out of range.
void corner_bounds(const MeshView& mesh, std::size_t begin, std::size_t end, const Vec3& center,
                   double scale, double model_bend, double* bounds);

}  // namespace rholm
