#include "model/bricks/brick_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atlas/cover/cap_cover.h"
#include "atlas/cover/cap_size.h"
#include "base/log_histogram.h"
#include "model/bricks/brick_caps.h"
#include "model/bricks/brick_fit.h"
#include "model/bricks/brick_handles.h"
#include "model/bricks/brick_holes.h"
#include "model/bricks/brick_normals.h"
#include "model/bricks/brick_opening.h"
#include "model/bricks/brick_outliers.h"
#include "model/bricks/brick_output.h"
#include "model/bricks/brick_parts.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_points.h"
#include "model/bricks/brick_removal.h"
#include "model/bricks/brick_seen.h"
#include "model/bricks/brick_simplify.h"
#include "model/bricks/brick_surface.h"
#include "model/bricks/brick_winding.h"
#include "model/points/reconstruct_rules.h"
#include "model/points/surface_confidence.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "shape/points/local_shape.h"
#include "shape/points/normals.h"
#include "shape/points/scan_labels.h"
#include "shape/points/sensors.h"
#include "shape/points/sign_check.h"
#include "surface/atlas_surface.h"
#include "surface/level_set/cut_handles.h"

namespace rholm {
namespace {

// Points that speak for all; at least so many of each brick.
constexpr std::size_t kSamples = 2000, kSamplesOfBrick = 16;
// Bricks in which the size of caps is looked for: the median counts.
constexpr std::size_t kPilots = 5;
// Caps are tried with up to so many neighbours there before the halo ends.
constexpr std::size_t kTried = 128;
// Winding trees in memory at a time: those around one brick.
constexpr std::size_t kTrees = 24;
// Of the spacing: scatter of points about their surface below which winding numbers are asked.
constexpr double kExact = 0.25;

// What the stages cost, us a point on one thread: measured on 4 million points (bench/bricks), but
// for confidence and simplify, which are chosen.
std::vector<StageCost> costs(const ReconstructOptions& options) {
  std::vector<StageCost> all = {
      {"survey", 0.05},  {"signs", 0.8},   {"distribute", 0.1}, {"sort", 0.2}, {"sample", 0.3},
      {"cap size", 0.3}, {"caps", 2.1},    {"bands", 0.1},      {"grid", 2.2}, {"holes", 0.8},
      {"surface", 3.0},  {"handles", 0.3}, {"parts", 0.4},      {"write", 1.2}};
  if (options.remove_outliers) all.push_back({"strays", 0.9});
  if (options.confidence) all.push_back({"confidence", 2});
  if (options.simplify) all.push_back({"simplify", 5});
  return all;
}

class BrickRun {
 public:
  BrickRun(PointSource& source, PieceStore& store, const BrickRunOptions& options, BrickCrew& crew,
           const Context& context)
      : source_(source),
        store_(store),
        options_(options.reconstruct),
        stages_(crew, costs(options_), report_.times, context),
        context_(stages_.context()) {
    stages_.once("survey", [&] { find_survey(options.points_per_brick); });
    survey_ = read_survey(store_).value();
    plan_ = make_plan(survey_, options.points_per_brick);
    n_ = plan_.n_bricks();
    if (!survey_.layout.normals) stages_.add(costs_of_normals());
    if (options.foreseen) options.foreseen(survey_, n_);
    model_ = options.model, open_blocks_ = options.open_blocks;
  }

  BrickReconstruction run(const std::filesystem::path& output) {
    sort();
    if (options_.remove_outliers) remove_strays();
    orient();
    check_normals();
    count_points();
    sample();
    choose_size("size");
    BrickCaps caps = fit();
    set_scene(caps);
    BrickWinding winding(caps, n_, kTrees);
    BrickSurface surface(store_, plan_, caps, winding, origin_);
    make_surface(surface, winding);
    join_and_write(surface, output);
    if (!model_.empty()) stages_.once("model", [&] { write_model_of(caps); });
    return {.report = std::move(report_),
            .bounds = survey_.bounds,
            .bricks = n_,
            .vertices = whole_.vertices,
            .triangles = whole_.triangles,
            .coefficients = coefficients_,
            .stored = store_.most_bytes(),
            .warnings = source_.warnings()};
  }

