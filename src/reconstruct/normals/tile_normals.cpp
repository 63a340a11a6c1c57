#include "reconstruct/normals/tile_normals.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/refuse.h"
#include "base/stopwatch.h"
#include "reconstruct/caps/tile_caps.h"
#include "reconstruct/normals/tile_directions.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/normals/tile_signs.h"
#include "rholm/points.h"
#include "shape/points/normals.h"
#include "shape/points/orient_rules.h"
#include "shape/points/orient_scene.h"
#include "shape/points/orient_sight.h"
#include "shape/points/orient_signs.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

constexpr const char* kOriented = "oriented";
constexpr std::size_t kPilots = 5;  // tiles that are asked for the neighbours of a fit
// Rings of neighbours that tiles share, so that pieces hold together in the halo too.
constexpr double kSharedRings = 2;
constexpr double kUnsure = 0.5;
// Part of the diagonal within which points lie on one line, as in orient() (orient_scene.cpp).
constexpr double kLineOfFits = 1e-6;

std::string normals_name(std::size_t tile) { return "normals/" + std::to_string(tile); }

TileNormal make_normal(const Vec3& n, double confidence) {
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
          norm(n) > 0 ? static_cast<float>(confidence) : 0};
}

void write_normals(PieceStore& store, std::size_t tile, const std::vector<TileNormal>& normals) {
  TileNormalsReport counts{.points = normals.size()};
  for (const TileNormal& n : normals) {
    counts.undetermined += n.normal() == Vec3{} ? 1 : 0;
    counts.unsure += n.confidence < kUnsure ? 1 : 0;
  }
  const std::span<const std::byte> sections[] = {
      bytes_of(normals), bytes_of(std::span<const TileNormalsReport>(&counts, 1))};
  store.write(normals_name(tile), sections);
}

TileNormalsReport only(const std::vector<TileNormalsReport>& list) {
  if (list.size() != 1) refuse("a piece with normals of a tile does not fit; begin the run anew");
  return list.front();
}

// Returns the counts that write_normals() stored.
TileNormalsReport read_counts(PieceStore& store, std::size_t tile) {
  return only(store.open(normals_name(tile)).values<TileNormalsReport>(1));
}

void write_oriented(PieceStore& store, const TileNormalsReport& report) {
  const std::span<const std::byte> sections[] = {
      bytes_of(std::span<const TileNormalsReport>(&report, 1))};
  store.write(kOriented, sections);
}

}  // namespace

std::vector<TileNormal> read_normals(const PieceStore& store, std::size_t tile) {
  return store.open(normals_name(tile)).values<TileNormal>(0);
}

void remove_normals(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags) {
  std::vector<TileNormal> normals = read_normals(store, tile), kept;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (flags.at(i) == 0) kept.push_back(normals[i]);
  }
  write_normals(store, tile, kept);
}

bool have_normals(const PieceStore& store) { return store.has(kOriented); }

std::size_t normal_neighbors(const PieceStore& store) {
  if (!have_normals(store)) return 0;
  return only(store.open(kOriented).values<TileNormalsReport>(0)).neighbors;
}

TileNormals::TileNormals(PieceStore& store, const TilePlan& plan, std::vector<double> spacings,
                         const TileNormalsOptions& options)
    : store_(store), plan_(plan), spacings_(std::move(spacings)), options_(options) {
  for (std::size_t tile = 0; tile < plan.n_tiles(); ++tile) {
    n_points_ += read_index(store, tile).counts.points;
  }
}

BareTile TileNormals::load(std::size_t tile, double reach, const Context& context) const {
  return load_bare(store_, plan_, tile, reach * spacings_[tile], context);
}

void TileNormals::refuse_points_on_line() const {
  if (lie_on_line(store_, plan_, kLineOfFits)) refuse_line(n_points_);
}

void TileNormals::choose_neighbors(const Context& context) {
  const std::size_t n = plan_.n_tiles(), pilots = std::min(n, kPilots);
  std::vector<int> chosen;
  for (std::size_t k = 0; k < pilots; ++k) {
    BareTile scene = load(k * n / pilots, 0, context);
    if (scene.points.empty()) continue;
    find_gaps(scene, context);
    chosen.push_back(rholm::choose_neighbors(*scene.tree, scene.points, scene.gaps, context));
  }
  std::sort(chosen.begin(), chosen.end());
  n_neighbors_ = chosen.empty() ? kGraphNeighbors : chosen[chosen.size() / 2];
}

void TileNormals::find_directions(std::size_t tile, const Context& context) {
  if (store_.has(directions_name(tile))) return;
  BareTile bare = load(tile, reach_of_fits(n_neighbors_), context);
  find_gaps(bare, context);
  const std::vector<PointDirection> directions = fit_directions(bare, n_neighbors_, context);
  PointCloud& own = bare.read.cloud;
  own.points.resize(bare.read.n_own);
  for (Attribute& attribute : own.attributes) attribute.values.resize(bare.read.n_own);
  const std::uint8_t seen = own.points.empty() || !sensors_of(own).empty() ? 1 : 0;
  const std::span<const std::byte> sections[] = {bytes_of(directions),
                                                 bytes_of(std::span<const std::uint8_t>(&seen, 1))};
  store_.write(directions_name(tile), sections);
}

