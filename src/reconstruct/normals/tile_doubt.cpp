#include "reconstruct/normals/tile_doubt.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/caps/tile_caps.h"
#include "reconstruct/normals/tile_directions.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/normals/tile_signs.h"
#include "shape/points/orient_sides.h"
#include "shape/points/orient_signs.h"
#include "shape/queries/winding_tree.h"

namespace rholm {
namespace {

// Number of points asked (chosen: the same number as for one tile, orient_sides.cpp), and of tiles.
constexpr std::size_t kAsked = 2000, kAskedTiles = 32;
// Width of the halo in sides of a sample's patch. A patch that is half in the box and half beyond
// it then covers less than a hundredth of the full angle.
constexpr double kAway = 3;

WindingTree tree_of(const std::vector<SideSample>& samples, std::span<const Vec3> normals) {
  std::vector<Vec3> points(samples.size()), area_normals(samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    points[s] = samples[s].point;
    area_normals[s] = samples[s].area * normals[s];
  }
  return {points, area_normals};
}

}  // namespace

std::vector<Vec3> joined_normals(const DoubtScene& scene, std::size_t tile) {
  const std::vector<PieceCode> codes = read_codes(scene.store, tile);
  const std::vector<PointDirection> directions = read_directions(scene.store, tile);
  std::vector<Vec3> normals(codes.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const PointDirection& own = directions.at(i);
    const std::uint64_t piece = scene.sides.first.at(tile) + codes[i].piece();
    const bool against = codes[i].opposite() != (scene.sides.turned.at(piece) != 0);
    const Vec3 direction{own.x, own.y, own.z};
    normals[i] = against ? -direction : direction;
  }
  return normals;
}

double doubtful_share(const DoubtScene& scene, double radii, double spread,
                      const NormalsOfTile& normals_of, std::span<const Vec3> sample_normals,
                      const Context& context) {
  const std::size_t n_tiles = scene.plan.n_tiles(), tiles = std::min(n_tiles, kAskedTiles);
  const double side = std::sqrt(static_cast<double>(scene.points_per_sample));
  const double reach = std::max(kAway * side, reach_of(kGraphNeighbors));
  const std::size_t of_each = (kAsked + tiles - 1) / tiles;
  const WindingTree of_samples = tree_of(scene.sides.samples, sample_normals);
  double doubtful = 0, all = 0;
  for (std::size_t k = 0; k < tiles; ++k) {
    const std::size_t tile = k * n_tiles / tiles;
    const double halo = reach * scene.spacings[tile];
    BareTile bare = load_bare(scene.store, scene.plan, tile, halo, context);
    if (bare.read.n_own == 0) continue;
    put_fits(scene.store, tile, scene.n_neighbors, bare);
    const Patches patches = patches_of(bare.fits, bare.gaps, spread);
    const std::vector<Vec3> given = gather<Vec3>(bare.read, tile, normals_of);
    std::vector<Vec3> points = bare.points, normals(bare.points.size()), area_normals;
    std::vector<std::uint32_t> own;
    for (std::uint32_t i = 0; i < normals.size(); ++i) {
      normals[i] = given.at(bare.tree->order()[i]);
      area_normals.push_back(patches.areas[i] * normals[i]);
      if (bare.foreign[i] == 0) own.push_back(i);
    }
    // In the box around the tile all points count instead of their samples.
    const Bounds box = grown(read_index(scene.store, tile).bounds(), halo);
    for (std::size_t s = 0; s < scene.sides.samples.size(); ++s) {
      const SideSample& sample = scene.sides.samples[s];
      if (!is_within(box, sample.point)) continue;
      points.push_back(sample.point);
      area_normals.push_back(-sample.area * sample_normals[s]);
    }
    std::vector<std::uint32_t> chosen(std::min(of_each, own.size()));
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      chosen[j] = own[j * own.size() / chosen.size()];
    }
    const WindingTree instead(points, area_normals);
    const WindingNumbers winding = [&](std::span<const Vec3> x, double opening) {
      std::vector<double> w = of_samples.winding(x, context, opening);
      const std::vector<double> change = instead.winding(x, context, opening);
      for (std::size_t i = 0; i < w.size(); ++i) w[i] += change[i];
      return w;
    };
    const auto found =
        static_cast<double>(count_doubtful(winding, bare.points, patches, normals, chosen, radii));
    // Each tile speaks for its points.
    const auto weight = static_cast<double>(own.size());
    doubtful += weight * found / static_cast<double>(chosen.size());
    all += weight;
  }
  return all > 0 ? doubtful / all : 0;
}

}  // namespace rholm
