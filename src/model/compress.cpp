#include "rholm/compress.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "harmonic/low_harmonics.h"
#include "model/atlas_errors.h"
#include "model/atlas_pack.h"
#include "model/oriented_points.h"
#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "surface/area_samples.h"
#include "surface/atlas_surface.h"
#include "transform/cap_blend.h"
#include "transform/cap_greedy.h"
#include "transform/cap_prune.h"

namespace rholm {
namespace {

// All of these are tolerances, chosen on four shapes at 1e-3 and 3e-4 of the diagonal.
constexpr double kSampleSpacing = 2.5;  // errors of a fit have waves longer than that
constexpr double kStray = 5;         // a cap's surface farther from the samples is not theirs ...
constexpr double kStrayFitted = 3;   // ... and once more, stricter, when coefficients are dropped
constexpr double kStep = 4;          // of the grid: details that matter are larger
constexpr double kLeastSteps = 250;  // along the diagonal: fewer show as facets
constexpr double kBand = 10;         // caps that disagree by less are averaged
constexpr double kLeastSamples = 20000, kMostSamples = 200000;
// How far caps speak, of the support they were chosen with; the power of it that small ones
// override large ones by; how many searches of a grid may fail (each takes as long as fourteen
// extractions), and whether other handles than the shape's are put up with then.
struct Overlap {
  double reach, power;
  int most_searches;
  bool settles;
};
// Where neighbours barely overlap, the surface changes from one to the other in a step. Measured:
// 1.3 leaves fewer steps still, but splinters at thin parts. Where parts lie close together, as
// fingers do, that makes handles, and caps speak as far as they were chosen to.
constexpr Overlap kOverlaps[] = {{1.15, 1, 1, false}, {1, 3, 2, true}};
// The surface is a little farther from the shape than the samples' blend tells: the aim is
// corrected by what is measured, so many times, and left a little below the tolerance.
constexpr int kMostTries = 8;
constexpr double kAim = 0.995, kGoodEnough = 0.97;
// Where caps hardly agree, as between fingers, a grid may see a handle that another does not: other
// steps and bands, in these parts, are tried until the surface is connected as the shape is.
constexpr double kSteps[] = {1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4};
constexpr double kBands[] = {1, 2};

OrientedPoints samples_of(const Mesh& mesh, const CompressOptions& options) {
  std::size_t n = options.samples;
  if (n == 0) {
    const double spacing = kSampleSpacing * options.tolerance;
    n = static_cast<std::size_t>(
        std::clamp(surface_area(mesh) / (spacing * spacing), kLeastSamples, kMostSamples));
  }
  AreaSamples on = sample_by_area(mesh, n, options.seed);
  OrientedPoints samples;
  samples.points = std::move(on.points);
  for (const std::uint32_t t : on.triangles) {
    samples.normals.push_back(
        normalized(face_normal(scaled_corners(mesh, mesh.triangles[t], 1)).twice_area));
  }
  return samples;
}

void check(const CompressOptions& options) {
  const auto refuse = [](const char* what, double value, const std::string& limit) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is {}: it must be {}", what, value, limit));
  };
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    refuse("the tolerance", options.tolerance, "positive");
  }
  if (options.max_degree < 2 || options.max_degree > kMaxLowDegree) {
    refuse("the highest degree", options.max_degree, fmt::format("2 ... {}", kMaxLowDegree));
  }
  if (options.samples != 0 && (options.samples < 1000 || options.samples > kMaxSamples)) {
    refuse("the number of samples", static_cast<double>(options.samples),
           fmt::format("1000 ... {}", kMaxSamples));
  }
}

Atlas cover(const SampleLevels& levels, double diagonal, const CompressOptions& options,
            CompressReport& report, const Context& context) {
  GreedyOptions wanted;
  wanted.candidate = {.tolerance = options.tolerance,
                      .stray = kStray * options.tolerance,
                      .max_degree = options.max_degree};
  wanted.seed = options.seed;
  const GreedyCover cover =
      greedy_cover(levels, diagonal, wanted, std::vector<std::uint8_t>(levels.size()), context);
  report.uncovered = cover.uncovered;
  Atlas atlas;
  for (const Candidate& chosen : cover.chosen) {
    atlas.caps.push_back(chosen.cap);
    atlas.caps.back().first = atlas.coefficients.size();
    atlas.coefficients.insert(atlas.coefficients.end(), chosen.coefficients.begin(),
                              chosen.coefficients.end());
  }
  atlas.spacing = levels.finest().spacing;
  atlas.diagonal = diagonal;
  atlas.band = kBand * options.tolerance;
  return atlas;
}

