#include "rholm/compress.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atlas/compress/cap_greedy.h"
#include "atlas/compress/cap_prune.h"
#include "base/check_fields.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "harmonic/legendre/low_harmonics.h"
#include "model/atlas/atlas_errors.h"
#include "model/atlas/atlas_fit.h"
#include "model/atlas/atlas_level.h"
#include "model/atlas/outer_samples.h"
#include "reconstruct/points/known_spacings.h"
#include "reconstruct/points/oriented_points.h"
#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "surface/atlas_surface.h"
#include "surface/field/cap_field.h"

namespace rholm {
namespace {

// The lengths below are in tolerances, chosen on four shapes at 1e-3 and 3e-4 of the diagonal.
constexpr double kSampleSpacing = 2.5;  // errors of a fit have longer waves
constexpr double kStray = 3;            // parts of a cap farther from its samples are cut ...
constexpr double kStrayFitted = 1.5;  // ... and again, more strictly, when coefficients are dropped
constexpr double kStep = 4;           // step of the grid: relevant details are larger
constexpr double kBand = 10;          // caps that disagree by less are averaged
// Parts of the diagonal: neighbours that disagree by more than a coarse tolerance make no surface.
constexpr double kCoarsest = 0.02, kWidestBand = 0.1;
constexpr double kLeastSteps = 250;  // along the diagonal: fewer show as facets
constexpr double kLeastSamples = 20000, kMostSamples = 200000;
// Thin shapes that need more samples are refused. Meshes 138, 158, 381 and 460 of
// tests/cli/random_meshes.py took a minute, for grids of three to five million triangles, and all
// kept too many handles.
constexpr double kMostThinSamples = 100000;

// Facing sheets of a surface need room for the errors of both caps, and for the band in which the
// grid blends caps. Each may take this part of the gap. The gap is a quantile: a share kThin of the
// area has smaller gaps, because at sharp edges all gaps fall to 0.
constexpr double kThin = 0.05;
constexpr double kToleranceOfGap = 1.0 / 6, kBandOfGap = 1.0 / 3;
constexpr double kStepOfGap = kBandOfGap / kBandSteps;

// Where neighbours barely overlap, the surface changes from one to the other in a step. Measured:
// 1.3 leaves fewer steps still, but splinters at thin parts. At close parts, as fingers, larger
// supports make handles, and caps keep the supports with which they were chosen.
constexpr Overlap kOverlaps[] = {{1.15, 1, false}, {1, 3, true}};
// A cover has more numbers than its model, because coefficients are then dropped to the tolerance.
// A cover with more than this times the allowed numbers is given up before it is fitted.
constexpr std::size_t kDropped = 2;

static_assert(kMaxCapDegree == kMaxLowDegree);

// The error of a level determines its number of faces: faces may add this part of the error of the
// degrees left out. The fit of a level leaves half of this error or more (compress_test), so that
// faces add at most 2 %.
constexpr double kLevelError = 0.1;

// The input of compress_subject(), made from a mesh or from points.
struct Subject {
  OrientedPoints samples;
  double diagonal = 0;
  std::size_t input_numbers = 0;
  std::optional<Topology> topology = {};
  std::function<AtlasErrors(const Mesh&)> measure;
};

// Lengths that a gap between sheets allows.
struct Lengths {
  double tolerance, band, step;
};
Lengths lengths_for(double tolerance, double diagonal, double gap, double area) {
  // The spacing of samples is the wave length of errors.
  const double least = std::sqrt(area / kMostThinSamples) / (kSampleSpacing * kToleranceOfGap);
  if (gap < least) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the shape is too thin for an atlas of caps: over {:.0f} % of its area "
                            "opposite sheets are {:.3g} apart or less ({:.2g} of the diagonal), "
                            "and {:.0f} samples can tell {:.3g} apart",
                            100 * kThin, gap, gap / diagonal, kMostThinSamples, least));
  }
  const double coarsest = std::min(tolerance, kCoarsest * diagonal);
  const double within = std::min(coarsest, kToleranceOfGap * gap);
  return {within, std::min({kBand * within, kWidestBand * diagonal, kBandOfGap * gap}),
          std::min({kStep * within, diagonal / kLeastSteps, kStepOfGap * gap})};
}

std::size_t n_samples(const CompressOptions& options, const Lengths& lengths, double area) {
  if (options.samples != 0) return options.samples;
  const double spacing = kSampleSpacing * lengths.tolerance;
  return static_cast<std::size_t>(
      std::clamp(area / (spacing * spacing), kLeastSamples, kMostSamples));
}

std::size_t most_numbers(const Subject& subject, const CompressOptions& options) {
  return options.max_numbers > 0 ? options.max_numbers : subject.input_numbers;
}

