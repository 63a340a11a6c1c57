// Checks whether points lie on the surface that was made from them. Layer: shape.
//
// Some points are chosen by their coordinates, each with a patch of points around it. The
// scatter of a patch is the rms distance of its points from the surface. If the opposite
// wall is nearer than 5.5 scatters, points fill the body between the walls, or noise hides
// its thickness. Points that fill a shell around the surface are recognised by their
// kurtosis: they are spread evenly, but noise is densest at the surface. Patches of both
// kinds are off the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Number of points of a patch, including the chosen point, which comes first.
inline constexpr std::size_t kPatch = 32;

struct WallPatches {
  std::vector<Vec3> points = {};   // kPatch for each patch
  std::vector<double> areas = {};  // area that one point of a flat patch stands for

  std::size_t size() const { return areas.size(); }
  std::span<const Vec3> operator[](std::size_t p) const {
    return std::span(points).subspan(p * kPatch, kPatch);
  }
  // Returns every k-th patch.
  WallPatches every(std::size_t k) const;
};

// Chooses patches of some of n points. Points are in the order of the tree; `foreign` (may be
// empty) flags points that are not chosen. A patch is spread over the `around` nearest neighbours,
// enough for a flat neighbourhood.
WallPatches choose_patches(const PointTree& tree, std::span<const Vec3> points,
                           std::span<const std::uint8_t> foreign, std::size_t n, std::size_t around,
                           const Context& context);

// A vertex of a surface, with its unit normal.
struct WallVertex {
  Vec3 at, normal;
};
// Returns the vertices that check_walls() may need: of the first n vertices of a mesh with normals
// nx, ny, nz, all within reach of a patch, and some others. `step`: edge length of the mesh.
std::vector<WallVertex> vertices_near(const WallPatches& patches, double step, Mesh& mesh,
                                      std::size_t n);

// Largest number of places reported by coordinates.
inline constexpr std::size_t kNamedWalls = 3;

struct WallCheck {
  std::size_t patches = 0, off = 0;
  // Chosen points of patches off the surface; the first min(off, kNamedWalls) are set.
  std::array<Vec3, kNamedWalls> at = {};

  double share() const {
    return patches == 0 ? 0 : static_cast<double>(off) / static_cast<double>(patches);
  }
};
WallCheck check_walls(const WallPatches& patches, std::span<const WallVertex> vertices, double step,
                      const Context& context);
// Checks every third patch of a whole mesh, and all patches if at least a fifth of these are off.
WallCheck check_walls(const WallPatches& patches, Mesh& mesh, double step, const Context& context);

}  // namespace rholm