Atlas overlapping(Atlas atlas, const Overlap& overlap) {
  for (Cap& cap : atlas.caps) set_support(cap, overlap.reach * cap.frame.support);
  set_weights(atlas.caps, overlap.power);
  return atlas;
}

// As it comes out of the file.
Atlas rounded(Atlas atlas, const Overlap& overlap) {
  set_weights(atlas.caps, overlap.power);
  return unpack(pack(atlas), "");
}

// How a closed surface hangs together.
struct Topology {
  std::size_t components = 0, genus = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};

// Of a shape; none for what is not a closed surface.
std::optional<Topology> topology_of(const Mesh& mesh) {
  const Inspection found = inspect(mesh);
  if (!found.closed || !found.manifold || !found.oriented) return std::nullopt;
  return Topology{found.components, found.genus};
}

// Of a grid, times the first choice.
struct GridParts {
  double step = 1, band = 1;
};
std::vector<GridParts> all_grid_parts() {
  std::vector<GridParts> parts;
  for (const double step : kSteps) {
    for (const double band : kBands) parts.push_back({step, band});
  }
  return parts;
}

// The surface of a model whose step and band are chosen here, and whether it hangs together as
// wanted.
struct TrialSurface {
  Mesh mesh;
  Topology topology;
  bool right = false;
};

// Tries `parts` in their order, the first alone without a search; it is taken where none is right.
// One that is comes first from then on.
TrialSurface choose_grid(AtlasModel& model, const std::optional<Topology>& wanted, bool search,
                         std::vector<GridParts>& parts, const Context& context) {
  const double step = model.step, band = model.atlas.band;
  std::optional<TrialSurface> first;
  for (std::size_t i = 0; i < (search ? parts.size() : 1); ++i) {
    model.step = parts[i].step * step, model.atlas.band = parts[i].band * band;
    TrialSurface trial;
    try {
      trial.mesh = synthesize(model, {}, context);
    } catch (const Error& error) {
      // A finer grid than memory allows is no choice.
      if (!first || error.code() != ErrorCode::kOutOfMemory) throw;
      continue;
    }
    const Inspection found = inspect(trial.mesh);
    trial.topology = {found.components, found.genus};
    trial.right = !wanted || trial.topology == *wanted;
    if (trial.right) {
      std::rotate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i),
                  parts.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      return trial;
    }
    if (!first) first = std::move(trial);
  }
  model.step = parts[0].step * step, model.atlas.band = parts[0].band * band;
  return std::move(*first);
}

// What a model is made for.
struct Target {
  const SampleLevels& levels;
  const CompressOptions& options;
  const std::optional<Topology>& topology;
  std::function<AtlasErrors(const Mesh&)> measure;
};

// Drops coefficients of the caps until the surface is as far from the shape as allowed; what is
// better than `result` replaces it.
void fit(const Target& target, const Atlas& chosen, const Overlap& overlap, Compressed& result,
         const Context& context) {
  const CompressOptions& options = target.options;
  CompressReport& report = result.report;
  AtlasModel& model = result.model;
  const Atlas covered = overlapping(chosen, overlap);
  double aim = options.tolerance;
  std::vector<GridParts> parts = all_grid_parts();
  int searches = 0;  // that found nothing
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    const PruneOptions pruning{.tolerance = aim,
                               .band = covered.band,
                               .stray = kStrayFitted * options.tolerance,
                               .max_degree = options.max_degree};
    Atlas atlas = covered;
    timed(report.times, "fit", [&] {
      prune(target.levels, pruning, atlas, context);
      atlas = rounded(std::move(atlas), overlap);
    });
    AtlasModel trial = model;
    trial.step = std::min(kStep * options.tolerance, covered.diagonal / kLeastSteps);
    trial.atlas = std::move(atlas);
    Topology topology;
    bool right = false;
    const AtlasErrors errors = timed(report.times, "surface", [&] {
      const TrialSurface surface =
          choose_grid(trial, target.topology, searches < overlap.most_searches, parts, context);
      topology = surface.topology, right = surface.right;
      if (!right) ++searches;
      return target.measure(surface.mesh);
    });
    trial.errors = errors;
    const bool met = errors.rms() <= options.tolerance;
    const auto rank = [](bool is_met, bool is_right) { return 2 * is_met + is_right; };
    const int change = rank(met, right) - rank(report.met, report.topology_kept);
    const bool smaller = met ? size_of(trial.atlas).numbers() < size_of(model.atlas).numbers()
                             : errors.rms() < model.errors.value_or(errors).rms();
    if (!model.errors || change > 0 || (change == 0 && smaller)) {
      model = std::move(trial);
      report.genus = topology.genus;
      report.met = met, report.topology_kept = right;
    }
    if (met && right && errors.rms() >= kGoodEnough * options.tolerance) break;
    if (searches >= overlap.most_searches && !overlap.settles) break;
    aim *= kAim * options.tolerance / errors.rms();
  }
}

