// Shapes with a known answer. Layer: shape.
//
// All are closed, outward oriented, without seams. Errors: InvalidInput for sizes out of range
// (a message with the value and the limit).
#pragma once

#include <cstdint>

#include "rholm/mesh.h"

namespace rholm {

// The most vertices of a latitude-longitude sphere or a torus. Chosen: they are 6 GB, and twice as
// many triangles still have edges that can be numbered.
inline constexpr long long kMaxGridVertices = 1LL << 28;

// The unit icosahedron with each edge halved `subdivisions` times and every vertex on the unit
// sphere: 20 * 4^n triangles, 10 * 4^n + 2 vertices. 0 <= subdivisions <= 12.
Mesh icosphere(int subdivisions);

// A unit sphere of n_theta rings of n_phi directions, ring i at colatitude
// pi (i + 1/2) / n_theta, and one vertex on each pole: vertices in the order north pole, rings
// from the north, south pole; n_theta n_phi + 2 in all. n_theta >= 1, n_phi >= 3.
Mesh latitude_longitude_sphere(int n_theta, int n_phi);

// Ellipsoid with semi-axes (a, b, c) along x, y, z: a mapped icosphere.
Mesh ellipsoid(const Vec3& semi_axes, int subdivisions);

// Box with the given edge lengths centred at the origin; each face is a grid of n x n squares of
// two triangles.
Mesh box(const Vec3& size, int n = 1);

// Torus about the z axis: radius of the centre line, radius of the tube (0 < tube < centre line).
Mesh torus(double ring_radius, double tube_radius, int n_ring, int n_tube);

// A star-shaped test body: r(u) = 1 + amplitude * (a smooth sum of waves with pseudo-random
// directions, at most 1 in modulus) on an icosphere. `seed` chooses the waves. 0 <= amplitude < 1.
Mesh bumpy_sphere(int subdivisions, double amplitude = 0.2, std::uint64_t seed = 1);

}  // namespace rholm
