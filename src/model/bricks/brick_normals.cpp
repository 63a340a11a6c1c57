#include "model/bricks/brick_normals.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/refuse.h"
#include "base/stopwatch.h"
#include "model/bricks/brick_caps.h"
#include "model/bricks/brick_directions.h"
#include "model/bricks/brick_fit.h"
#include "model/bricks/brick_signs.h"
#include "shape/points/normals.h"
#include "shape/points/orient_rules.h"
#include "shape/points/orient_scene.h"
#include "shape/points/orient_sight.h"
#include "shape/points/orient_signs.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

constexpr const char* kOriented = "oriented";
constexpr std::size_t kPilots = 5;  // bricks that are asked for the neighbours of a fit
// Rings of neighbours that bricks share: so that parts hold together in the halo too.
constexpr double kSharedRings = 2;
constexpr double kUnsure = 0.5;
// Of the diagonal: as orient() has it (orient_scene.cpp).
constexpr double kLineOfFits = 1e-6;

std::string normals_name(std::size_t brick) { return "normals/" + std::to_string(brick); }

BrickNormal make_normal(const Vec3& n, double confidence) {
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
          norm(n) > 0 ? static_cast<float>(confidence) : 0};
}

void write_normals(PieceStore& store, std::size_t brick, const std::vector<BrickNormal>& normals) {
  BrickNormalsReport counts{.points = normals.size()};
  for (const BrickNormal& n : normals) {
    counts.undetermined += n.normal() == Vec3{} ? 1 : 0;
    counts.unsure += n.confidence < kUnsure ? 1 : 0;
  }
  const std::span<const std::byte> sections[] = {
      bytes_of(normals), bytes_of(std::span<const BrickNormalsReport>(&counts, 1))};
  store.write(normals_name(brick), sections);
}

BrickNormalsReport only(const std::vector<BrickNormalsReport>& list) {
  if (list.size() != 1) refuse("a piece with normals of a brick does not fit; begin the run anew");
  return list.front();
}

}  // namespace

std::vector<BrickNormal> read_normals(const PieceStore& store, std::size_t brick) {
  return store.open(normals_name(brick)).values<BrickNormal>(0);
}

void remove_normals(PieceStore& store, std::size_t brick, const std::vector<std::uint8_t>& flags) {
  std::vector<BrickNormal> normals = read_normals(store, brick), kept;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (flags.at(i) == 0) kept.push_back(normals[i]);
  }
  write_normals(store, brick, kept);
}

bool have_normals(const PieceStore& store) { return store.has(kOriented); }

BrickNormals::BrickNormals(PieceStore& store, const BrickPlan& plan, std::vector<double> spacings,
                           const BrickNormalsOptions& options)
    : store_(store), plan_(plan), spacings_(std::move(spacings)), options_(options) {
  for (std::size_t brick = 0; brick < plan.n_bricks(); ++brick) {
    n_points_ += read_index(store, brick).counts.points;
  }
}

BareBrick BrickNormals::load(std::size_t brick, double reach, const Context& context) const {
  return load_bare(store_, plan_, brick, reach * spacings_[brick], context);
}

void BrickNormals::refuse_points_on_line() const {
  if (lie_on_line(store_, plan_, kLineOfFits)) refuse_line(n_points_);
}

void BrickNormals::choose_neighbors(const Context& context) {
  const std::size_t n = plan_.n_bricks(), pilots = std::min(n, kPilots);
  std::vector<int> chosen;
  for (std::size_t k = 0; k < pilots; ++k) {
    BareBrick scene = load(k * n / pilots, 0, context);
    if (scene.points.empty()) continue;
    find_gaps(scene, context);
    chosen.push_back(rholm::choose_neighbors(*scene.tree, scene.points, scene.gaps, context));
  }
  std::sort(chosen.begin(), chosen.end());
  n_neighbors_ = chosen.empty() ? kGraphNeighbors : chosen[chosen.size() / 2];
}

