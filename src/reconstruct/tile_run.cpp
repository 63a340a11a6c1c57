#include "reconstruct/tile_run.h"

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
#include "base/check_fields.h"
#include "base/large_vector.h"
#include "base/log_histogram.h"
#include "reconstruct/caps/tile_caps.h"
#include "reconstruct/cloud/tile_cloud.h"
#include "reconstruct/cloud/tile_outliers.h"
#include "reconstruct/field/tile_winding.h"
#include "reconstruct/holes/tile_handles.h"
#include "reconstruct/holes/tile_holes.h"
#include "reconstruct/holes/tile_opening.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/output/surface_confidence.h"
#include "reconstruct/output/tile_output.h"
#include "reconstruct/points/known_spacings.h"
#include "reconstruct/points/reconstruct_rules.h"
#include "reconstruct/points/tile_points.h"
#include "reconstruct/points/tile_seen.h"
#include "reconstruct/surface/tile_parts.h"
#include "reconstruct/surface/tile_simplify.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/atlas_model.h"
#include "rholm/error.h"
#include "rholm/shape_io.h"
#include "shape/measure.h"
#include "shape/points/crossings.h"
#include "shape/points/sensors.h"
#include "shape/points/wall_check.h"
#include "surface/atlas_surface.h"
#include "surface/level_set/cut_handles.h"

namespace rholm {
namespace {

// Number of winding trees in memory at a time: the trees around one tile.
constexpr std::size_t kTrees = 24;
// Costs of the stages in us per point on one thread: measured on 4 million points (bench/tiles).
// The costs of confidence and simplify are chosen.
std::vector<StageCost> costs_of_caps(const ReconstructOptions& options) {
  std::vector<StageCost> all = {{"survey", 0.05}, {"signs", 0.8},    {"distribute", 0.1},
                                {"sort", 0.2},    {"sample", 0.3},   {"cap size", 0.3},
                                {"caps", 2.1},    {"crossings", 0.3}};
  if (!options.keep_outliers) all.push_back({"isolated points", 0.9});
  return all;
}
std::vector<StageCost> costs_of_surface(const ReconstructOptions& options, std::size_t n_tiles) {
  if (n_tiles == 1) return {{"surface", options.simplify ? 11.0 : 6.0}, {"attributes", 0.3}};
  std::vector<StageCost> all = {{"bands", 0.1},   {"grid", 2.2},  {"holes", 0.8}, {"surface", 3.0},
                                {"handles", 0.3}, {"parts", 0.4}, {"walls", 0.2}, {"write", 1.2}};
  if (options.confidence) all.push_back({"confidence", 2});
  if (options.simplify) all.push_back({"simplify", 5});
  return all;
}

class TileRun {
 public:
  TileRun(PointSource& source, PieceStore& store, const TileRunOptions& options, Executor& executor,
          const Context& context)
      : source_(source),
        store_(store),
        options_(options.reconstruct),
        stages_(executor, store, costs_of_caps(options_), report_.times, context),
        context_(stages_.context()),
        cloud_(source, store, options_, options_.tile_points, stages_, report_),
        n_(cloud_.n_tiles()) {
    if (options.foreseen) options.foreseen(cloud_.survey(), n_);
    stages_.add(costs_of_surface(options_, n_));
    open_blocks_ = options.open_blocks;
    rules_ = kept_rules(options_);
    rules_.tiles = n_ > 1;
  }

  Reconstruction run() {
    cloud_.prepare();
    TileCaps caps = fit();
    set_scene(caps);
    report_.bounds = cloud_.survey().bounds;
    report_.tiles = n_;
    report_.coefficients = coefficients_, report_.warnings = source_.warnings();
    Reconstruction made = n_ == 1 ? make_at_once(caps) : make_in_parts(caps);
    made.report = std::move(report_);
    return made;
  }

 private:
  Reconstruction make_in_parts(TileCaps& caps) {
    cloud_.keep_no_scenes();
    find_bands(caps);
    TileWinding winding(caps, n_, kTrees);
    TileSurface surface(store_, cloud_.plan(), caps, winding, origin_);
    make_surface(surface, winding);
    Reconstruction made;
    made.mesh = join_and_write(surface);
    if (keeps_model()) stages_.once("model", [&] { made.model = model_of(caps); });
    report_.stored = store_.most_bytes();
    report_.vertices = whole_.vertices, report_.faces = whole_.faces;
    return made;
  }