 private:
  void find_survey(std::uint64_t points_per_brick) {
    if (read_survey(store_)) return;
    write_survey(
        survey(source_,
               {.points_per_brick = points_per_brick, .drop_far_strays = options_.remove_outliers},
               context_),
        store_);
  }

  template <class T>
  void put(const std::string& name, const std::vector<T>& values) {
    const std::span<const std::byte> sections[] = {bytes_of(values)};
    store_.write(name, sections);
  }
  template <class T>
  std::vector<T> get(const std::string& name) const {
    return store_.open(name).values<T>(0);
  }

  void sort() {
    stages_.once("distribute", [&] { distribute(source_, survey_, plan_, store_, {}, context_); });
    stages_.each("sort", n_, [&](std::size_t brick) { sort_points(store_, brick); });
    if (options_.align_scans && has_column("scan")) {
      stages_.once("sort", [&] {
        if (store_.has("scans")) return;
        refuse_scans();
        put("scans", std::vector<std::uint8_t>{1});
      });
    }
    report_.points = survey_.points + survey_.not_finite + survey_.far_strays;
    report_.outliers = survey_.far_strays;
    spacings_ = spacings_of_sample(survey_, plan_, survey_.n_different);
  }

  // Before outliers near the surface are removed, also where a run before has done it.
  void count_points() {
    stages_.once("count", [&] {
      if (store_.has("counted")) return;
      std::uint64_t n = 0;
      for (std::size_t brick = 0; brick < n_; ++brick) n += read_index(store_, brick).counts.points;
      const std::vector<double> box = {bounds_of_bricks(store_, plan_).diagonal(),
                                       lie_on_line(store_, plan_, kLine) ? 1.0 : 0.0};
      const std::span<const std::byte> sections[] = {
          bytes_of(std::span<const std::uint64_t>(&n, 1)), bytes_of(box)};
      store_.write("counted", sections);
    });
    const PieceReader counted = store_.open("counted");
    points_ = counted.values<std::uint64_t>(0).at(0);
    report_.dropped_points = report_.points - report_.outliers - points_;
    const std::vector<double> box = counted.values<double>(1);
    check_spread(points_, box.at(0));
    if (box.at(1) != 0) refuse_one_line(points_);
  }

  // Scans are brought together by all their points.
  void refuse_scans() const {
    std::vector<double> different;
    for (std::size_t brick = 0; brick < n_; ++brick) {
      PointCloud cloud = read_points(store_, brick);
      std::erase_if(cloud.attributes, [](const Attribute& a) { return a.name != "scan"; });
      if (!add_scans(cloud.attributes.front().values, different)) return;
    }
    if (different.size() < 2) return;
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the points are {} scans, which are brought together in one piece only "
                            "(without bricks); --keep-scans takes them as they are",
                            different.size()));
  }

  void remove_strays() {
    BrickRemoval strays(store_, plan_, "strays");
    stages_.each("strays", n_, [&](std::size_t brick) {
      if (strays.has_found(brick)) return;
      const double halo = spacings_[brick] * reach_of(kTried);
      strays.put(brick, find_brick_strays(store_, plan_, brick, halo, context_));
    });
    stages_.each("strays", n_, [&](std::size_t brick) { strays.remove(brick); });
    report_.outliers += strays.count();
  }

  BrickScene load(std::size_t brick, std::size_t neighbours) const {
    return load_brick(store_, plan_, brick, spacings_[brick] * reach_of(neighbours), turned_,
                      context_);
  }

  // Points that have no normals get them.
  void orient() {
    if (survey_.layout.normals) return;
    const BrickNormalsReport normals =
        orient_bricks(store_, plan_, spacings_, {.sensor = options_.sensor}, stages_);
    report_.computed_normals = true;
    report_.unsure = static_cast<double>(normals.unsure) / static_cast<double>(normals.points);
    BrickRemoval undetermined(store_, plan_, "undetermined");
    stages_.each("turn", n_, [&](std::size_t brick) {
      if (undetermined.has_found(brick)) return;
      std::vector<std::uint8_t> flags;
      for (const BrickNormal& normal : read_normals(store_, brick)) {
        flags.push_back(normal.normal() == Vec3{} ? 1 : 0);
      }
      undetermined.put(brick, flags);
    });
    stages_.each("turn", n_, [&](std::size_t brick) { undetermined.remove(brick); });
  }

