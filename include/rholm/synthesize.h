// Surfaces from coefficients. Layer: surface.
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

// Returns the surface x = center + r(u) u of the expansion truncated at each of `degrees`, one mesh
// per degree. Vertices and connectivity are taken from `sphere`, which holds unit vectors:
// icosphere(), latitude_longitude_sphere(), or directions_of(). Attributes nx, ny, nz are the exact
// unit normals of the harmonic surface. Degrees above the expansion's are reduced to it. A
// truncated series may cross the centre: r <= 0 is kept for a radius, but q <= 0 of a gauge throws
// InvalidInput with the direction.
std::vector<Mesh> synthesize(const Expansion& expansion, const Mesh& sphere,
                             std::span<const int> degrees, const Context& context = {});
Mesh synthesize(const Expansion& expansion, const Mesh& sphere, const Context& context = {});

// Returns the directions of a shape's vertices from `center`, with its connectivity. Throws
// InvalidInput if a vertex lies on the centre.
Mesh directions_of(const Mesh& mesh, const Vec3& center);

// Measures of the solid bounded by the surface of an expansion, in its unit. All are empty for a
// signed sum (Expansion::signed_sum), whose graph bounds another solid than the body.
struct SurfaceMeasures {
  std::optional<double> volume;  // volume in the cubed unit
  std::optional<double> area;    // area of the surface, in the squared unit
  std::optional<Vec3> centroid;  // centroid of the solid, in the coordinates of the shape

  // Returns the area of the ball of equal volume divided by the area, at most 1 (Wadell 1935). 0
  // for a solid without volume, empty if volume or area is empty.
  std::optional<double> sphericity() const;
};
// Measures by quadrature on a grid: exact for volume and centroid of a radius, converged to about
// 1e-12 for area (smooth, star-shaped).
SurfaceMeasures measure(const Expansion& expansion, const Context& context = {});

// Returns the tensor of inertia of the solid of density 1 about its centroid, in the fifth power of
// the unit. The result holds the rows of int (|x - c|^2 1 - (x - c)(x - c)^T) dV. Its eigenvectors
// are the axes of inertia; the smallest eigenvalue belongs to the longest axis. Exact for a radius.
// Throws Unsupported for a signed sum or coefficients without a surface, InvalidInput for a solid
// without volume or overflow.
std::array<Vec3, 3> inertia(const Expansion& expansion, const Context& context = {});

}  // namespace rholm
