#include "reconstruct/cloud/tile_cloud.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "base/large_vector.h"
#include "reconstruct/cloud/load_tile.h"
#include "reconstruct/cloud/tile_removal.h"
#include "reconstruct/normals/tile_mending.h"
#include "reconstruct/normals/tile_normals.h"
#include "reconstruct/points/reconstruct_rules.h"
#include "reconstruct/points/tile_points.h"
#include "rholm/error.h"
#include "shape/points/isolated_points.h"
#include "shape/points/local_shape.h"
#include "shape/points/normals.h"

namespace rholm {
namespace {

// The usual halo of a tile is wide enough to fit caps with up to this number of neighbours.
constexpr std::size_t kTried = 128;
// Number of sample points of all tiles together, and the least number in each tile.
constexpr std::size_t kSamples = 2000, kSamplesOfTile = 16;
// Number of tiles in which the size of caps is chosen; the median is used.
constexpr std::size_t kPilots = 5;

}  // namespace

TileCloud::TileCloud(PointSource& source, PieceStore& store, const ReconstructOptions& options,
                     std::uint64_t points_per_tile, Stages& stages, ReconstructReport& report)
    : source_(source), store_(store), options_(options), stages_(stages), report_(report) {
  stages_.once("survey", [&] { find_survey(points_per_tile); });
  survey_ = read_survey(store_).value();
  plan_ = make_plan(survey_, points_per_tile);
  n_ = plan_.n_tiles();
  keeps_scenes_ = n_ == 1 || store_.in_memory();
  scenes_.resize(n_), neighbors_.resize(n_);
  given_ = survey_.layout.normals;
  if (!given_) add_costs_of_normals();
}

void TileCloud::add_costs_of_normals() {
  stages_.add(n_ == 1 ? std::vector<StageCost>{{"orient", 6}} : costs_of_normals());
}

void TileCloud::prepare() {
  sort();
  if (!options_.keep_outliers) remove_isolated_points();
  count_points();
  if (given_) look_at_shape();
  if (!given_) orient();
  if (around_ == 0) look_at_shape();
  mend();
  take_sample("sample");
  if (options_.holes == HolePolicy::kFill) check_sides(sample_.sides, points_);
  choose_size("size");
  return_free_memory();
}

void TileCloud::measure_again() {
  take_sample("sample-again");
  choose_size("size-again");
}

bool TileCloud::has_column(const char* name) const {
  const auto& columns = survey_.layout.columns;
  return std::any_of(columns.begin(), columns.end(),
                     [&](const ColumnLayout& column) { return column.name == name; });
}

std::shared_ptr<const TileScene> TileCloud::load(std::size_t tile, std::size_t neighbours,
                                                 double least) const {
  const double usual = spacings_[tile] * reach_of(kTried);
  const double needed = std::max(least, spacings_[tile] * reach_of(neighbours));
  return scene(tile, std::max(usual, needed), !(needed > usual));
}

std::shared_ptr<const TileScene> TileCloud::load_for(std::size_t tile,
                                                     std::size_t neighbours) const {
  return scene(tile, spacings_[tile] * reach_of(neighbours), false);
}

// A tile alone has no halo.
std::shared_ptr<TileScene> TileCloud::scene(std::size_t tile, double halo, bool keep) const {
  const auto made = [&] {
    return std::make_shared<TileScene>(load_tile(store_, plan_, tile, halo, stages_.context()));
  };
  if (!keeps_scenes_ || !(keep || n_ == 1)) return made();
  {
    const std::lock_guard lock(mutex_);
    if (scenes_[tile]) return scenes_[tile];
  }
  auto loaded = made();
  if (n_ == 1) return_free_memory();
  const std::lock_guard lock(mutex_);
  return scenes_[tile] = std::move(loaded);
}

void TileCloud::forget_scenes() {
  scenes_.assign(n_, {});
  neighbors_.assign(n_, {});
}

void TileCloud::keep_no_scenes() {
  forget_scenes();
  keeps_scenes_ = false;
}

TileScene TileCloud::take_only() {
  const std::shared_ptr<TileScene> only = scene(0, 0, true);
  keep_no_scenes();
  if (!store_.is_kept()) {
    for (const char* name : {"survey", "points/0", "normals/0", "turned/0"}) store_.remove(name);
  }
  return std::move(*only);
}

void TileCloud::find_survey(std::uint64_t points_per_tile) {
  if (read_survey(store_)) return;
  Survey found = rholm::survey(
      source_, {.points_per_tile = points_per_tile, .drop_far_isolated = !options_.keep_outliers},
      stages_.context());
  if (found.points <= points_per_tile) release(found.sample);  // the only tile is not cut
  write_survey(found, store_);
}

void TileCloud::sort() {
  stages_.once("distribute",
               [&] { distribute(source_, survey_, plan_, store_, {}, stages_.context()); });
  source_.finish();
  stages_.each("sort", n_, [&](std::size_t tile) { sort_points(store_, tile); });
  report_.points = survey_.points + survey_.not_finite + survey_.dropped + survey_.far_isolated;
  report_.outliers = survey_.far_isolated;
  // Spacings are needed for the width of halos.
  spacings_.assign(n_, 0.0);
  if (n_ > 1) spacings_ = spacings_of_sample(survey_, plan_, survey_.n_different);
  return_free_memory();
}

// Counts the points before outliers near the surface are removed. A continued run reads the count.
void TileCloud::count_points() {
  stages_.once("count", [&] {
    if (store_.has("counted")) return;
    std::uint64_t n = 0;
    for (std::size_t tile = 0; tile < n_; ++tile) n += read_index(store_, tile).counts.points;
    const std::vector<double> box = {bounds_of_tiles(store_, plan_).diagonal(),
                                     lie_on_line(store_, plan_, kLine) ? 1.0 : 0.0};
    const std::span<const std::byte> sections[] = {bytes_of(std::span<const std::uint64_t>(&n, 1)),
                                                   bytes_of(box)};
    store_.write("counted", sections);
  });
  const PieceReader counted = store_.open("counted");
  points_ = counted.values<std::uint64_t>(0).at(0);
  report_.dropped_points = report_.points - report_.outliers - points_;
  const std::vector<double> box = counted.values<double>(1);
  diagonal_ = box.at(0);
  check_spread(points_, diagonal_);
  if (box.at(1) != 0) refuse_one_line(points_);
}

// The only tile is loaded anew for each look. The scene of the last look is kept, and two scenes
// are never in memory at the same time.
void TileCloud::remove_isolated_points() {
  const int times = n_ == 1 ? kIsolatedPasses : 1, looks = kIsolatedPasses / times;
  for (int time = 0; time < times; ++time) {
    TileRemoval isolated(store_, plan_, "isolated-" + std::to_string(time));
    stages_.each("isolated points", n_, [&](std::size_t tile) {
      if (isolated.has_found(tile)) return;
      const bool asked = keeps_scenes_ && given_;  // signs of given normals need neighbours
      isolated.put(tile, find_isolated_in_tile(*load(tile), looks, stages_.context(),
                                               asked ? &neighbors_[tile] : nullptr));
    });
    const std::uint64_t n_isolated = isolated.count();
    if (n_isolated > 0) forget_scenes();  // before copies of all points are made
    stages_.each("isolated points", n_, [&](std::size_t tile) { isolated.remove(tile); });
    if (n_isolated == 0) return;
    report_.outliers += n_isolated;
  }
}

// Points that have no normals get them.
void TileCloud::orient() {
  std::unique_ptr<PointTree> tree;  // of the only tile, for its scene with normals
  if (n_ == 1 && scenes_[0]) tree = std::move(scenes_[0]->tree);
  forget_scenes();
  const TileNormalsReport normals =
      orient_tiles(store_, plan_, spacings_, {.sensor = options_.sensor}, stages_);
  report_.computed_normals = true;
  report_.unsure = static_cast<double>(normals.unsure) / static_cast<double>(normals.points);
  TileRemoval undetermined(store_, plan_, "undetermined");
  stages_.each("turn", n_, [&](std::size_t tile) {
    if (undetermined.has_found(tile)) return;
    std::vector<std::uint8_t> flags;
    for (const TileNormal& normal : read_normals(store_, tile)) {
      flags.push_back(normal.normal() == Vec3{} ? 1 : 0);
    }
    undetermined.put(tile, flags);
  });
  report_.dropped_points += undetermined.count();
  forget_scenes();
  stages_.each("turn", n_, [&](std::size_t tile) { undetermined.remove(tile); });
  if (!tree) return;
  stages_.all("turn", [&] {
    scenes_[0] = std::make_shared<TileScene>(
        load_tile(store_, plan_, 0, 0, stages_.context(), std::move(tree)));
  });
}

// Examines some tiles, which are parts of one surface. Normals that do not fit it are recomputed.
void TileCloud::look_at_shape() {
  const Stage stage = {.name = "cap size",
                       .count = std::min(n_, kPilots),
                       .outputs = {given_ ? "shape-given" : "shape"}};
  const auto look = [&](std::size_t pilot) {
    const auto scene = load(pilot * n_ / stage.count);
    const LocalShape shape =
        rholm::look_at_shape(*scene->tree, scene->points, scene->normals, stages_.context());
    check_shape(shape, scene->points.size());
    return std::vector{shape};
  };
  std::vector<std::size_t> neighbors;
  double crooked = 0;
  for (const LocalShape& shape : stages_.values<LocalShape>(stage, look)) {
    neighbors.push_back(shape.neighbors);
    crooked += shape.crooked / static_cast<double>(stage.count);
  }
  std::sort(neighbors.begin(), neighbors.end());
  around_ = area_neighbors(neighbors[stage.count / 2]);
  if (!given_) return;
  report_.crooked_normals = crooked;
  if (!(crooked > kMostCrooked)) return;
  given_ = false, around_ = 0;
  add_costs_of_normals();
}

void TileCloud::mend() {
  std::uint64_t points = 0;
  for (std::size_t tile = 0; tile < n_; ++tile) {
    points += read_index(store_, tile).counts.points;
  }
  const std::size_t halo = std::max<std::size_t>(2 * kGraphNeighbors, around_);
  const TileMendingReport mended =
      mend_tiles(store_, plan_,
                 {.mend = given_,
                  .closed = options_.holes == HolePolicy::kFill,
                  .load = [&](std::size_t tile) { return load(tile, halo); },
                  .neighbors = [&](std::size_t tile) { return std::move(neighbors_[tile]); },
                  .points = points,
                  .samples = kSamples,
                  .around = around_,
                  .max_memory = options_.max_memory},
                 stages_);
  if (have_turned(store_)) forget_scenes();
  report_.contradicting_normals = mended.contradicting;
  report_.contradictions.assign(mended.first.begin(), mended.first.begin() + mended.named);
  report_.turned_normals = mended.all_inward != 0;
  report_.mended_normals = mended.all_inward != 0 ? 0 : mended.turned;
  report_.inward_normals = mended.inward;
}

void TileCloud::take_sample(const std::string& round) {
  const auto take = [&](std::size_t tile) {
    const auto scene = load_for(tile, std::max(2 * kCircle, around_));
    const double share = static_cast<double>(scene->n_own) / static_cast<double>(points_);
    const auto wanted = static_cast<std::size_t>(std::ceil(share * kSamples));
    return sample_tile(*scene, std::max(wanted, kSamplesOfTile), around_, stages_.context());
  };
  sample_ = join(stages_.values<SamplePoint>({"sample", n_, {round}}, take));
}

void TileCloud::choose_size(const std::string& round) {
  const std::size_t pilots = std::min(n_, kPilots);
  const auto choose = [&](std::size_t pilot) {
    const auto scene = load(pilot * n_ / pilots);
    return std::vector{choose_cap_size(scene->ordered(), kDegree, stages_.context())};
  };
  size_ = median_of(stages_.values<CapSize>({"cap size", pilots, {round}}, choose));
  if (options_.noise) size_.noise = *options_.noise;
}

}  // namespace rholm