  // Makes the surface of the only tile, which has all caps, without parts that must fit each other.
  Reconstruction make_at_once(TileCaps& caps) {
    const std::optional<TileSeen> sight = look();
    std::shared_ptr<TileScene> scene;
    Reconstruction made;
    stages_.once("surface", [&] {
      const std::optional<SeenSpace> seen = sight ? sight->join(context_) : std::nullopt;
      scene = std::make_shared<TileScene>(cloud_.take_only());
      if (!options_.confidence) release(scene->points), release(scene->normals);
      made.model = empty_model();
      made.model.atlas = caps.all();
      caps.forget();
      made.mesh = extract(made.model.atlas, *scene, seen ? &*seen : nullptr);
      if (seen) rules_.seen = seen->kept();
    });
    stages_.once("attributes", [&] { carry(scene, made.mesh); });
    stages_.once("write", [&] {
      made.model.rules = std::move(rules_);
      write(made);
    });
    return made;
  }

  Mesh extract(const Atlas& atlas, const TileScene& scene, const SeenSpace* seen) {
    NotedSpacings noted;
    const Resolution resolution{
        .typical = std::max(cloud_.sample().median, report_.step), .at = [&](const Vec3& place) {
          std::vector<Neighbor> near;
          const double found = spacing_around(*scene.tree, scene.gaps, place, near);
          noted.note(place, found);
          return std::max(found, report_.step);
        }};
    const auto judge = [&](Mesh& mesh) {
      note_walls(check_walls(patches_, mesh, report_.step, context_), report_);
    };
    AtlasSurface surface = extract_atlas(atlas,
                                         {.step = report_.step,
                                          .keep_holes = is_open(),
                                          .min_component = options_.min_component,
                                          .simplify = options_.simplify,
                                          .resolution = &resolution,
                                          .seen = seen,
                                          .judge = judge,
                                          .max_memory = options_.max_memory,
                                          .memory_in_use = kMemoryOfOnly * scene.tree->size()},
                                         context_);
    if (surface.mesh.faces.empty()) {
      throw Error(ErrorCode::kInvalidInput,
                  fmt::format("a grid with steps of {:.3g} finds no surface of these points, "
                              "{:.3g} apart, with a diagonal of {:.3g}: take smaller steps",
                              report_.step, atlas.spacing, atlas.diagonal));
    }
    report_.holes = surface.holes, report_.smooth_holes = surface.smooth_holes;
    report_.cut_handles = surface.cut_handles;
    report_.dropped_components = surface.dropped_components;
    report_.full_faces = surface.faces, report_.simplify_error = surface.simplify_error;
    report_.memory = surface.memory;
    report_.vertices = surface.mesh.vertices.size();
    report_.faces = surface.mesh.faces.size();
    const Sizes sums =
        measure_sizes(view_of(surface.mesh), unit_frame(bounds(surface.mesh.vertices)), context_);
    report_.volume = sums.volume, report_.area = sums.area;
    if (!is_open()) report_.closed_area = surface.guessed * report_.area;
    keep_spacings(noted.take(), rules_);
    return std::move(surface.mesh);
  }

  void carry(const std::shared_ptr<TileScene>& scene, Mesh& mesh) {
    const TileOutput out(store_, stages_, options_, cloud_.survey().layout, n_,
                         [&](std::size_t) { return scene; });
    put_areas(out.carry(0, mesh), report_);
    rules_.left_out = carried_names(mesh.attributes);
  }

  void write(Reconstruction& made) {
    if (!options_.output.empty()) {
      for (std::string& warning :
           write_shape(made.mesh, options_.output, {.format = ShapeFormat::kPly}, context_)) {
        report_.warnings.push_back(std::move(warning));
      }
    }
    if (!options_.model.empty()) write_atlas(made.model, options_.model);
    if (!options_.output.empty()) made.mesh = {}, made.model = {};
  }

  // Fits caps to the points, without outliers near the surface.
  TileCaps fit() {
    const auto n = static_cast<double>(cloud_.n_points()),
               isolated = static_cast<double>(report_.outliers);
    const bool asked = !options_.keep_outliers && cloud_.normals_given();
    const double wrong = asked ? n * cloud_.sample().wrong : 0;
    if (!are_suspicious(n, isolated, wrong)) return fit_round("");
    OutlierSearch search{.n_points = cloud_.n_points(),
                         .most = most_outliers(isolated, wrong),
                         .noise = cloud_.size().noise,
                         .load = [&](std::size_t tile) { return cloud_.load(tile); },
                         .changed = [&] { cloud_.forget_scenes(); }};
    const auto remove = [&] {
      return remove_tile_outliers(store_, cloud_.plan(), search, stages_);
    };
    std::uint64_t found = remove();
    const bool at_once = found > 0;
    if (!at_once) {
      TileCaps caps = fit_round("");
      std::uint64_t rejected = 0, n_caps = 0;
      for (std::size_t tile = 0; tile < n_; ++tile) {
        rejected += caps.rejected(tile).size();
        n_caps += caps.extent(tile).n;
      }
      search.most = 2 * rejected;
      search.suspects = [&](std::size_t tile) { return caps.rejected(tile); };
      found = remove();
      if (found == 0 && n_caps > 0) return caps;
    }
    report_.outliers += found;
    cloud_.measure_again();
    return fit_round(at_once ? "" : "-again");
  }

