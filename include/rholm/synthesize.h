// From coefficients to surfaces. Layer: surface.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// The surface x = center + r(u) u of the expansion cut off at each of `degrees`, on the vertices of
// `sphere` (unit vectors; icosphere(), latitude_longitude_sphere(), or directions_of()), with
// its connectivity; one mesh per degree, in the order given. Each has the exact unit normals
// of the harmonic surface as attributes nx, ny, nz. Degrees above the expansion's are cut to it.
// A truncated series may cross the centre: r <= 0 is kept as it is for a radius; for a gauge
// q <= 0 has no surface and throws InvalidInput with the direction.
std::vector<Mesh> synthesize(const Expansion& expansion, const Mesh& sphere,
                             std::span<const int> degrees, const Context& context = {});
Mesh synthesize(const Expansion& expansion, const Mesh& sphere, const Context& context = {});

// The directions of a shape's vertices from `center`, with its connectivity. Throws InvalidInput if
// a vertex lies on the centre.
Mesh directions_of(const Mesh& mesh, const Vec3& center);

// Of the solid bounded by the surface of an expansion, in its unit. All are empty for a signed sum
// (Expansion::signed_sum), whose graph bounds another solid than the body.
struct SurfaceMeasures {
  std::optional<double> volume;  // cubed
  std::optional<double> area;    // squared; of the surface
  std::optional<Vec3> centroid;  // of the solid, in the coordinates of the shape

  // The area of the ball of the same volume over the area, at most 1 (Wadell 1935); 0 for a solid
  // without volume, empty where volume or area is.
  std::optional<double> sphericity() const;
};
// By quadrature on a grid: exact for volume and centroid of a radius, converged to about 1e-12 for
// area (smooth, star-shaped).
SurfaceMeasures measure(const Expansion& expansion, const Context& context = {});

// The tensor of inertia of that solid about its centroid, of density 1, in the fifth power of the
// unit: the rows of int (|x - c|^2 1 - (x - c)(x - c)^T) dV, a symmetric matrix whose eigenvectors
// are the axes of inertia, that of the smallest value the longest. Exact for a radius. Throws
// Unsupported for what is no surface and for a signed sum, InvalidInput where there is no volume or
// the power overflows.
std::array<Vec3, 3> inertia(const Expansion& expansion, const Context& context = {});

}  // namespace rholm
