#include "surface/atlas_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atlas/cap/cap_pole.h"
#include "base/disjoint_sets.h"
#include "base/indices_where.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/normal_attributes.h"
#include "surface/field/atlas_dipoles.h"
#include "surface/field/cap_field.h"
#include "surface/field/data_support.h"
#include "surface/grid/block_grid.h"
#include "surface/holes/close_grid.h"
#include "surface/holes/hole_fill.h"
#include "surface/level_set/components.h"
#include "surface/level_set/extract.h"
#include "surface/level_set/trim.h"

namespace rholm {
namespace {

// Bytes of the surface per block: about 45 vertices with normals,
// 90 triangles and the lists of caps (measured on closed bodies).
constexpr std::size_t kSurfaceOfBlock = 45 * 56 + 90 * 12 + 32 * 4;

// Extra bytes per block while the mesh is simplified: planes, stars and lists of
// about 45 vertices (96 bytes each). The values of the grid are released by then.
constexpr std::size_t kSimplifyOfBlock = 45 * 96 - BlockGrid::kNodes * sizeof(float);
// Largest error of simplification in steps. On clean bodies (scripts/constants)
// it leaves a sixth of the triangles, and distances grow by a tenth.
constexpr double kSimplifyError = 0.02;

constexpr double kDipoleSteps = 2;  // steps between dipoles: enough for a smooth winding number

std::size_t memory_of(std::size_t n_blocks, const AtlasSurfaceOptions& options) {
  const std::size_t surface = kSurfaceOfBlock + (options.simplify ? kSimplifyOfBlock : 0);
  return options.memory_in_use + block_grid_bytes(n_blocks) + n_blocks * surface;
}

std::size_t blocks_within(const AtlasSurfaceOptions& options) {
  const std::size_t none = memory_of(0, options);
  if (options.max_memory <= none) return 1;
  return std::max<std::size_t>(1, (options.max_memory - none) / (memory_of(1, options) - none));
}

Vec3 lowest_corner(const std::vector<Disc>& discs) {
  Vec3 low = discs.front().center;
  for (const Disc& d : discs) {
    low = {std::min(low.x, d.center.x), std::min(low.y, d.center.y), std::min(low.z, d.center.z)};
  }
  return low;
}

std::vector<BlockCoordinates> blocks_of(const Atlas& atlas, double step,
                                        const AtlasSurfaceOptions& options,
                                        const Context& context) {
  const std::vector<Disc> discs = discs_of(atlas, CapBands(atlas, step, context));
  return list_blocks(lowest_corner(discs), step, discs, blocks_within(options), context);
}

// Returns true if the step is too small for the memory or for the range of block coordinates.
bool is_too_fine(const Error& error) {
  return error.code() == ErrorCode::kOutOfMemory || error.code() == ErrorCode::kInvalidInput;
}

// Returns the longest side of the bounding box of the caps' seeds.
double longest_side(const Atlas& atlas) {
  std::vector<Vec3> seeds;
  seeds.reserve(atlas.caps.size());
  for (const Cap& cap : atlas.caps) seeds.push_back(cap.frame.seed());
  const Vec3 size = bounds(seeds).max - bounds(seeds).min;
  return std::max({size.x, size.y, size.z});
}

// Returns the finest step diagonal / 2^k that fits into memory, or 0 if none does.
double step_that_fits(const Atlas& atlas, const AtlasSurfaceOptions& options,
                      const Context& context) {
  double found = 0;
  try {
    for (double step = atlas.diagonal / 8; step > options.step; step /= 2) {
      blocks_of(atlas, step, options, context);
      found = step;
    }
  } catch (const Error& error) {
    if (!is_too_fine(error)) throw;
  }
  return found;
}

BlockGrid make_grid(const Atlas& atlas, const std::vector<Disc>& discs,
                    const AtlasSurfaceOptions& options, const Context& context) {
  const Vec3 origin = lowest_corner(discs);
  try {
    std::vector<BlockCoordinates> blocks =
        list_blocks(origin, options.step, discs, blocks_within(options), context);
    return_free_memory();
    return make_block_grid(origin, options.step, std::move(blocks), context);
  } catch (const Error& error) {
    if (!is_too_fine(error)) throw;
    const double fits = step_that_fits(atlas, options, context);
    throw Error(
        ErrorCode::kOutOfMemory,
        fmt::format("a grid with steps of {:.3g} needs more than the {:.0f} MiB allowed: {}allow "
                    "more memory",
                    options.step, static_cast<double>(options.max_memory) / (1 << 20),
                    fits > 0 ? fmt::format("take steps of {:.3g} (1/{:.0f} of the diagonal, {:.0f} "
                                           "along the longest side), or ",
                                           fits, atlas.diagonal / fits, longest_side(atlas) / fits)
                             : ""));
  }
}

// Returns true if all caps are small and overlap by half, as reconstruct() makes them. Large caps
// do not show where the data end.
bool are_small(const Atlas& atlas) {
  return std::all_of(atlas.caps.begin(), atlas.caps.end(),
                     [](const Cap& cap) { return cap.area > 0; });
}

// Makes one dipole per small cap, with the area the cap was made for; spreads dipoles on large
// ones.
AtlasDipoles dipoles_of(const Atlas& atlas, double step, const Context& context) {
  if (!are_small(atlas))
    return spread_dipoles(atlas, kDipoleSteps * step, band_of(atlas, step), context);
  AtlasDipoles dipoles;
  for (const Cap& cap : atlas.caps) {
    const CapFoot foot = cap_foot(atlas, cap);
    dipoles.feet.push_back({foot.point, foot.normal, cap.frame.support});
    dipoles.points.push_back(foot.point);
    dipoles.area_normals.push_back(cap.area * foot.normal);
  }
  return dipoles;
}

// Computes the values of the caps, and fills the nodes that no cap reaches.
HoleFilling fill(const Atlas& atlas, const CapBands& bands, const CapLists& lists,
                 const AtlasSurfaceOptions& options, BlockGrid& grid, const Context& context) {
  AtlasDipoles dipoles;
  std::optional<WindingTree> winding;
  // One thread makes the tree while the others compute values; only the values report progress.
  Context silent = context;
  silent.progress = {};
  const auto make_tree = [&] {
    dipoles = dipoles_of(atlas, options.step, silent);
    winding.emplace(dipoles.points, dipoles.area_normals);
  };
  const std::vector<std::uint64_t> uncertain =
      fill_grid(atlas, bands, lists, grid, context, make_tree);
  const WindingNumbers numbers = winding->numbers(context);
  clear_refuted(grid, uncertain, numbers);
  HoleFillOptions filled{.max_blocks = blocks_within(options), .support = {}, .seen = options.seen};
  if (are_small(atlas)) filled.support = node_support(atlas, lists, grid, context);
  return fill_holes(
      grid, [&](std::span<const Hole>) { return std::move(dipoles.feet); }, numbers, filled,
      context);
}

double median_support(const Atlas& atlas) {
  std::vector<double> supports;
  supports.reserve(atlas.caps.size());
  for (const Cap& cap : atlas.caps) supports.push_back(cap.frame.support);
  const auto middle = supports.begin() + static_cast<std::ptrdiff_t>(supports.size() / 2);
  std::nth_element(supports.begin(), middle, supports.end());
  return *middle;
}

// Marks connected parts without support as kept if their area is below `least`.
void bridge_gaps(const Mesh& mesh, double least, std::vector<double>& support) {
  DisjointSets parts(support.size());
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (support[a] <= 0 && support[b] <= 0) parts.unite(a, b);
    }
  }
  std::vector<double> areas(support.size(), 0.0);
  for (const Triangle& t : mesh.faces) {
    const Vec3& a = mesh.vertices[t[0]];
    const double area = norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
    for (const std::uint32_t v : t) {
      if (support[v] <= 0) areas[parts.find(v)] += area / 3;
    }
  }
  for (std::uint32_t v = 0; v < support.size(); ++v) {
    if (support[v] <= 0 && areas[parts.find(v)] < least) support[v] = kBridged;
  }
}