  static std::string piece_of(const std::string& what, std::size_t tile) {
    return what + "/" + std::to_string(tile);
  }

  TileCaps fit_round(const std::string& round) {
    TileCaps caps(store_, n_, round);
    const CrossingSearch search{.n = report_.points - report_.dropped_points - report_.outliers,
                                .diagonal = cloud_.diagonal(),
                                .noise = cloud_.size().noise};
    const std::size_t halo = std::max({kCrossingNeighbors, kPatch, cloud_.around()});
    const auto look = [&](std::size_t tile) {
      const auto scene = cloud_.load(tile, halo, search.reach());
      const WallPatches patches = choose_patches(*scene->tree, scene->points, scene->foreign,
                                                 search.n, cloud_.around(), context_);
      write_values(store_, piece_of("patch-points" + round, tile), patches.points);
      write_values(store_, piece_of("patch-areas" + round, tile), patches.areas);
      return std::vector{find_crossings(*scene->tree, scene->points, scene->gaps, scene->foreign,
                                        search, context_)};
    };
    Crossings all;
    for (const Crossings& found :
         stages_.values<Crossings>({"crossings", n_, {"crossings" + round}}, look)) {
      all.add(found);
    }
    note_crossings(all, cloud_.diagonal(), report_);
    stages_.each("caps", n_, [&](std::size_t tile) {
      if (caps.has(tile)) return;
      const auto scene = cloud_.load_for(tile, cloud_.size().neighbours);
      CoverOptions wanted = cover_options(options_, cloud_.size());
      wanted.foreign = scene->foreign;
      Cover found = cover(scene->ordered(), wanted, context_);
      std::vector<std::uint32_t> rejected;
      for (const std::uint32_t i : found.rejected) {
        if (scene->foreign[i] == 0) rejected.push_back(scene->tree->order()[i]);
      }
      std::sort(rejected.begin(), rejected.end());
      caps.write_rejected(tile, rejected);
      caps.write(tile, std::move(found), context_);
    });
    caps.read_extents();
    patches_ = {};
    for (std::size_t tile = 0; tile < n_; ++tile) {
      const auto append = [&](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(patches_.points, read_values<Vec3>(store_, piece_of("patch-points" + round, tile)));
      append(patches_.areas, read_values<double>(store_, piece_of("patch-areas" + round, tile)));
    }
    return caps;
  }

  void set_scene(TileCaps& caps) {
    report_.spacing = cloud_.sample().median;
    report_.points_area = cloud_.sample().area;
    report_.noise = cloud_.size().noise;
    report_.normal_noise_degrees = cloud_.size().normal_noise * 180 / std::numbers::pi;
    report_.neighbours = cloud_.size().neighbours;
    LogHistogram errors, supports;
    Bounds middles;
    for (std::size_t tile = 0; tile < n_; ++tile) {
      const CapExtent& extent = caps.extent(tile);
      if (extent.n == 0) continue;
      middles = report_.caps == 0 ? extent.middles : joined(middles, extent.middles);
      report_.caps += extent.n;
      coefficients_ += extent.coefficients;
      for (const CapPatch& patch : caps.patches(tile)) {
        errors.add(patch.error, patch.area);
        supports.add(patch.support);
      }
    }
    if (report_.caps == 0) {
      throw Error(ErrorCode::kInvalidInput,
                  fmt::format("no surface goes with these {} points: no cap fits any of them; are "
                              "their normals right (rholm orient)?",
                              cloud_.n_points()));
    }
    median_support_ = supports.quantile(0.5);
    origin_ = middles.min;
    const bool even = is_even(cloud_.size(), options_);
    report_.step =
        options_.step > 0
            ? options_.step
            : choose_step(cloud_.sample().fine,
                          even ? errors.quantile(1 - kSparseShare) : supports.quantile(0.2), even);
    Atlas scene;
    scene.spacing = cloud_.sample().median, scene.noise = cloud_.size().noise;
    scene.diagonal = cloud_.survey().bounds.diagonal(), scene.blend = options_.blend;
    scene.band = kBandOfNoise * cloud_.size().noise;
    caps.set_scene(scene, report_.step);
  }

  void find_bands(TileCaps& caps) {
    if (!caps.have_bands()) return;
    stages_.each("bands", n_, [&](std::size_t tile) {
      if (!caps.has_bands(tile)) caps.find_bands(tile, context_);
    });
  }

  void make_surface(TileSurface& surface, const TileWinding& winding) {
    stages_.each("grid", n_, [&](std::size_t tile) {
      if (!surface.has_values(tile)) surface.find_values(tile, context_);
    });
    std::optional<TileSeen> sight = look();
    TileHoles filled(store_, surface, winding, n_, open_blocks_);
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
      write_values(store_, "holes", std::vector<std::uint64_t>{filling.holes, filling.smooth});
      for (std::size_t tile = 0; tile < n_; ++tile) surface.forget_values(tile);
    });
    const std::vector<std::uint64_t> holes = read_values<std::uint64_t>(store_, "holes");
    report_.holes = holes.at(0), report_.smooth_holes = holes.at(1);
    const double typical = std::max(cloud_.sample().median, report_.step);
    TileHandles handles(store_, surface, n_, typical,
                        [&](std::size_t tile, const std::vector<Vec3>& places) {
                          return spacings_at(*cloud_.load(tile), places);
                        });
    const Stage stage = {.name = "surface", .count = n_, .last_inputs = no_longer_needed()};
    stages_.each(stage, [&](std::size_t tile) {
      if (handles.has(tile)) return;
      handles.find(tile, surface.extract(tile, is_open(), context_), context_);
    });
    stages_.once("surface", [&] {
      if (!store_.is_kept()) filled.forget();
    });
    stages_.once("handles", [&] { handles.cut(context_); });
    report_.cut_handles = surface.take_round(kCutRound);
    if (keeps_model()) {
      stages_.all("handles", [&] {
        keep_spacings(handles.spacings(), rules_);
        const std::optional<SeenSpace> whole = sight ? sight->join(context_) : std::nullopt;
        if (whole) rules_.seen = whole->kept();
      });
    }
    if (is_open()) cut_open(surface);
  }