[[noreturn]] void refuse_numbers(const Subject& subject, const CompressOptions& options,
                                 double tolerance, const std::string& numbers) {
  throw Error(
      ErrorCode::kUnsupported,
      fmt::format("an atlas of caps within {:.3g} would take {} numbers; the shape itself "
                  "has {} coordinates, and {} numbers are allowed: keep the shape as it "
                  "is, take a larger tolerance, or allow more numbers (max_numbers, "
                  "in the program --max-numbers)",
                  tolerance, numbers, subject.input_numbers, most_numbers(subject, options)));
}

// Refuses a cover that was given up, or that has no caps.
[[noreturn]] void refuse(const GreedyCover& cover, const Subject& subject,
                         const CompressOptions& options, double tolerance) {
  if (cover.foreseen > 0) {
    refuse_numbers(subject, options, tolerance,
                   fmt::format("{} or more", cover.foreseen / kDropped));
  }
  throw Error(ErrorCode::kUnsupported,
              fmt::format("no cap follows the surface within {:.3g}: it is too rough for an "
                          "atlas at this tolerance, or no surface; take a larger tolerance",
                          tolerance));
}

GreedyCover cover(const SampleLevels& levels, const Subject& subject, double tolerance,
                  const CompressOptions& options, const Context& context) {
  GreedyOptions wanted;
  wanted.candidate = {
      .tolerance = tolerance, .stray = kStray * tolerance, .max_degree = options.max_degree};
  wanted.most_numbers = kDropped * most_numbers(subject, options);
  wanted.seed = options.seed;
  GreedyCover covered = greedy_cover(levels, subject.diagonal, wanted,
                                     std::vector<std::uint8_t>(levels.size()), context);
  if (covered.foreseen > 0 || covered.chosen.empty()) {
    refuse(covered, subject, options, tolerance);
  }
  return covered;
}

Atlas atlas_of(const GreedyCover& cover, double spacing, double diagonal, double band) {
  Atlas atlas;
  for (const Candidate& chosen : cover.chosen) {
    atlas.caps.push_back(chosen.cap);
    atlas.caps.back().first = atlas.coefficients.size();
    atlas.coefficients.insert(atlas.coefficients.end(), chosen.coefficients.begin(),
                              chosen.coefficients.end());
  }
  atlas.spacing = spacing, atlas.diagonal = diagonal, atlas.band = band;
  return atlas;
}

Compressed compress_subject(const Subject& subject, const Lengths& lengths,
                            const CompressOptions& options, const Context& context) {
  Compressed result;
  CompressReport& report = result.report;
  report.samples = subject.samples.points.size();
  report.aimed = lengths.tolerance;
  result.model.tolerance = options.tolerance;
  result.model.input_numbers = subject.input_numbers;
  result.model.method = "greedy";
  const SampleLevels levels = timed(report.times, "samples", [&] {
    return make_levels(subject.samples.points, subject.samples.normals, context);
  });
  const GreedyCover covered = timed(report.times, "caps", [&] {
    return cover(levels, subject, lengths.tolerance, options, context);
  });
  const Atlas chosen = atlas_of(covered, levels.finest().spacing, subject.diagonal, lengths.band);
  const FitTarget target{
      .levels = levels,
      .topology = subject.topology,
      .tolerance = lengths.tolerance,
      .accepted = options.tolerance,
      .stray = kStrayFitted * lengths.tolerance,
      .step = lengths.step,
      .max_degree = options.max_degree,
      .surface = [&](const AtlasModel& model) { return synthesize(model, {}, context); },
      .measure = subject.measure};
  report.uncovered = covered.uncovered;
  double aim = 0;
  for (const Overlap& overlap : kOverlaps) {
    fit_atlas(target, chosen, overlap, result, aim, context);
    if (report.met && report.topology_kept) break;
  }
  const std::size_t numbers = size_of(result.model.atlas).numbers();
  if (numbers > most_numbers(subject, options)) {
    refuse_numbers(subject, options, lengths.tolerance, fmt::format("{}", numbers));
  }
  return result;
}

// Returns the topology of a mesh that bounds a solid; none for other meshes.
std::optional<Topology> topology_of_solid(const Inspection& found) {
  if (!found.closed || !found.manifold || !found.oriented) return std::nullopt;
  return topology_of(found);
}

void check_oriented_alike(const Inspection& found) {
  if (found.oriented) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("{} edges have two faces of opposite orientation: an atlas needs "
                          "faces that are oriented alike; 'rholm repair' turns them",
                          found.misoriented_edges));
}

// Makes the options of extract_atlas() for a grid of this step.
class RuledExtraction {
 public:
  RuledExtraction(const AtlasModel& model, double step, const Context& context) : step_(step) {
    if (!model.rules) return;
    const SurfaceRules& rules = *model.rules;
    keep_holes_ = rules.holes == HolePolicy::kKeep;
    min_component_ = rules.min_component;
    spacings_.emplace(rules, model.atlas.spacing, context);
    resolution_ = {.typical = std::max(model.atlas.spacing, step),
                   .at = [this](const Vec3& x) { return std::max(spacings_->at(x), step_); }};
    if (rules.seen) seen_.emplace(*rules.seen, context);
  }
  RuledExtraction(const RuledExtraction&) = delete;
  RuledExtraction& operator=(const RuledExtraction&) = delete;