// Returns the share of the area in triangles with a vertex that depends on filled nodes.
double guessed_share(const ExtractedSurface& surface, const Context& context) {
  if (surface.filled.empty()) return 0;
  const Mesh& mesh = surface.mesh;
  constexpr std::size_t kGrain = 8192;
  struct Areas {
    double guessed = 0, whole = 0;
  };
  std::vector<Areas> parts((mesh.faces.size() + kGrain - 1) / kGrain);
  parallel_for(mesh.faces.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Areas part;
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.faces[i];
      const Vec3& a = mesh.vertices[t[0]];
      const double area = norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
      part.whole += area;
      const auto filled = [&](std::uint32_t v) { return surface.filled[v] != 0; };
      if (std::any_of(t.begin(), t.end(), filled)) part.guessed += area;
    }
    parts[begin / kGrain] = part;
  });
  double guessed = 0, whole = 0;
  for (const Areas& part : parts) guessed += part.guessed, whole += part.whole;
  return whole > 0 ? guessed / whole : 0;
}

// Sets the normals of vertices outside all supports from their triangles.
// These vertices are rare, so only the triangles at them are summed.
void complete_normals(Mesh& mesh, const Context& context) {
  const NormalAttributes normals = normal_attributes(mesh);
  const std::vector<std::uint32_t> missing = indices_where(
      mesh.vertices.size(), context, [&](std::uint32_t v) { return normals[v] == Vec3{}; });
  if (missing.empty()) return;
  std::vector<std::uint8_t> flags(mesh.vertices.size(), 0);
  for (const std::uint32_t v : missing) flags[v] = 1;
  const std::vector<std::uint32_t> around =
      indices_where(mesh.faces.size(), context, [&](std::uint32_t t) {
        const Triangle& c = mesh.faces[t];
        return (flags[c[0]] | flags[c[1]] | flags[c[2]]) != 0;
      });
  std::vector<Vec3> sums(missing.size());
  for (const std::uint32_t i : around) {
    const Triangle& t = mesh.faces[i];
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 area = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    for (const std::uint32_t v : t) {
      if (flags[v] == 0) continue;
      sums[std::lower_bound(missing.begin(), missing.end(), v) - missing.begin()] += area;
    }
  }
  for (std::size_t k = 0; k < missing.size(); ++k) normals.set(missing[k], normalized(sums[k]));
}

}  // namespace

