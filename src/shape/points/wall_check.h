// Whether points lie on a surface that was made of them. Layer: shape.
//
// Some points are chosen by their coordinates, each with a patch of points around it. The scatter
// of a patch is the root mean square of the distances of its points from the surface. Where the
// opposite wall of the surface is nearer than 5.5 scatters, points lie all through the body between
// the walls: they fill it, or their noise hides how thick it is. Points that fill a shell around
// the surface are told by their kurtosis: they are spread evenly, while noise is densest at the
// surface. Patches of both kinds are off the surface.
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

// Points of a patch, with the chosen one, which comes first.
inline constexpr std::size_t kPatch = 32;

struct WallPatches {
  std::vector<Vec3> points = {};   // kPatch for each patch
  std::vector<double> areas = {};  // that one point stands for, as if the patch were flat

  std::size_t size() const { return areas.size(); }
  std::span<const Vec3> operator[](std::size_t p) const {
    return std::span(points).subspan(p * kPatch, kPatch);
  }
  // Every k-th patch.
  WallPatches every(std::size_t k) const;
};

// Patches of some of n points in all. Points are in the order of the tree; those that are
// `foreign`, if there are any, are not chosen. Patches are taken from the `around` nearest
// neighbours, of which there are enough for a flat neighbourhood.
WallPatches choose_patches(const PointTree& tree, std::span<const Vec3> points,
                           std::span<const std::uint8_t> foreign, std::size_t n, std::size_t around,
                           const Context& context);

// A vertex of a surface, with its unit normal.
struct WallVertex {
  Vec3 at, normal;
};
// Of the first n vertices of a mesh with normals nx, ny, nz, those that check_walls() may ask for:
// all within reach of a patch, and some others. `step` is the length of the mesh's edges.
std::vector<WallVertex> vertices_near(const WallPatches& patches, double step, Mesh& mesh,
                                      std::size_t n);

// Places that are named.
inline constexpr std::size_t kNamedWalls = 3;

struct WallCheck {
  std::size_t patches = 0, off = 0;
  // Chosen points of patches off the surface: the first min(off, kNamedWalls) count.
  std::array<Vec3, kNamedWalls> at = {};

  double share() const {
    return patches == 0 ? 0 : static_cast<double>(off) / static_cast<double>(patches);
  }
};
WallCheck check_walls(const WallPatches& patches, std::span<const WallVertex> vertices, double step,
                      const Context& context);
// Of a whole mesh: of every third patch, and of all only where more than a few of these are off.
WallCheck check_walls(const WallPatches& patches, Mesh& mesh, double step, const Context& context);

}  // namespace rholm