  // Of given normals and of computed ones. They are not turned here: that takes all points at once.
  void check_normals() {
    struct Found {
      std::uint64_t contradicting = 0;
      double scatter = 0;
      Vec3 first;
    };
    const auto name_of = [](std::size_t brick) { return "signs-checked/" + std::to_string(brick); };
    stages_.each("signs", n_, [&](std::size_t brick) {
      if (store_.has(name_of(brick))) return;
      const BrickScene scene = load(brick, 2 * kGraphNeighbors);
      Found found;
      if (scene.n_own > 0) {
        const SignCheck check = check_signs(*scene.tree, scene.points, scene.normals, scene.gaps,
                                            {}, scene.foreign, context_);
        found = {check.contradicting, check.scatter, scene.points[check.first]};
      }
      put(name_of(brick), std::vector{found});
    });
    std::vector<double> scatters;
    for (std::size_t brick = 0; brick < n_; ++brick) {
      const Found found = get<Found>(name_of(brick)).at(0);
      if (found.contradicting > 0 && report_.contradicting_normals == 0) {
        report_.contradiction = found.first;
      }
      report_.contradicting_normals += found.contradicting;
      scatters.push_back(found.scatter);
    }
    std::sort(scatters.begin(), scatters.end());
    scatter_ = scatters[scatters.size() / 2];
  }

  void sample() {
    sample_ = take_sample("sample");
    turned_ = survey_.layout.normals && sample_.sides.inwards;
    // Noisy points stand for less than their nearest neighbours tell.
    const bool exact = scatter_ < kExact * sample_.median;
    if (survey_.layout.normals && exact && !is_open()) {
      report_.inward_normals = turned_ ? 0 : sample_.inward;
    }
    report_.turned_normals = turned_;
    if (!is_open()) check_sides(sample_.sides, points_);
  }

  WholeSample take_sample(const std::string& round) {
    const auto name_of = [&](std::size_t brick) { return round + "/" + std::to_string(brick); };
    stages_.each("sample", n_, [&](std::size_t brick) {
      if (store_.has(name_of(brick))) return;
      const BrickScene scene = load(brick, 2 * kCircle);
      const double share = static_cast<double>(scene.n_own) / static_cast<double>(points_);
      const auto wanted = static_cast<std::size_t>(std::ceil(share * kSamples));
      put(name_of(brick), sample_brick(scene, std::max(wanted, kSamplesOfBrick), context_));
    });
    std::vector<SamplePoint> all;
    for (std::size_t brick = 0; brick < n_; ++brick) {
      for (const SamplePoint& point : get<SamplePoint>(name_of(brick))) all.push_back(point);
    }
    return join(all);
  }