  // Finds the space along the lines of sight to all points, if their sensors are known.
  std::optional<TileSeen> look() {
    const bool known = std::all_of(kSensorAxes.begin(), kSensorAxes.end(),
                                   [&](const char* axis) { return cloud_.has_column(axis); });
    if (is_open() || !(known || options_.sensor)) return std::nullopt;
    TileSeen seen(store_, n_,
                  {.box = bounds_of_tiles(store_, cloud_.plan()),
                   .edge = kCubesOfSpacing * cloud_.sample().median,
                   .margin = kEndOfSight * std::max(cloud_.sample().median, cloud_.size().noise),
                   .sensor = options_.sensor});
    stages_.each("sight", n_, [&](std::size_t tile) {
      if (!seen.has(tile)) seen.find(tile, context_);
    });
    return seen;
  }

  // Pieces that no stage after the surface reads. Ranks that have joined a store keep them: its
  // owner decides.
  std::vector<std::string> no_longer_needed() const {
    if (keeps_model()) return {"grid", "rim", "open", "closed"};
    return {"grid", "rim",        "open",    "closed",        "crossings", "crossings-again",
            "caps", "caps-again", "patches", "patches-again", "bands",     "bands-again"};
  }

  bool is_open() const { return options_.holes == HolePolicy::kKeep; }
  // Returns true if a model is made; without an output it is part of the result.
  bool keeps_model() const { return options_.output.empty() || !options_.model.empty(); }

  void cut_open(TileSurface& surface) {
    TileOpening opening(store_, surface, n_);
    stages_.each("open", n_, [&](std::size_t tile) {
      if (!opening.has(tile)) opening.find(tile);
    });
    stages_.once("open", [&] { opening.cut(least_hole(median_support_), context_); });
    surface.take_round(kOpenRound);
  }

  TileParts::Whole join_parts(TileParts& parts, double least_share) {
    stages_.each("parts", n_, [&](std::size_t tile) {
      if (!parts.has(tile)) parts.find(tile, context_);
    });
    TileParts::Whole whole;
    stages_.all("parts", [&] { whole = parts.join(least_share); });
    return whole;
  }