Compressed compress_samples(const OrientedPoints& samples, double diagonal,
                            std::size_t input_numbers, const CompressOptions& options,
                            const std::optional<Topology>& wanted,
                            const std::function<AtlasErrors(const Mesh&)>& measure_surface,
                            const Context& context) {
  Compressed result;
  CompressReport& report = result.report;
  report.samples = samples.points.size();
  result.model.tolerance = options.tolerance;
  result.model.input_numbers = input_numbers;
  result.model.method = "greedy";
  const SampleLevels levels = timed(report.times, "samples", [&] {
    return make_levels(samples.points, samples.normals, context);
  });
  const Atlas chosen = timed(report.times, "caps",
                             [&] { return cover(levels, diagonal, options, report, context); });
  const Target target{levels, options, wanted, measure_surface};
  for (const Overlap& overlap : kOverlaps) {
    fit(target, chosen, overlap, result, context);
    if (report.met && report.topology_kept) break;
  }
  return result;
}

}  // namespace

AtlasSize size_of(const Atlas& atlas) {
  return {atlas.caps.size(), n_kept(atlas), atlas.caps.size() * kFrameNumbers};
}

Compressed compress(const Mesh& mesh, const CompressOptions& options, const Context& context) {
  check(options);
  validate(mesh);
  const OrientedPoints samples = samples_of(mesh, options);
  const auto measure_surface = [&](const Mesh& surface) {
    return measure(mesh, surface, std::max<std::size_t>(samples.points.size(), 100000), context);
  };
  return compress_samples(samples, bounds(mesh.vertices).diagonal(), 3 * mesh.vertices.size(),
                          options, topology_of(mesh), measure_surface, context);
}

Compressed compress(const PointCloud& cloud, const CompressOptions& options,
                    const Context& context) {
  check(options);
  check_oriented(cloud);
  OrientedPoints samples = oriented_points(cloud.points, cloud.normals);
  if (samples.points.size() < 1000) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} points with normals are too few for large caps: at least 1000",
                            samples.points.size()));
  }
  const bool turned = turn_outwards(samples, context);
  const auto measure_surface = [&](const Mesh& surface) {
    return measure(samples.points, surface, context);
  };
  Compressed result =
      compress_samples(samples, bounds(samples.points).diagonal(), 3 * cloud.points.size(), options,
                       {}, measure_surface, context);
  result.report.turned_normals = turned;
  return result;
}

Mesh synthesize(const AtlasModel& model, const AtlasSynthesisOptions& options,
                const Context& context) {
  const double step = options.step > 0 ? options.step : model.step;
  if (!(step > 0) || !std::isfinite(step)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the step of the grid is {}: it must be positive", step));
  }
  const AtlasSurfaceOptions wanted{
      .step = step, .simplify = options.simplify, .max_memory = options.max_memory};
  Atlas atlas = model.atlas;
  for (Cap& cap : atlas.caps) {
    const int degree = options.degree.value_or(cap.degree);
    cap.degree = static_cast<std::uint16_t>(std::min<int>(cap.degree, std::max(0, degree)));
  }
  Mesh surface = extract_atlas(atlas, wanted, context).mesh;
  if (surface.triangles.empty()) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("a grid with steps of {:.3g} finds no surface of a model with a diagonal of "
                    "{:.3g}: take smaller steps{}",
                    step, atlas.diagonal,
                    model.step > 0 ? fmt::format(", {:.3g} is its own", model.step) : ""));
  }
  return surface;
}

}  // namespace rholm
