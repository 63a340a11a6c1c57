#include "reconstruct/normals/tile_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "reconstruct/normals/tile_directions.h"
#include "reconstruct/normals/tile_fit.h"
#include "rholm/topology.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_rules.h"
#include "shape/points/orient_sides.h"
#include "shape/points/orient_signs.h"

namespace rholm {
namespace {

// A tile does not store levels with more than this multiple of its share of the sample.
constexpr double kMostOfShare = 4;
constexpr std::size_t kFewestOfTile = 64;
constexpr double kFarthest = 4;  // times the neighbours of a fit that are looked at for its sheet
// Number of steps of the histogram of residuals between 0 and 1.
constexpr std::size_t kResidualSteps = 4000;

struct ThinnedPoint {
  Vec3 point;
  double spacing = 0;
};

std::string thinned_name(std::size_t tile) { return "thinned/" + std::to_string(tile); }

// One level after the other, the last one for all that follow.
struct Levels {
  std::uint64_t first = 0;  // level that is there
  std::vector<std::vector<ThinnedPoint>> points;
};

double part_of_level(std::size_t level) {
  return kThinned * std::pow(kFiner, static_cast<double>(level));
}

// Returns the spacings in the frame, `spread` times as coarse as for clean points.
std::vector<double> spacing_in(const UnitFrame& frame, const BareTile& bare, double spread) {
  std::vector<double> spacing = patches_of(bare.fits, bare.gaps, spread).spacing;
  for (double& s : spacing) s *= frame.scale;
  return spacing;
}

}  // namespace

TileField::TileField(PieceStore& store, const TilePlan& plan, const std::vector<double>& spacings,
                     std::uint64_t n_points, int n_neighbors)
    : store_(store), plan_(plan), spacings_(spacings), n_points_(n_points), n_fit_(n_neighbors) {
  if (n_neighbors <= kMostForCurvature) {
    ways_.push_back(
        {.n_neighbors = kCleanNeighbors, .spread = 1, .width = kField, .must_be_clean = true});
  }
  ways_.push_back(
      {.n_neighbors = n_neighbors, .spread = spread_of(n_neighbors), .width = kWideField});
}

void TileField::thin(std::size_t tile, const Context& context) {
  if (store_.has(thinned_name(tile))) return;
  BareTile bare = load_bare(store_, plan_, tile, 0, context);
  put_fits(store_, tile, n_fit_, bare);
  const std::size_t n = bare.points.size();
  const double share =
      static_cast<double>(n) / static_cast<double>(n_points_) * static_cast<double>(kMostOfField);
  const auto most = std::max(kFewestOfTile, static_cast<std::size_t>(kMostOfShare * share));
  const std::vector<double> spacing =
      n > 0 ? patches_of(bare.fits, bare.gaps, 1).spacing : std::vector<double>();
  std::vector<std::vector<std::byte>> sections(1);
  std::uint64_t first = 0;
  std::vector<double> reach(n);
  for (std::size_t level = 0;; ++level) {
    for (std::size_t i = 0; i < n; ++i) reach[i] = part_of_level(level) * spacing[i];
    std::vector<ThinnedPoint> kept;
    for (const std::uint32_t i : thin_out(*bare.tree, bare.points, reach)) {
      kept.push_back({bare.points[i], spacing[i]});
    }
    if (kept.size() <= most) {
      const std::span<const std::byte> bytes = bytes_of(kept);
      sections.emplace_back(bytes.begin(), bytes.end());
    } else {
      first = level + 1;
    }
    if (kept.size() <= kFewestOfTile) break;
  }
  const std::span<const std::byte> head = bytes_of(std::span<const std::uint64_t>(&first, 1));
  sections[0].assign(head.begin(), head.end());
  store_.write(thinned_name(tile), std::move(sections));
}

bool TileField::next() {
  if (begun_) ++way_;
  begun_ = true;
  if (way_ < ways_.size()) return true;
  way_ = ways_.size() - 1;
  return false;
}

void TileField::solve(const Context& context) {
  // Takes the finest level that all tiles have and that is small enough.
  std::size_t level = 0;
  std::vector<std::vector<std::size_t>> sizes;
  std::vector<std::uint64_t> first;
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    const PieceReader piece = store_.open(thinned_name(tile));
    first.push_back(piece.values<std::uint64_t>(0).at(0));
    sizes.emplace_back();
    for (std::size_t k = 1; k < piece.n_sections(); ++k) {
      sizes.back().push_back(piece.size(k) / sizeof(ThinnedPoint));
    }
    level = std::max(level, static_cast<std::size_t>(first.back()));
  }
  const auto section = [&](std::size_t tile) {
    return std::min(level - static_cast<std::size_t>(first[tile]), sizes[tile].size() - 1);
  };
  const auto total = [&] {
    std::size_t sum = 0;
    for (std::size_t tile = 0; tile < sizes.size(); ++tile) {
      sum += sizes[tile][section(tile)];
    }
    return sum;
  };
  // Each tile keeps a few points at least: the loop ends where all tiles are at their last level.
  const auto is_last = [&] {
    for (std::size_t tile = 0; tile < sizes.size(); ++tile) {
      if (section(tile) + 1 < sizes[tile].size()) return false;
    }
    return true;
  };
  while (total() > kMostOfField && !is_last()) ++level;
  std::vector<ThinnedPoint> all;
  for (std::size_t tile = 0; tile < sizes.size(); ++tile) {
    const auto own = store_.open(thinned_name(tile)).values<ThinnedPoint>(section(tile) + 1);
    all.insert(all.end(), own.begin(), own.end());
  }
  std::vector<Vec3> places(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) places[i] = all[i].point;
  frame_ = unit_frame(bounds(places));
  for (Vec3& p : places) p = frame_.to_local(p);
  const PointTree tree(places, context);
  std::vector<Vec3> points(places.size());
  std::vector<double> spacing(places.size());
  const double spread = ways_[way_].spread;
  for (std::size_t i = 0; i < places.size(); ++i) {
    points[i] = places[tree.order()[i]];
    spacing[i] = spread * frame_.scale * all[tree.order()[i]].spacing;
  }
  field_.emplace(tree, points, spacing, std::max(kThinned, part_of_level(level) / spread), context);
}

