#include "rholm/truncation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "shape/vertex_range.h"
#include "transform/error/distance_check.h"
#include "transform/error/error_peaks.h"
#include "transform/error/error_points.h"
#include "transform/error/error_sites.h"
#include "transform/error/largest_radial.h"
#include "transform/error/radial_bound.h"
#include "transform/error/sampled_distances.h"
#include "transform/error/worst_points.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/norms/parseval.h"

namespace rholm {
namespace {

// Returns sqrt(||f - f_L||^2 / 4 pi), if the error of the coefficients changes it by a hundredth at
// most.
std::optional<double> parseval_rms(const Expansion& expansion, double precision) {
  if (!expansion.norm_squared) return std::nullopt;
  const double norm_squared = *expansion.norm_squared;
  const CoefficientErrors errors =
      coefficient_errors(norm_squared, expansion.coefficients, precision, precision);
  return rms_of(parseval_rest(norm_squared, expansion.coefficients, errors), 50);
}

void predict(const Expansion& expansion, ErrorSites& sites, TruncationErrors& errors) {
  if (!shows_its_edges(sites.mesh(), expansion.coefficients.degree())) return;
  const ErrorStrengths& strengths = sites.strengths();
  const double per = 1 / (2 * std::numbers::pi * (expansion.coefficients.degree() + 1.0));
  if (expansion.function == RadialFunction::kRadius) errors.predicted_max = strengths.radius * per;
  errors.predicted_max_distance = strengths.distance * per;
}

// Returns the precision of values and slopes at points, as in SumOptions: a hundred thousandth of
// the error, where that is known.
double measuring_precision(const Expansion& expansion, const std::optional<double>& exact_rms,
                           double precision) {
  if (!exact_rms) return std::clamp(precision, 1e-12, 1e-6);
  const double size = std::sqrt(*expansion.norm_squared / (4 * std::numbers::pi));
  return std::clamp(1e-5 * *exact_rms / size, 1e-12, 1e-6);
}

// Number of places where climbs to the largest distances begin (chosen).
constexpr std::size_t kPeaks = 16, kClosestPeaks = 4;
// Number of points over the area that may have the largest errors (chosen).
constexpr std::size_t kMostWorst = 2048;

// The search for a bound ends within this part of the largest error (chosen). Values may be off by
// this many times the precision with which they are computed (chosen).
constexpr double kEnoughAbove = 1.01, kValueDoubt = 10;

// Points that are examined closely: `extreme` worst ones of the extreme points, then the worst
// points over the area.
struct Looked {
  ErrorPoints points;
  PointErrors errors;
  std::size_t extreme = 0;
};

// Climbs to the largest distance to the model between points, from the distances at some of them.
// Distances to the shape are left out: to first order they are distances to planes, not to faces.
void climb(const Looked& looked, const RadialModel& model, const PeakSearch& distances,
           std::size_t n_sites, ErrorSites& sites, TruncationErrors& errors) {
  errors.measured_max_distance =
      std::max(*errors.measured_max_distance,
               largest(local_maxima(sites.mesh(), sites.center(), looked.points, distances,
                                    model.degree, n_sites, {.threads = sites.threads()})
                           .values));
}

void climb_to_first_order(const Looked& looked, const RadialModel& model, ErrorSites& sites,
                          TruncationErrors& errors) {
  const Context context{.threads = 1};  // waking threads takes longer than a hundred points
  climb(looked, model,
        {looked.errors.to_model,
         [&](const ErrorPoints& at) { return point_errors(at, model, true, context).to_model; }},
        kPeaks, sites, errors);
}

// Measures distances by closest points: of a sample where that is enough, else of trees of both
// surfaces.
void measure_closest(const Looked& looked, const MeasuredPoints& over_area,
                     const RadialModel& model, const Expansion& expansion, double precision,
                     const Context& context, ErrorSites& sites, TruncationErrors& errors) {
  if (!may_be_refined(sites.mesh(), expansion, *errors.measured_max, errors.diagonal)) {
    climb_to_first_order(looked, model, sites, errors);
    return;
  }
  errors.distances_are_closest = true;
  if (!is_coarse(sites.mesh())) {
    const SampledDistances sampled = sampled_distances(
        sites.mesh(), sites.center(), model, over_area, {looked.points, looked.errors}, context);
    if (sampled.suffice(sites.mesh())) {
      errors.distance_rms = sampled.rms;
      errors.measured_max_distance = sampled.max;
      climb(
          looked, model,
          {sampled.to_model, [&](const ErrorPoints& at) { return distances_to_model(model, at); }},
          kClosestPeaks, sites, errors);
      return;
    }
  }
  climb_to_first_order(looked, model, sites, errors);
  const SurfaceDistances distances = sites.closest(true).measure(
      expansion, model.degree, looked.points.first(looked.extreme), precision, context);
  errors.distance_rms = distances.rms;
  errors.measured_max_distance = distances.max;
}

// Returns the worst points over the area, each once: copies would count as peaks of their own.
std::vector<std::size_t> worst_of(const PointErrors& errors) {
  std::vector<std::size_t> worst;
  for (const auto* values : {&errors.radial, &errors.to_model, &errors.to_shape}) {
    const std::vector<std::size_t> indices = indices_of_largest(*values, kMostWorst);
    worst.insert(worst.end(), indices.begin(), indices.end());
  }
  std::sort(worst.begin(), worst.end());
  worst.erase(std::unique(worst.begin(), worst.end()), worst.end());
  return worst;
}

Looked look_closely(WorstPoints extreme, const ErrorPoints& over_area, const PointErrors& of_area) {
  Looked looked{.points = std::move(extreme.points), .errors = std::move(extreme.errors)};
  looked.extreme = looked.points.size();
  const auto take = [&](const std::vector<std::size_t>& indices) {
    looked.points.append(over_area.subset(indices));
    looked.errors.append(of_area.subset(indices));
  };
  take(worst_of(of_area));
  return looked;
}

// Adds the places of the largest radial errors to the worst points, for distances there.
LargestRadial largest_error(const Expansion& expansion, const RadialModel& model,
                            WorstPoints& worst, const ErrorPoints& over_area,
                            const PointErrors& of_area, double rms, ErrorSites& sites,
                            const Context& context) {
  ErrorPoints known = worst.points;
  std::vector<double> values = worst.errors.radial;
  for (const std::size_t i : indices_of_largest(of_area.radial, kMostWorst)) {
    values.push_back(of_area.radial[i]);
  }
  known.append(over_area.subset(indices_of_largest(of_area.radial, kMostWorst)));
  LargestRadial found = largest_radial(expansion, model, known, values, rms, sites, context);
  // Peaks have no slope of a face: many are at vertices, where the plane of a face is meaningless.
  ErrorPoints peaks = found.peaks.points;
  std::ranges::fill(peaks.cosines, 0.0);
  worst.points.append(peaks);
  worst.errors.append(point_errors(peaks, model, true, context));
  return found;
}

// Returns a bound on all radial errors, within a hundredth of the largest error found if that takes
// few cells. Returns nothing if the bound is larger than the shape.
std::optional<double> bound_of_largest(const Expansion& expansion, const RadialModel& model,
                                       double largest_found, double precision, double diagonal,
                                       ErrorSites& sites, const Context& context) {
  if (expansion.function != RadialFunction::kRadius) return std::nullopt;
  const double size =
      norm_of_degrees(expansion.coefficients, 0, model.degree) / std::sqrt(4 * std::numbers::pi);
  const double waves = 16.0 * model.degree * model.degree;
  const double bound =
      radial_bound(sites.mesh(), sites.scan(), expansion, model,
                   {.seen = largest_found,
                    .enough = kEnoughAbove * largest_found,
                    .doubt = kValueDoubt * precision * size,
                    .most_cells = static_cast<std::size_t>(std::clamp(waves, 1e4, 1e5))},
                   context)
          .value;
  return bound <= diagonal ? std::optional(bound) : std::nullopt;
}

}  // namespace

TruncationErrors truncation_errors(const MeshView& mesh, const Expansion& expansion,
                                   const TruncationOptions& options, const Context& context) {
  validate(mesh);
  ErrorSites sites(mesh, expansion.center, context.threads);
  return truncation_errors(expansion, options, sites, context);
}

TruncationErrors truncation_errors(const Expansion& expansion, const TruncationOptions& options,
                                   ErrorSites& sites, const Context& context,
                                   ErrorPoints* worst_radial) {
  TruncationErrors errors;
  errors.diagonal = diagonal_of(sites.mesh(), {.threads = context.threads});
  const int degree = expansion.coefficients.degree();
  const Context silent{.threads = context.threads};
  report_progress(context, "errors", 0);
  const double known = options.precision.value_or(precision_of(expansion));
  std::optional<double> exact_rms;
  if (expansion.function == RadialFunction::kRadius) {
    exact_rms = parseval_rms(expansion, known);
  }
  const double precision = measuring_precision(expansion, exact_rms, known);
  const ErrorPoints& over_area = sites.over_area();
  const RadialModel model(expansion, degree, over_area.size(), true, precision, silent);
  const PointErrors of_area = point_errors(over_area, model, true, silent);
  errors.distance_rms = rms_distance(of_area, 0);
  errors.rms = exact_rms ? exact_rms : rms_over_solid_angle(over_area, of_area, 0);
  errors.rms_is_exact = exact_rms.has_value();
  // Points over the area count for the largest errors, too. At a degree so low that no face is
  // long, the middle of a face may err more than its corners.
  WorstPoints worst = worst_points(sites.mesh(), sites.scan(), expansion, model,
                                   {.rms = *errors.rms,
                                    .radial = largest(of_area.radial),
                                    .distance = largest(of_area.to_model)},
                                   silent);
  errors.points = worst.seen + over_area.size();
  const LargestRadial radial =
      largest_error(expansion, model, worst, over_area, of_area, *errors.rms, sites, silent);
  errors.points += radial.seen;
  if (worst_radial != nullptr) worst_radial->append(radial.worst(degree));
  const Looked looked = look_closely(std::move(worst), over_area, of_area);
  errors.measured_max = radial.value;
  errors.max_bound =
      bound_of_largest(expansion, model, radial.value, precision, errors.diagonal, sites, silent);
  errors.measured_max_distance =
      std::max(largest(looked.errors.to_model), largest(looked.errors.to_shape));
  measure_closest(looked, {over_area, of_area}, model, expansion, precision, silent, sites, errors);
  report_progress(context, "errors", 0.9);
  if (options.predict) predict(expansion, sites, errors);
  return errors;
}

}  // namespace rholm