void BrickNormals::find_directions(std::size_t brick, const Context& context) {
  if (store_.has(directions_name(brick))) return;
  BareBrick bare = load(brick, reach_of_fits(n_neighbors_), context);
  find_gaps(bare, context);
  const std::vector<PointDirection> directions = fit_directions(bare, n_neighbors_, context);
  PointCloud& own = bare.read.cloud;
  own.points.resize(bare.read.n_own);
  for (Attribute& attribute : own.attributes) attribute.values.resize(bare.read.n_own);
  const std::uint8_t seen = own.points.empty() || !sensors_of(own).empty() ? 1 : 0;
  const std::span<const std::byte> sections[] = {bytes_of(directions),
                                                 bytes_of(std::span<const std::uint8_t>(&seen, 1))};
  store_.write(directions_name(brick), sections);
}

bool BrickNormals::by_sight() {
  if (by_sight_) return *by_sight_;
  by_sight_ = true;
  for (std::size_t brick = 0; !options_.sensor && brick < plan_.n_bricks(); ++brick) {
    const auto seen = store_.open(directions_name(brick)).values<std::uint8_t>(1);
    if (seen.empty() || seen.front() == 0) by_sight_ = false;
  }
  return *by_sight_;
}

void BrickNormals::find_signs(std::size_t brick, const Context& context) {
  if (by_sight() || store_.has(signs_name(brick))) return;
  BareBrick scene = load(brick, kSharedRings * reach_of(kGraphNeighbors), context);
  put_graph(store_, brick, n_neighbors_, scene, context);
  write_signs(store_, brick,
              scene.points.empty() ? BrickSigns{} : find_brick_signs(scene, points_per_sample()));
}

void BrickNormals::match(std::size_t brick) {
  if (by_sight() || store_.has(votes_name(brick))) return;
  const std::vector<SharedVotes> votes = match_signs(store_, brick);
  const std::span<const std::byte> sections[] = {bytes_of(votes)};
  store_.write(votes_name(brick), sections);
}

void BrickNormals::join(const Context& context) {
  if (by_sight()) return;
  sides_ = join_sides(store_, plan_.n_bricks(), context);
  // Samples far apart do not see thin parts that all points show.
  if (points_per_sample() == 1) return;
  const std::size_t n = sides_.samples.size();
  std::vector<Vec3> sample_normals(n);
  for (std::size_t s = 0; s < n; ++s) sample_normals[s] = sides_.samples[s].normal;
  const DoubtScene scene = doubt_scene();
  sides_.doubtful = doubtful_share(
      scene, kClearOfPatches, spread_of_graph(n_neighbors_),
      [&](std::size_t brick) { return joined_normals(scene, brick); }, sample_normals, context);
}

std::uint64_t BrickNormals::points_per_sample() const {
  return (n_points_ + options_.samples - 1) / options_.samples;
}

DoubtScene BrickNormals::doubt_scene() const {
  return {store_, plan_, spacings_, sides_, n_neighbors_, points_per_sample()};
}

bool BrickNormals::wants_field() const {
  return !by_sight_.value_or(false) && (sides_.doubtful > kDoubtfulGraph || sides_.in_rows);
}

BrickField BrickNormals::field() const {
  return BrickField(store_, plan_, spacings_, n_points_, n_neighbors_);
}

void BrickNormals::take(BrickField field, const Context& context) {
  field_.emplace(std::move(field));
  const std::size_t n = sides_.samples.size();
  std::vector<Vec3> places(n);
  for (std::size_t s = 0; s < n; ++s) places[s] = sides_.samples[s].point;
  samples_ = std::make_unique<PointTree>(places, context);
}

void BrickNormals::turn(std::size_t brick, const Context& context) {
  if (store_.has(normals_name(brick))) return;
  if (by_sight()) {
    turn_by_sight(brick, context);
  } else if (field_) {
    turn_by_field(brick);
  } else {
    turn_by_sides(brick);
  }
}

