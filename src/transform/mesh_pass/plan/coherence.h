// How far the errors of lumping cancel between neighbours.
//
// What a rule leaves on one edge or face is known (plane_wave_rules.h), and on rough surfaces these
// errors add up like random numbers. On smooth ones those of neighbours are alike and cancel in the
// sum with a wave: by a factor of hundreds on fine meshes. That is measured: for a few wave packets
//   exp(-|x|^2 / 2 s^2) exp(i L k . u),
// u the direction, k a unit vector at right angles to the packet's middle, the error of lumping is
// summed over all triangles that a packet covers.
#pragma once

#include "rholm/mesh_view.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// |sum of errors|^2 over the packets / sum over their triangles of what (F z^4)^2 of each predicts
// on its own: the energy of the whole error in units of that of the faces. Infinity if nobody can
// tell: few triangles in a packet, or neighbours far apart in the file. What is far above the
// limit is measured on fewer packets.
double error_coherence(const MeshView& mesh, const Vec3& center, double scale, int degree,
                       double limit);

}  // namespace rholm