  // Valid as long as this object.
  AtlasSurfaceOptions options(std::size_t max_memory) const {
    AtlasSurfaceOptions options{.step = step_, .max_memory = max_memory};
    options.keep_holes = keep_holes_, options.min_component = min_component_;
    if (spacings_) options.resolution = &resolution_;
    if (seen_) options.seen = &*seen_;
    return options;
  }

 private:
  double step_;
  bool keep_holes_ = false;
  double min_component_ = AtlasSurfaceOptions{}.min_component;
  std::optional<KnownSpacings> spacings_;
  Resolution resolution_;
  std::optional<SeenSpace> seen_;
};

}  // namespace

AtlasSize size_of(const Atlas& atlas) {
  return {atlas.caps.size(), n_kept(atlas), atlas.caps.size() * kFrameNumbers};
}

Compressed compress(const Mesh& mesh, const CompressOptions& options, const Context& context) {
  check_fields(options);
  validate(mesh);
  check_span(bounds(mesh.vertices).diagonal());
  const Outward shape = outward(mesh);
  const Mesh& welded = shape.welded.mesh;
  const Inspection found = inspect(welded);
  check_oriented_alike(found);
  const RayScene scene(welded, context);
  OuterSurface outer{welded, scene, found.closed, options.seed};
  const SheetProbe probe = probe_sheets(outer, kThin, context);
  Subject subject;
  subject.diagonal = bounds(welded.vertices).diagonal();
  const double area = surface_area(welded);
  const Lengths lengths = lengths_for(options.tolerance, subject.diagonal, probe.gap, area);
  outer.closed = probe.hidden > 0;  // if false, all samples are outer
  subject.samples = outer_samples(outer, n_samples(options, lengths, area), context);
  subject.input_numbers = 3 * welded.vertices.size();  // copies carry no information
  // The remaining parts of intersecting parts have a topology of their own.
  if (probe.hidden == 0) subject.topology = topology_of_solid(found);
  const std::vector<Vec3>& visible = subject.samples.points;
  subject.measure = [&](const Mesh& surface) {
    const std::size_t n = std::max<std::size_t>(visible.size(), 100000);
    return probe.hidden == 0 ? measure(welded, surface, n, context)
                             : measure(visible, welded, surface, n, context);
  };
  Compressed result = compress_subject(subject, lengths, options, context);
  result.report.hidden = probe.hidden;
  result.report.gap = probe.gap;
  return result;
}

Compressed compress(const PointCloud& cloud, const CompressOptions& options,
                    const Context& context) {
  check_fields(options);
  check_oriented(cloud);
  check_span(bounds(cloud.points).diagonal());
  OrientedPoints samples = oriented_points(cloud.points, cloud.normals);
  if (samples.points.size() < 1000) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} points with normals are too few for large caps: at least 1000",
                            samples.points.size()));
  }
  const bool turned = turn_outwards(samples, context);
  Subject subject;
  subject.diagonal = bounds(samples.points).diagonal();
  const Lengths lengths = lengths_for(options.tolerance, subject.diagonal, INFINITY, 0);
  subject.input_numbers = 3 * cloud.points.size();
  subject.samples = std::move(samples);
  const std::vector<Vec3>& points = subject.samples.points;
  subject.measure = [&](const Mesh& surface) { return measure(points, surface, context); };
  Compressed result = compress_subject(subject, lengths, options, context);
  result.report.turned_normals = turned;
  return result;
}

Mesh synthesize(const AtlasModel& model, const AtlasSynthesisOptions& options,
                const Context& context) {
  check_fields(options);
  const double step = options.step > 0 ? options.step : model.step;
  if (!(step > 0) || !std::isfinite(step)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the step of the grid is {}: it must be positive", step));
  }
  const RuledExtraction rules(model, step, context);
  const AtlasSurfaceOptions own = rules.options(options.max_memory);
  AtlasSurfaceOptions wanted = own;
  wanted.simplify = options.simplify;
  if (!wanted.simplify && model.rules) wanted.simplify = model.rules->simplify;
  const Atlas& atlas = model.atlas;
  Mesh surface;
  if (options.degree && *options.degree < highest_degree(atlas)) {
    const Mesh whole = extract_atlas(atlas, own, context).mesh;
    if (!whole.faces.empty()) {
      const AtlasLevel level = LevelMaker(atlas, whole, context).usable_at(*options.degree);
      const bool as_it_needs = !options.simplify && options.step == 0 && level.lost > 0;
      if (as_it_needs) wanted.simplify = SimplifyOptions{.max_error = kLevelError * level.lost};
      surface = level_surface(level.atlas, whole, wanted, context);
    }
  } else {
    surface = extract_atlas(atlas, wanted, context).mesh;
  }
  if (surface.faces.empty()) {
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