bool TileNormals::by_sight() {
  if (by_sight_) return *by_sight_;
  by_sight_ = true;
  for (std::size_t tile = 0; !options_.sensor && tile < plan_.n_tiles(); ++tile) {
    const auto seen = store_.open(directions_name(tile)).values<std::uint8_t>(1);
    if (seen.empty() || seen.front() == 0) by_sight_ = false;
  }
  return *by_sight_;
}

void TileNormals::find_signs(std::size_t tile, const Context& context) {
  if (by_sight() || store_.has(signs_name(tile))) return;
  BareTile scene = load(tile, kSharedRings * reach_of(kGraphNeighbors), context);
  put_graph(store_, tile, n_neighbors_, scene, context);
  write_signs(store_, tile,
              scene.points.empty() ? TileSigns{} : find_tile_signs(scene, points_per_sample()));
}

void TileNormals::match(std::size_t tile) {
  if (by_sight() || store_.has(votes_name(tile))) return;
  const std::vector<SharedVotes> votes = match_signs(store_, tile);
  const std::span<const std::byte> sections[] = {bytes_of(votes)};
  store_.write(votes_name(tile), sections);
}

void TileNormals::join(const Context& context) {
  if (by_sight()) return;
  sides_ = join_sides(store_, plan_.n_tiles(), context);
  // Samples far apart do not see thin parts that all points show.
  if (points_per_sample() == 1) return;
  const std::size_t n = sides_.samples.size();
  std::vector<Vec3> sample_normals(n);
  for (std::size_t s = 0; s < n; ++s) sample_normals[s] = sides_.samples[s].normal;
  const DoubtScene scene = doubt_scene();
  sides_.doubtful = doubtful_share(
      scene, kClearOfPatches, spread_of_graph(n_neighbors_),
      [&](std::size_t tile) { return joined_normals(scene, tile); }, sample_normals, context);
}

std::uint64_t TileNormals::points_per_sample() const {
  return (n_points_ + options_.samples - 1) / options_.samples;
}

DoubtScene TileNormals::doubt_scene() const {
  return {store_, plan_, spacings_, sides_, n_neighbors_, points_per_sample()};
}

bool TileNormals::wants_field() const {
  return !by_sight_.value_or(false) && (sides_.doubtful > kDoubtfulGraph || sides_.in_rows);
}

TileField TileNormals::field() const {
  return TileField(store_, plan_, spacings_, n_points_, n_neighbors_);
}

void TileNormals::take(TileField field, const Context& context) {
  field_.emplace(std::move(field));
  const std::size_t n = sides_.samples.size();
  std::vector<Vec3> places(n);
  for (std::size_t s = 0; s < n; ++s) places[s] = sides_.samples[s].point;
  samples_ = std::make_unique<PointTree>(places, context);
}

void TileNormals::turn(std::size_t tile, const Context& context) {
  if (store_.has(normals_name(tile))) return;
  if (by_sight()) {
    turn_by_sight(tile, context);
  } else if (field_) {
    turn_by_field(tile);
  } else {
    turn_by_sides(tile);
  }
}

void TileNormals::turn_by_sight(std::size_t tile, const Context& context) {
  BareTile scene = load(tile, reach_of(kGraphNeighbors), context);
  std::vector<TileNormal> normals(scene.read.n_own);
  if (!scene.points.empty()) {
    put_graph(store_, tile, n_neighbors_, scene, context);
    const std::vector<Vec3> given = options_.sensor
                                        ? std::vector<Vec3>(scene.points.size(), *options_.sensor)
                                        : sensors_of(scene.read.cloud);
    std::vector<Vec3> sensors(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) sensors[i] = given[scene.tree->order()[i]];
    OrientSigns signs = rholm::turn_by_sight(scene.points, scene.fits, sensors, false);
    turn_glancing(scene.points, scene.fits, signs);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      if (scene.foreign[i] != 0) continue;
      normals[scene.tree->order()[i]] =
          make_normal(signs.normals[i], confidence_of(static_cast<double>(signs.agreement[i])));
    }
  }
  write_normals(store_, tile, normals);
}