std::string TileField::sheets_name(std::size_t tile, std::size_t way) const {
  return "sheets" + std::to_string(way) + "/" + std::to_string(tile);
}

std::vector<SheetNormal> TileField::read_sheets(std::size_t tile) const {
  return store_.open(sheets_name(tile, way_)).values<SheetNormal>(0);
}

void TileField::find_sheets(std::size_t tile, const Context& context) {
  if (store_.has(sheets_name(tile, way_))) return;
  const Way& way = ways_[way_];
  const double reach =
      reach_of(static_cast<std::size_t>(kFarthest * way.n_neighbors)) + reach_of(kGraphNeighbors);
  BareTile bare = load_bare(store_, plan_, tile, reach * spacings_[tile], context);
  std::vector<SheetNormal> sheets(bare.read.n_own);
  std::vector<std::uint64_t> residuals(kResidualSteps + 1, 0);
  if (!bare.points.empty()) {
    put_graph(store_, tile, n_fit_, bare, context);
    std::vector<Vec3> local(bare.points.size());
    for (std::size_t i = 0; i < local.size(); ++i) local[i] = frame_.to_local(bare.points[i]);
    const std::vector<double> spacing = spacing_in(frame_, bare, way.spread);
    std::vector<Vec3> sheet = field_->normals_at(*bare.tree, local, spacing, way.width, context);
    for (Vec3& n : sheet) n = normalized(n);
    SamplingGaps gaps;
    if (!bare.gaps.ratio.empty()) {
      gaps = find_gaps(*bare.tree, bare.points, sheet, context, RowsThatTurn::kCount);
    }
    LocalFits fits = std::move(bare.fits);
    fits.n_neighbors = way.n_neighbors;
    const std::vector<float> found =
        refit_on_sheets(*bare.tree, bare.points, gaps, sheet, fits, context);
    const std::vector<float> agreement = mean_agreement(bare.points, fits, fits.normals);
    for (std::size_t i = 0; i < bare.points.size(); ++i) {
      if (bare.foreign[i] != 0) continue;
      const Vec3& n = fits.normals[i];
      sheets[bare.tree->order()[i]] = {static_cast<float>(n.x), static_cast<float>(n.y),
                                       static_cast<float>(n.z), agreement[i]};
      const double residual = std::clamp(static_cast<double>(found[i]), 0.0, 1.0);
      ++residuals[static_cast<std::size_t>(residual * kResidualSteps)];
    }
  }
  const std::span<const std::byte> sections[] = {bytes_of(sheets), bytes_of(residuals)};
  store_.write(sheets_name(tile, way_), sections);
}

double TileField::residual() const {
  std::vector<std::uint64_t> all(kResidualSteps + 1, 0);
  std::uint64_t n = 0;
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    const auto own = store_.open(sheets_name(tile, way_)).values<std::uint64_t>(1);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k] += own.at(k);
      n += own[k];
    }
  }
  std::uint64_t sum = 0;
  std::size_t k = 0;
  while (k < kResidualSteps && 2 * (sum += all[k]) <= n) ++k;
  return static_cast<double>(k) / kResidualSteps;
}

bool TileField::are_sheets(const DoubtScene& scene, const Context& context) {
  const JoinedSides& sides = scene.sides;
  const Way& way = ways_[way_];
  const double rest = residual();
  if (way.must_be_clean && !(rest < kSheets)) return false;
  if (rest > kNoSheets) return true;
  const std::size_t n = sides.samples.size();
  std::vector<Vec3> points(n), by_graph(n), by_field(n);
  Patches patches{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    const std::vector<SheetNormal> own = read_sheets(tile);
    for (std::size_t s = sides.first_sample[tile]; s < sides.first_sample[tile + 1]; ++s) {
      const SideSample& sample = sides.samples[s];
      const SheetNormal& sheet = own.at(sample.place);
      points[s] = sample.point;
      by_graph[s] = sample.normal;
      by_field[s] = {sheet.x, sheet.y, sheet.z};
      patches.areas[s] = sample.area;
      patches.spacing[s] = way.spread / spread_of_graph(n_fit_) * sample.spacing;
    }
  }
  const auto normals_of = [&](std::size_t tile) {
    const std::vector<SheetNormal> own = read_sheets(tile);
    std::vector<Vec3> normals(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) normals[i] = {own[i].x, own[i].y, own[i].z};
    return normals;
  };
  const auto joined = [&](std::size_t tile) { return joined_normals(scene, tile); };
  const auto share = [&](const std::vector<Vec3>& of_samples, const NormalsOfTile& of_tile) {
    return scene.points_per_sample == 1
               ? doubtful_share(points, patches, of_samples, context)
               : doubtful_share(scene, kNearPatches, way.spread, of_tile, of_samples, context);
  };
  better_ = share(by_field, normals_of) <= kClearly * share(by_graph, joined);
  if (better_) trust_ = trust_in_sides(points, patches, by_field, context);
  return true;
}

void TileField::remove() {
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    store_.remove(thinned_name(tile));
    for (std::size_t way = 0; way < ways_.size(); ++way) store_.remove(sheets_name(tile, way));
  }
}

}  // namespace rholm
