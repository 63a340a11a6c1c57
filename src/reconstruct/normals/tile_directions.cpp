#include "reconstruct/normals/tile_directions.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/normals/tile_fit.h"

namespace rholm {
namespace {

// Times the neighbours of a fit: what a fit beside an edge sees (normals_edges.cpp).
constexpr double kBesideEdge = 2.7;

float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

BareTile load_bare(const PieceStore& store, const TilePlan& plan, std::size_t tile, double halo,
                   const Context& context) {
  BareTile bare{.read = read_with_halo(store, plan, tile, halo)};
  bare.tree = std::make_unique<PointTree>(bare.read.cloud.points, context);
  const std::size_t n = bare.tree->size();
  bare.points.resize(n), bare.foreign.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t given = bare.tree->order()[i];
    bare.points[i] = bare.read.cloud.points[given];
    bare.foreign[i] = given >= bare.read.n_own ? 1 : 0;
  }
  return bare;
}

std::string directions_name(std::size_t tile) { return "directions/" + std::to_string(tile); }

std::vector<PointDirection> read_directions(const PieceStore& store, std::size_t tile) {
  return store.open(directions_name(tile)).values<PointDirection>(0);
}

void find_gaps(BareTile& tile, const Context& context) {
  if (!tile.points.empty()) tile.gaps = find_gaps(*tile.tree, tile.points, {}, context);
}

double reach_of_fits(int n_neighbors) {
  const auto k = static_cast<std::size_t>(n_neighbors);
  if (n_neighbors > kMostForCurvature) return reach_of(k);
  // Beside edges neighbours propose their own planes.
  return reach_of(static_cast<std::size_t>(kBesideEdge * n_neighbors)) + reach_of(k);
}

std::vector<PointDirection> fit_directions(const BareTile& tile, int n_neighbors,
                                           const Context& context) {
  std::vector<PointDirection> directions(tile.read.n_own);
  if (tile.points.empty()) return directions;
  // Without edges the halo is looked at only.
  std::vector<std::uint8_t> skipped;
  if (n_neighbors > kMostForCurvature) skipped = tile.foreign;
  const LocalFits fits =
      fit_normals(*tile.tree, tile.points, tile.gaps, {}, n_neighbors, context, skipped);
  for (std::size_t i = 0; i < tile.points.size(); ++i) {
    if (tile.foreign[i] != 0) continue;
    const Vec3& n = fits.normals[i];
    directions[tile.tree->order()[i]] = {
        static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
        fits.radius[i],          fits.residual[i],        static_cast<float>(tile.gaps.of(i))};
  }
  return directions;
}

void put_fits(const PieceStore& store, std::size_t tile, int n_neighbors, BareTile& bare) {
  LocalFits& fits = bare.fits;
  const std::size_t n = bare.points.size();
  const auto directions = gather<PointDirection>(
      bare.read, tile, [&](std::size_t other) { return read_directions(store, other); });
  bare.gaps.ratio.resize(n);
  fits.normals.resize(n), fits.radius.resize(n), fits.residual.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PointDirection& own = directions.at(bare.tree->order()[i]);
    const Vec3 direction{own.x, own.y, own.z};
    fits.normals[i] = norm(direction) > 0 ? normalized(direction) : direction;
    fits.radius[i] = own.radius, fits.residual[i] = own.residual;
    bare.gaps.ratio[i] = own.gap;
  }
  const auto is_even = [](float gap) { return gap == 1; };
  if (std::all_of(bare.gaps.ratio.begin(), bare.gaps.ratio.end(), is_even)) bare.gaps = {};
  fits.n_neighbors = n_neighbors;
  fits.noisy = are_noisy(n_neighbors);
  fits.typical_residual = static_cast<double>(median(fits.residual));
}

void put_graph(const PieceStore& store, std::size_t tile, int n_neighbors, BareTile& bare,
               const Context& context) {
  put_fits(store, tile, n_neighbors, bare);
  bare.fits.neighbors = graph_neighbors(*bare.tree, bare.gaps, context);
}

}  // namespace rholm
