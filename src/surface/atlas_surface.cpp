#include "surface/atlas_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rholm/error.h"
#include "surface/block_grid.h"
#include "surface/cap_field.h"
#include "surface/components.h"
#include "surface/extract.h"
#include "surface/hole_fill.h"
#include "surface/trim.h"
#include "transform/cap_pole.h"

namespace rholm {
namespace {

// Of a block: its values and tables, some 45 vertices with normals, 90 triangles, lists of caps
// (measured on closed bodies).
constexpr std::size_t kSurfaceOfBlock = 45 * 56 + 90 * 12 + 32 * 4;

std::size_t memory_of(std::size_t n_blocks) {
  return block_grid_bytes(n_blocks) + n_blocks * kSurfaceOfBlock;
}

std::size_t blocks_within(std::size_t memory) {
  return std::max<std::size_t>(1, memory / memory_of(1));
}

Vec3 lowest_corner(const std::vector<Disc>& discs) {
  Vec3 low = discs.front().center;
  for (const Disc& d : discs) {
    low = {std::min(low.x, d.center.x), std::min(low.y, d.center.y), std::min(low.z, d.center.z)};
  }
  return low;
}

BlockGrid make_grid(const std::vector<Disc>& discs, const AtlasSurfaceOptions& options,
                    const Context& context) {
  const Vec3 origin = lowest_corner(discs);
  return make_block_grid(
      origin, options.step,
      list_blocks(origin, options.step, discs, blocks_within(options.max_memory), context),
      context);
}

struct Dipoles {
  std::vector<FootPoint> feet;
  std::vector<Vec3> points, area_normals;
};

Dipoles dipoles_of(const Atlas& atlas) {
  Dipoles dipoles;
  for (const Cap& cap : atlas.caps) {
    const CapFoot foot = cap_foot(atlas, cap);
    dipoles.feet.push_back({foot.point, foot.normal, cap.frame.support});
    dipoles.points.push_back(foot.point);
    dipoles.area_normals.push_back(cap.area * foot.normal);
  }
  return dipoles;
}

// Vertices that no cap speaks for have the normals of their triangles.
void complete_normals(Mesh& mesh) {
  const auto axis = [&](const char* name) -> std::vector<double>& {
    return std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                        [&](const Attribute& a) { return a.name == name; })
        ->values;
  };
  std::vector<double>&nx = axis("nx"), &ny = axis("ny"), &nz = axis("nz");
  const std::size_t n = mesh.vertices.size();
  std::vector<std::uint8_t> missing(n);
  for (std::size_t i = 0; i < n; ++i) missing[i] = nx[i] == 0 && ny[i] == 0 && nz[i] == 0;
  if (std::find(missing.begin(), missing.end(), 1) == missing.end()) return;
  std::vector<Vec3> sums(n);
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 area = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    for (const std::uint32_t corner : t) sums[corner] += area;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (missing[i] == 0) continue;
    const Vec3 normal = normalized(sums[i]);
    nx[i] = normal.x, ny[i] = normal.y, nz[i] = normal.z;
  }
}

}  // namespace

AtlasSurface extract_atlas(const Atlas& atlas, const AtlasSurfaceOptions& options,
                           const Context& context) {
  AtlasSurface result;
  const std::vector<Disc> discs = discs_of(atlas, options.step, context);
  BlockGrid grid = make_grid(discs, options, context);
  result.memory = memory_of(grid.n_blocks());
  const CapLists lists = list_caps(grid, discs);
  fill_grid(atlas, lists, grid, context);
  const Dipoles dipoles = dipoles_of(atlas);
  const WindingTree winding(dipoles.points, dipoles.area_normals);
  const HoleFilling filling = fill_holes(
      grid, dipoles.feet, winding, {.max_blocks = blocks_within(options.max_memory)}, context);
  result.holes = filling.holes, result.smooth_holes = filling.smooth;
  ExtractedSurface surface = extract_surface(grid, context);
  project_vertices(atlas, lists, grid, surface, context);
  if (options.keep_holes) {
    const std::vector<double> support = data_support(atlas, lists, surface, context);
    result.mesh = trim(surface.mesh, support);
  } else {
    result.mesh = std::move(surface.mesh);
  }
  result.dropped_components = drop_small_components(result.mesh, options.min_component).dropped;
  complete_normals(result.mesh);
  return result;
}

}  // namespace rholm