void TileNormals::turn_by_sides(std::size_t tile) {
  const TileSigns signs = read_signs(store_, tile);
  const std::vector<PointDirection> directions = read_directions(store_, tile);
  const auto turned = [&](std::uint32_t piece) {
    return sides_.turned.at(sides_.first[tile] + piece) != 0;
  };
  std::vector<double> sum(signs.within.begin(), signs.within.end());
  for (const TileSigns::Across& edge : signs.across) {
    const bool against = turned(signs.codes.at(edge.point).piece()) != turned(edge.other);
    sum[edge.point] += static_cast<double>(against ? -edge.agreement : edge.agreement);
  }
  std::vector<TileNormal> normals(signs.codes.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const PieceCode code = signs.codes[i];
    const PointDirection& own = directions.at(i);
    const Vec3 direction{own.x, own.y, own.z};
    const bool against = code.opposite() != turned(code.piece());
    const double agreement = signs.edges[i] > 0 ? std::max(0.0, sum[i] / signs.edges[i]) : 0;
    const double trust = static_cast<double>(sides_.trust[sides_.first[tile] + code.piece()]);
    normals[i] = make_normal(against ? -direction : direction, confidence_of(agreement * trust));
  }
  write_normals(store_, tile, normals);
}

void TileNormals::turn_by_field(std::size_t tile) {
  const PointCloud own = read_points(store_, tile);
  const std::vector<SheetNormal> sheets = field_->read_sheets(tile);
  std::vector<TileNormal> normals(sheets.size());
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const SheetNormal& sheet = sheets[i];
    samples_->nearest(own.points.at(i), 1, near);
    const double trust = field_->trust()[samples_->order()[near.front().index]];
    normals[i] = make_normal({sheet.x, sheet.y, sheet.z},
                             confidence_of(static_cast<double>(sheet.agreement) * trust));
  }
  write_normals(store_, tile, normals);
}

TileNormalsReport TileNormals::report() const {
  TileNormalsReport report{
      .neighbors = static_cast<std::uint64_t>(field_ ? field_->n_neighbors() : n_neighbors_),
      .components = sides_.n_components};
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    const TileNormalsReport own = read_counts(store_, tile);
    report.points += own.points;
    report.undetermined += own.undetermined;
    report.unsure += own.unsure;
  }
  if (report.undetermined == report.points) refuse_line(report.points);
  return report;
}

void TileNormals::finish(const TileNormalsReport& report) {
  write_oriented(store_, report);
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    store_.remove(directions_name(tile));
    store_.remove(signs_name(tile));
    store_.remove(votes_name(tile));
  }
  field().remove();
}

std::vector<StageCost> costs_of_normals() {
  return {{"directions", 3}, {"signs", 4}, {"match", 0.3}, {"sides", 0.5}, {"turn", 0.5}};
}

namespace {

// Computes the normals of the only tile, which has all points, as orient() does.
void orient_only(PieceStore& store, const TileNormalsOptions& options, const Context& context) {
  PointCloud cloud = read_points(store, 0);
  cloud.normals.clear();
  const OrientReport found =
      orient(cloud, {.sensor = options.sensor, .keep_outliers = true, .confidence = true}, context);
  const std::vector<double>& sure = find_attribute(cloud.attributes, "confidence")->values;
  std::vector<TileNormal> normals(cloud.points.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = make_normal(cloud.normals[i], sure[i]);
  }
  write_normals(store, 0, normals);
  TileNormalsReport report = read_counts(store, 0);
  report.neighbors = static_cast<std::uint64_t>(found.neighbors);
  report.components = found.components;
  write_oriented(store, report);
}

}  // namespace

TileNormalsReport orient_tiles(PieceStore& store, const TilePlan& plan,
                               const std::vector<double>& spacings,
                               const TileNormalsOptions& options, Stages& stages) {
  if (have_normals(store)) {
    return only(store.open(kOriented).values<TileNormalsReport>(0));
  }
  const Context& context = stages.context();
  const std::size_t n = plan.n_tiles();
  if (n == 1) {
    stages.once("orient", [&] { orient_only(store, options, context); });
    return only(store.open(kOriented).values<TileNormalsReport>(0));
  }
  TileNormals normals(store, plan, spacings, options);
  normals.refuse_points_on_line();
  stages.all("neighbours", [&] { normals.choose_neighbors(context); });
  stages.each("directions", n, [&](std::size_t b) { normals.find_directions(b, context); });
  stages.each("signs", n, [&](std::size_t b) { normals.find_signs(b, context); });
  stages.each("match", n, [&](std::size_t b) { normals.match(b); });
  stages.all("sides", [&] { normals.join(context); });
  if (normals.wants_field()) {
    TileField field = normals.field();
    stages.each("thin", n, [&](std::size_t b) { field.thin(b, context); });
    bool done = false;
    while (!done && field.next()) {
      stages.all("field", [&] { field.solve(context); });
      stages.each("sheets", n, [&](std::size_t b) { field.find_sheets(b, context); });
      stages.all("sides", [&] { done = field.are_sheets(normals.doubt_scene(), context); });
    }
    if (field.is_better()) normals.take(std::move(field), context);
  }
  stages.each("turn", n, [&](std::size_t b) { normals.turn(b, context); });
  TileNormalsReport report;
  stages.all("turn", [&] { report = normals.report(); });
  stages.once("turn", [&] { normals.finish(report); });
  return report;
}

}  // namespace rholm