SimplifyOptions simplify_stops(SimplifyOptions options, double step) {
  const bool none = options.faces == 0 && options.share == 0 && std::isinf(options.max_error);
  if (none) options.max_error = kSimplifyError * step;
  return options;
}

// Returns the area of the support of a typical cap.
double least_hole(double support) { return std::numbers::pi * support * support; }

AtlasSurface extract_atlas(const Atlas& atlas, const AtlasSurfaceOptions& options,
                           const Context& context) {
  if (atlas.caps.empty()) {
    throw Error(ErrorCode::kInvalidInput, "an atlas without caps has no surface");
  }
  AtlasSurface result;
  const CapBands bands(atlas, options.step, context);
  std::vector<Disc> discs = discs_of(atlas, bands);
  BlockGrid grid = make_grid(atlas, discs, options, context);
  result.memory = memory_of(grid.n_blocks(), options);
  const CapLists lists = list_caps(grid, discs, context);
  release(discs);
  const HoleFilling filling = fill(atlas, bands, lists, options, grid, context);
  result.holes = filling.holes, result.smooth_holes = filling.smooth;
  return_free_memory();
  ExtractedSurface surface = extract_last_surface(grid, context);
  // The code below needs only the coordinates of blocks.
  release(grid.neighbours);
  project_vertices(atlas, bands, lists, grid, surface, context);
  result.guessed = guessed_share(surface, context);
  std::vector<double> support;
  if (options.keep_holes) support = data_support(atlas, lists, surface, bands, context);
  if (options.resolution != nullptr) {
    const CutHandles cut = cut_handles(surface.mesh, *options.resolution, context);
    result.cut_handles = cut.handles;
    if (options.keep_holes) {
      for (const std::uint32_t v : cut.copies) support.push_back(support[v]);
    }
  }
  if (options.keep_holes) {
    bridge_gaps(surface.mesh, least_hole(median_support(atlas)), support);
    result.mesh = trim(surface.mesh, support);
  } else {
    result.mesh = std::move(surface.mesh);
  }
  result.dropped_components =
      drop_small_components(result.mesh, options.min_component, context).dropped;
  complete_normals(result.mesh, context);
  result.faces = result.mesh.faces.size();
  if (options.judge) options.judge(result.mesh);
  if (options.simplify) {
    grid = {};
    Simplification simple =
        simplify(std::move(result.mesh), simplify_stops(*options.simplify, options.step), context);
    result.mesh = std::move(simple.mesh);
    result.simplify_error = simple.error;
  }
  return result;
}

}  // namespace rholm