  // Bricks of a surface are parts of one.
  void check_brick_shape(const BrickScene& scene) const {
    const LocalShape shape = look_at_shape(*scene.tree, scene.points, scene.normals, context_);
    check_shape(shape, scene.points.size());
    if (!(shape.crooked > kMostCrooked) || scene.computed_normals) return;
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{:.3g} % of the normals in a brick are more than 45 degrees off the "
                            "surface: give points without normals, they are computed then",
                            100 * shape.crooked));
  }

  void choose_size(const std::string& round) {
    const std::size_t pilots = std::min(n_, kPilots);
    const auto name_of = [&](std::size_t pilot) { return round + "/" + std::to_string(pilot); };
    stages_.each("cap size", pilots, [&](std::size_t pilot) {
      if (store_.has(name_of(pilot))) return;
      const BrickScene scene = load(pilot * n_ / pilots, kTried);
      check_brick_shape(scene);
      put(name_of(pilot), std::vector{choose_cap_size(scene.ordered(), kDegree, context_)});
    });
    std::vector<CapSize> sizes;
    sizes.reserve(pilots);
    for (std::size_t pilot = 0; pilot < pilots; ++pilot) {
      sizes.push_back(get<CapSize>(name_of(pilot)).at(0));
    }
    size_ = median_of(sizes);
    if (options_.noise) size_.noise = *options_.noise;
  }

  // Caps for the points, without those near the surface that belong to none.
  BrickCaps fit() {
    const auto n = static_cast<double>(points_), strays = static_cast<double>(report_.outliers);
    const bool asked = options_.remove_outliers && survey_.layout.normals;
    const double wrong = asked ? n * sample_.wrong : 0;
    if (!are_suspicious(n, strays, wrong)) return fit_round("");
    OutlierSearch search{.n_points = points_,
                         .most = most_outliers(strays, wrong),
                         .noise = size_.noise,
                         .load = [&](std::size_t brick) { return load(brick, kTried); }};
    const auto remove = [&] { return remove_brick_outliers(store_, plan_, search, stages_); };
    std::uint64_t found = remove();
    const bool at_once = found > 0;
    if (!at_once) {
      BrickCaps caps = fit_round("");
      std::uint64_t rejected = 0, n_caps = 0;
      for (std::size_t brick = 0; brick < n_; ++brick) {
        rejected += caps.rejected(brick).size();
        n_caps += caps.extent(brick).n;
      }
      search.most = 2 * rejected;
      search.suspects = [&](std::size_t brick) { return caps.rejected(brick); };
      found = remove();
      if (found == 0 && n_caps > 0) return caps;
    }
    report_.outliers += found;
    sample_ = take_sample("sample-again");
    choose_size("size-again");
    return fit_round(at_once ? "" : "-again");
  }

  BrickCaps fit_round(const std::string& round) {
    BrickCaps caps(store_, n_, round);
    stages_.each("caps", n_, [&](std::size_t brick) {
      if (caps.has(brick)) return;
      const BrickScene scene = load(brick, size_.neighbours);
      CoverOptions wanted = cover_options(options_, size_);
      wanted.foreign = scene.foreign;
      const Cover found = cover(scene.ordered(), wanted, context_);
      std::vector<std::uint32_t> rejected;
      for (const std::uint32_t i : found.rejected) {
        if (scene.foreign[i] == 0) rejected.push_back(scene.tree->order()[i]);
      }
      std::sort(rejected.begin(), rejected.end());
      caps.write_rejected(brick, rejected);
      caps.write(brick, found, context_);
    });
    caps.read_extents();
    return caps;
  }

  void set_scene(BrickCaps& caps) {
    report_.spacing = sample_.median;
    report_.points_area = sample_.area;
    report_.noise = size_.noise;
    report_.normal_noise_degrees = size_.normal_noise * 180 / std::numbers::pi;
    report_.neighbours = size_.neighbours;
    LogHistogram errors, supports;
    Bounds middles;
    for (std::size_t brick = 0; brick < n_; ++brick) {
      const CapExtent& extent = caps.extent(brick);
      if (extent.n == 0) continue;
      middles = report_.caps == 0 ? extent.middles : joined(middles, extent.middles);
      report_.caps += extent.n;
      coefficients_ += extent.coefficients;
      for (const CapPatch& patch : caps.patches(brick)) {
        errors.add(patch.error, patch.area);
        supports.add(patch.support);
      }
    }
    if (report_.caps == 0) {
      throw Error(ErrorCode::kInvalidInput,
                  fmt::format("no surface goes with these {} points: no cap fits any of them; are "
                              "their normals right (rholm orient)?",
                              points_));
    }
    median_support_ = supports.quantile(0.5);
    origin_ = middles.min;
    const bool even = is_even(size_, options_);
    report_.step =
        options_.step > 0
            ? options_.step
            : choose_step(sample_.fine,
                          even ? errors.quantile(1 - kSparseShare) : supports.quantile(0.2), even);
    Atlas scene;
    scene.spacing = sample_.median, scene.noise = size_.noise;
    scene.diagonal = survey_.bounds.diagonal(), scene.blend = options_.blend;
    scene.band = kBandOfNoise * size_.noise;
    caps.set_scene(scene, report_.step);
    if (!caps.have_bands()) return;
    stages_.each("bands", n_, [&](std::size_t brick) {
      if (!caps.has_bands(brick)) caps.find_bands(brick, context_);
    });
  }

  void make_surface(BrickSurface& surface, const BrickWinding& winding) {
    stages_.each("grid", n_, [&](std::size_t brick) {
      if (!surface.has_values(brick)) surface.find_values(brick, context_);
    });
    const std::optional<BrickSeen> sight = look();
    BrickHoles filled(store_, surface, winding, n_, open_blocks_);
    std::optional<SeenSpace> seen;
    do {
      stages_.each("holes", filled.n_portions(), [&](std::size_t portion) {
        if (filled.is_closed(portion)) return;
        if (sight && !seen) seen = sight->join(context_);
        filled.close(portion, options_.max_memory / block_grid_bytes(1), seen ? &*seen : nullptr,
                     context_);
      });
      stages_.once("holes", [&] { filled.find_conflicts(); });
    } while (filled.take_next_round());
    stages_.once("holes", [&] {
      if (store_.has("holes")) return;
      const HoleFilling filling = filled.join();
      put("holes", std::vector<std::uint64_t>{filling.holes, filling.smooth});
    });
    const std::vector<std::uint64_t> holes = get<std::uint64_t>("holes");
    report_.holes = holes.at(0), report_.smooth_holes = holes.at(1);
    const double typical = std::max(sample_.median, report_.step);
    BrickHandles handles(store_, surface, n_, typical,
                         [&](std::size_t brick, const std::vector<Vec3>& places) {
                           std::vector<double> found = spacings_at(load(brick, kTried), places);
                           for (double& spacing : found) spacing = std::max(spacing, report_.step);
                           return found;
                         });
    stages_.each("surface", n_, [&](std::size_t brick) {
      if (handles.has(brick)) return;
      handles.find(brick, surface.extract(brick, is_open(), context_), context_);
    });
    forget_caps(filled);
    stages_.once("handles", [&] { handles.cut(context_); });
    report_.cut_handles = surface.take_round(kCutRound);
    if (is_open()) cut_open(surface);
  }

  bool has_column(const char* name) const {
    const auto& columns = survey_.layout.columns;
    return std::any_of(columns.begin(), columns.end(),
                       [&](const ColumnLayout& column) { return column.name == name; });
  }

  // Along the lines of sight to all points, where it is known from where they were measured.
  std::optional<BrickSeen> look() {
    const bool known = std::all_of(kSensorAxes.begin(), kSensorAxes.end(),
                                   [&](const char* axis) { return has_column(axis); });
    if (is_open() || !(known || options_.sensor)) return std::nullopt;
    BrickSeen seen(store_, n_,
                   {.box = bounds_of_bricks(store_, plan_),
                    .edge = kCubesOfSpacing * sample_.median,
                    .margin = kEndOfSight * std::max(sample_.median, size_.noise),
                    .sensor = options_.sensor});
    stages_.each("sight", n_, [&](std::size_t brick) {
      if (!seen.has(brick)) seen.find(brick, context_);
    });
    return seen;
  }

  // What no later step needs, unless a run after this one may begin again before them. Ranks that
  // have joined a store keep it: its owner decides.
  void forget_caps(BrickHoles& filled) {
    stages_.once("surface", [&] {
      if (store_.is_kept()) return;
      filled.forget();
      for (std::size_t brick = 0; brick < n_; ++brick) {
        const auto forget = [&](const char* what) {
          store_.remove(std::string(what) + "/" + std::to_string(brick));
        };
        for (const char* what : {"grid", "rim", "open", "closed"}) forget(what);
        if (!model_.empty()) continue;
        for (const char* what :
             {"caps", "caps-again", "patches", "patches-again", "bands", "bands-again"}) {
          forget(what);
        }
      }
    });
  }

  bool is_open() const { return options_.holes == HolePolicy::kKeep; }

  void cut_open(BrickSurface& surface) {
    BrickOpening opening(store_, surface, n_);
    stages_.each("open", n_, [&](std::size_t brick) {
      if (!opening.has(brick)) opening.find(brick);
    });
    stages_.once("open", [&] { opening.cut(least_hole(median_support_), context_); });
    surface.take_round(kOpenRound);
  }

  BrickParts::Whole join_parts(BrickParts& parts, double least_share) {
    stages_.each("parts", n_, [&](std::size_t brick) {
      if (!parts.has(brick)) parts.find(brick, context_);
    });
    BrickParts::Whole whole;
    stages_.all("parts", [&] { whole = parts.join(least_share); });
    return whole;
  }

  void join_and_write(BrickSurface& surface, const std::filesystem::path& output) {
    BrickParts parts(store_, surface, n_);
    const BrickParts::Whole whole = join_parts(parts, options_.min_component);
    report_.dropped_components = whole.dropped;
    report_.faces = whole.triangles;
    set_sizes(whole, whole);
    if (!options_.simplify) {
      write(parts, output);
      return;
    }
    simplify(surface, parts);
    BrickParts simple(store_, surface, n_, "-simple");
    set_sizes(join_parts(simple, 0), whole);
    write(simple, output);
  }

  void write(const BrickParts& parts, const std::filesystem::path& output) {
    const BrickOutput out(store_, stages_, options_, survey_.layout, n_,
                          [&](std::size_t brick) { return load(brick, kTried); });
    if (options_.confidence) put_areas(out.measure_confidence(parts), report_);
    out.write(parts, whole_, output);
  }

  // What closes holes has the share of the area that it had before it was simplified.
  void set_sizes(const BrickParts::Whole& whole, const BrickParts::Whole& before) {
    whole_ = whole;
    report_.area = whole.area, report_.volume = whole.volume;
    // About the middle: the same of any place where it is closed.
    if (is_open()) {
      const Vec3 middle = 0.5 * survey_.bounds.min + 0.5 * survey_.bounds.max;
      report_.volume -= dot(middle - origin_, whole.area_vector) / 3;
    }
    if (!is_open() && before.area > 0) {
      report_.closed_area = before.closed_area / before.area * whole.area;
    }
  }

  void simplify(BrickSurface& surface, const BrickParts& parts) {
    BrickSimplify less(store_, surface, parts, n_,
                       {.stops = simplify_stops(*options_.simplify, report_.step),
                        .triangles = report_.faces,
                        .step = report_.step});
    if (less.wants_curves()) {
      stages_.each("simplify", n_, [&](std::size_t brick) {
        if (!less.has_curve(brick)) less.find_curve(brick, context_);
      });
    }
    stages_.all("simplify", [&] { less.choose(); });
    for (std::size_t level = 0; level < less.n_levels(); ++level) {
      stages_.all("simplify", [&] { less.begin(level); });
      stages_.each("simplify", less.n_groups(), [&](std::size_t group) {
        if (!less.has(group)) less.work(group, context_);
      });
      stages_.once("simplify", [&] { less.end(); });
      less.take();
    }
    report_.simplify_error = less.error();
  }

  void write_model_of(const BrickCaps& caps) const {
    const std::uint64_t bytes = 2 * (report_.caps * sizeof(Cap) + coefficients_ * sizeof(double));
    if (bytes > options_.max_memory) {
      throw Error(ErrorCode::kOutOfMemory,
                  fmt::format("a model of {} caps needs {:.2g} GiB", report_.caps,
                              static_cast<double>(bytes) / 0x1p30));
    }
    write_atlas({.atlas = caps.all(),
                 .step = report_.step,
                 .tolerance = options_.tolerance,
                 .errors = {},
                 .input_numbers = 3 * report_.points,
                 .unit = {},
                 .method = "reconstruct"},
                model_);
  }

  PointSource& source_;
  PieceStore& store_;
  const ReconstructOptions& options_;
  ReconstructReport report_;
  BrickStages stages_;
  const Context& context_;  // of the stage that runs
  Survey survey_;
  BrickPlan plan_;
  std::size_t n_ = 0;             // bricks
  std::uint64_t points_ = 0;      // that differ
  std::vector<double> spacings_;  // in each brick
  WholeSample sample_;
  double scatter_ = 0;   // of the points about their surface
  bool turned_ = false;  // normals
  CapSize size_;
  double median_support_ = 0;       // of caps
  Vec3 origin_;                     // of the grid
  std::uint64_t coefficients_ = 0;  // of all caps
  BrickParts::Whole whole_;
  std::filesystem::path model_;
  std::size_t open_blocks_ = 0;
};

}  // namespace

BrickReconstruction run_bricks(PointSource& source, PieceStore& store,
                               const std::filesystem::path& output, const BrickRunOptions& options,
                               BrickCrew& crew, const Context& context) {
  check(options.reconstruct);
  return BrickRun(source, store, options, crew, context).run(output);
}

}  // namespace rholm
