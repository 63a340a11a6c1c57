// Test shapes with known properties. Layer: shape.
//
// All shapes are closed, oriented outwards and without seams. They throw InvalidInput, with the
// value and the limit, for sizes out of range.
#pragma once

#include <cstdint>

#include "rholm/mesh.h"

namespace rholm {

// Largest number of vertices of a latitude-longitude sphere or a torus. Chosen: the vertices take 6
// GB, and the edges of twice as many triangles can still be numbered.
inline constexpr long long kMaxGridVertices = 1LL << 28;

// Returns the unit icosahedron with each edge halved `subdivisions` times and vertices on the
// sphere: 20 * 4^n triangles, 10 * 4^n + 2 vertices. 0 <= subdivisions <= 12.
Mesh icosphere(int subdivisions);

// Returns a unit sphere with n_theta >= 1 rings of n_phi >= 3 vertices, ring i at colatitude pi (i
// + 1/2) / n_theta, and a vertex at each pole. The n_theta n_phi + 2 vertices are in the order
// north pole, rings from the north, south pole.
Mesh latitude_longitude_sphere(int n_theta, int n_phi);

// Returns an ellipsoid with semi-axes (a, b, c) along x, y, z: a mapped icosphere.
Mesh ellipsoid(const Vec3& semi_axes, int subdivisions);

// Returns a box with the given edge lengths, centred at the origin. Each side is a grid of n x n
// squares of two triangles.
Mesh box(const Vec3& size, int n = 1);

// Returns a torus about the z axis, 0 < tube_radius < ring_radius (the radius of the centre line).
Mesh torus(double ring_radius, double tube_radius, int n_ring, int n_tube);

// Returns a star-shaped test body: r(u) = 1 + amplitude * waves(u) on an icosphere. The waves have
// directions chosen by `seed`; their smooth sum is at most 1 in modulus. 0 <= amplitude < 1.
Mesh bumpy_sphere(int subdivisions, double amplitude = 0.2, std::uint64_t seed = 1);

}  // namespace rholm