  // Returns the mesh, unless it goes to a file.
  Mesh join_and_write(TileSurface& surface) {
    TileParts parts(store_, surface, n_);
    const TileParts::Whole whole = join_parts(parts, options_.min_component);
    report_.dropped_components = whole.dropped;
    report_.full_faces = whole.faces;
    set_sizes(whole, whole);
    check_points(parts);
    if (!options_.simplify) return write(parts);
    simplify(surface, parts);
    TileParts simple(store_, surface, n_, "-simple");
    set_sizes(join_parts(simple, 0), whole);
    return write(simple);
  }

  // Checks whether the points lie on the surface, from the vertices near some of them.
  void check_points(const TileParts& parts) {
    const auto look = [&](std::size_t tile) {
      TileMesh part = parts.kept_mesh(tile);
      return vertices_near(patches_, report_.step, part.mesh, part.n_own);
    };
    const auto near = stages_.values<WallVertex>({"walls", n_, {"walls"}}, look);
    stages_.all("walls",
                [&] { note_walls(check_walls(patches_, near, report_.step, context_), report_); });
  }

  Mesh write(const TileParts& parts) {
    const TileOutput out(store_, stages_, options_, cloud_.survey().layout, n_,
                         [&](std::size_t tile) { return cloud_.load(tile); });
    if (options_.confidence) put_areas(out.measure_confidence(parts), report_);
    rules_.left_out = carried_names(out.attributes());
    if (options_.output.empty()) return out.collect(parts, whole_);
    out.write(parts, whole_, options_.output);
    return {};
  }

  // Closed holes have the share of the area that they had before the surface was simplified.
  void set_sizes(const TileParts::Whole& whole, const TileParts::Whole& before) {
    whole_ = whole;
    report_.area = whole.area, report_.volume = whole.volume;
    // Takes the volume about the middle: a closed surface has the same about any place.
    if (is_open()) {
      const Vec3 middle = 0.5 * cloud_.survey().bounds.min + 0.5 * cloud_.survey().bounds.max;
      report_.volume -= dot(middle - origin_, whole.area_vector) / 3;
    }
    if (!is_open() && before.area > 0) {
      report_.closed_area = before.closed_area / before.area * whole.area;
    }
  }

  void simplify(TileSurface& surface, const TileParts& parts) {
    TileSimplify less(store_, surface, parts, n_,
                      {.stops = simplify_stops(*options_.simplify, report_.step),
                       .faces = report_.full_faces,
                       .step = report_.step});
    if (less.wants_curves()) {
      stages_.each("simplify", n_, [&](std::size_t tile) {
        if (!less.has_curve(tile)) less.find_curve(tile, context_);
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

  AtlasModel model_of(const TileCaps& caps) const {
    // The caps are in memory once as an atlas, and twice as in the file.
    const std::uint64_t bytes = 3 * (report_.caps * sizeof(Cap) + coefficients_ * sizeof(double));
    if (bytes > options_.max_memory) {
      throw Error(ErrorCode::kOutOfMemory,
                  fmt::format("a model of {} caps needs {:.2g} GiB", report_.caps,
                              static_cast<double>(bytes) / 0x1p30));
    }
    AtlasModel model = empty_model();
    model.atlas = caps.all();
    model.rules = rules_;
    if (!options_.model.empty()) write_atlas(model, options_.model);
    if (!options_.output.empty()) return {};
    return model;
  }

  // Returns a model without caps and rules.
  AtlasModel empty_model() const {
    AtlasModel model;
    model.step = report_.step, model.tolerance = options_.tolerance;
    model.input_numbers = 3 * report_.points;
    model.method = "reconstruct";
    return model;
  }

  PointSource& source_;
  PieceStore& store_;
  const ReconstructOptions& options_;
  ReconstructReport report_;
  Stages stages_;
  const Context& context_;  // of the stage that runs
  TileCloud cloud_;
  std::size_t n_ = 0;               // tiles
  double median_support_ = 0;       // of caps
  Vec3 origin_;                     // of the grid
  SurfaceRules rules_;              // of the surface, for the model
  WallPatches patches_;             // of all tiles
  std::uint64_t coefficients_ = 0;  // of all caps
  TileParts::Whole whole_;
  std::size_t open_blocks_ = 0;
};

}  // namespace

Reconstruction run_tiles(PointSource& source, PieceStore& store, const TileRunOptions& options,
                         Executor& executor, const Context& context) {
  check_fields(options.reconstruct);
  return TileRun(source, store, options, executor, context).run();
}

}  // namespace rholm