void BrickNormals::turn_by_sight(std::size_t brick, const Context& context) {
  BareBrick scene = load(brick, reach_of(kGraphNeighbors), context);
  std::vector<BrickNormal> normals(scene.read.n_own);
  if (!scene.points.empty()) {
    put_graph(store_, brick, n_neighbors_, scene, context);
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
  write_normals(store_, brick, normals);
}

void BrickNormals::turn_by_sides(std::size_t brick) {
  const BrickSigns signs = read_signs(store_, brick);
  const std::vector<PointDirection> directions = read_directions(store_, brick);
  const auto turned = [&](std::uint32_t piece) {
    return sides_.turned.at(sides_.first[brick] + piece) != 0;
  };
  std::vector<double> sum(signs.within.begin(), signs.within.end());
  for (const BrickSigns::Across& edge : signs.across) {
    const bool against = turned(signs.codes.at(edge.point).piece()) != turned(edge.other);
    sum[edge.point] += static_cast<double>(against ? -edge.agreement : edge.agreement);
  }
  std::vector<BrickNormal> normals(signs.codes.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const PieceCode code = signs.codes[i];
    const PointDirection& own = directions.at(i);
    const Vec3 direction{own.x, own.y, own.z};
    const bool against = code.opposite() != turned(code.piece());
    const double agreement = signs.edges[i] > 0 ? std::max(0.0, sum[i] / signs.edges[i]) : 0;
    const double trust = static_cast<double>(sides_.trust[sides_.first[brick] + code.piece()]);
    normals[i] = make_normal(against ? -direction : direction, confidence_of(agreement * trust));
  }
  write_normals(store_, brick, normals);
}

void BrickNormals::turn_by_field(std::size_t brick) {
  const PointCloud own = read_points(store_, brick);
  const std::vector<SheetNormal> sheets = field_->read_sheets(brick);
  std::vector<BrickNormal> normals(sheets.size());
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const SheetNormal& sheet = sheets[i];
    samples_->nearest(own.points.at(i), 1, near);
    const double trust = field_->trust()[samples_->order()[near.front().index]];
    normals[i] = make_normal({sheet.x, sheet.y, sheet.z},
                             confidence_of(static_cast<double>(sheet.agreement) * trust));
  }
  write_normals(store_, brick, normals);
}

BrickNormalsReport BrickNormals::report() const {
  BrickNormalsReport report{
      .neighbors = static_cast<std::uint64_t>(field_ ? field_->n_neighbors() : n_neighbors_),
      .components = sides_.n_components};
  for (std::size_t brick = 0; brick < plan_.n_bricks(); ++brick) {
    const BrickNormalsReport own =
        only(store_.open(normals_name(brick)).values<BrickNormalsReport>(1));
    report.points += own.points;
    report.undetermined += own.undetermined;
    report.unsure += own.unsure;
  }
  if (report.undetermined == report.points) refuse_line(report.points);
  return report;
}

void BrickNormals::finish(const BrickNormalsReport& report) {
  const std::span<const std::byte> sections[] = {
      bytes_of(std::span<const BrickNormalsReport>(&report, 1))};
  store_.write(kOriented, sections);
  for (std::size_t brick = 0; brick < plan_.n_bricks(); ++brick) {
    store_.remove(directions_name(brick));
    store_.remove(signs_name(brick));
    store_.remove(votes_name(brick));
  }
  field().remove();
}

std::vector<StageCost> costs_of_normals() {
  return {{"directions", 3}, {"signs", 4}, {"match", 0.3}, {"sides", 0.5}, {"turn", 0.5}};
}

BrickNormalsReport orient_bricks(PieceStore& store, const BrickPlan& plan,
                                 const std::vector<double>& spacings,
                                 const BrickNormalsOptions& options, BrickStages& stages) {
  if (have_normals(store)) {
    return only(store.open(kOriented).values<BrickNormalsReport>(0));
  }
  BrickNormals normals(store, plan, spacings, options);
  const Context& context = stages.context();
  const std::size_t n = plan.n_bricks();
  normals.refuse_points_on_line();
  stages.all("neighbours", [&] { normals.choose_neighbors(context); });
  stages.each("directions", n, [&](std::size_t b) { normals.find_directions(b, context); });
  stages.each("signs", n, [&](std::size_t b) { normals.find_signs(b, context); });
  stages.each("match", n, [&](std::size_t b) { normals.match(b); });
  stages.all("sides", [&] { normals.join(context); });
  if (normals.wants_field()) {
    BrickField field = normals.field();
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
  BrickNormalsReport report;
  stages.all("turn", [&] { report = normals.report(); });
  stages.once("turn", [&] { normals.finish(report); });
  return report;
}

}  // namespace rholm
