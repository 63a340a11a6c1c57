#include "rholm/monte_carlo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/check_fields.h"
#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "paper/monte_carlo/moments.h"
#include "paper/monte_carlo/samplers.h"
#include "rholm/error.h"
#include "transform/geometry/star_geometry.h"
#include "transform/norms/parseval.h"

namespace rholm {
namespace {

double sum_of_squares(const Coefficients& f, int first_degree) {
  const std::vector<double> spectrum = power_spectrum(f);
  CompensatedSum sum;
  for (std::size_t l = static_cast<std::size_t>(first_degree); l < spectrum.size(); ++l) {
    sum.add(spectrum[l]);
  }
  return sum.value();
}

// Returns at most 100, far above any wanted value, if the scatter hides the coefficients.
double relative_deviation(const Moments& moments) {
  const int first = moments.sum.degree() > 0 ? 1 : 0;
  const double scatter = sum_of_squares(standard_error_of(moments), first);
  if (!(scatter > 0)) return 0;
  const double norm = sum_of_squares(mean_of(moments), first) - scatter;
  return std::sqrt(scatter / std::max(norm, 1e-4 * scatter));
}

// Returns true if the relative deviation is meaningful. Scatter of few pairs looks like a norm.
// This was measured on a box of 12 faces with 2 to 8 points each, in runs that are wrong by 2 to 5.
// Values are below 1 in up to a quarter of all seeds, most of them near 3/4, and below 1/2 in a
// fiftieth. On 80 faces, values below 1 are right within a factor of 2.
bool means_something(double relative, const Moments& moments, std::size_t places) {
  constexpr double kFewPairs = 100;
  const std::size_t pairs_at_place = moments.samples / 2;
  const double pairs = static_cast<double>(places) * static_cast<double>(pairs_at_place);
  return relative <= (pairs < kFewPairs ? 0.5 : 1.0);
}

std::size_t even(std::size_t samples) { return samples + samples % 2; }

// Returns the number of samples of a place after the next round.
std::size_t next_samples(const MonteCarloOptions& options, std::size_t samples, double reached) {
  // The first round is large enough for a relative deviation that is right within a factor of 2 on
  // any mesh.
  constexpr std::size_t kFirst = 4;
  if (samples == 0) return std::min(kFirst, even(options.most_samples));
  // Scatter decreases with the square root of the number. The next round adds what is missing and 5
  // % more, so that it usually suffices. It has at most 16 times the samples, because the deviation
  // is uncertain.
  const double missing = 1.05 * (reached / options.deviation) * (reached / options.deviation);
  // A result that seems reached but is not yet meaningful is tested again with twice the samples.
  const double least = reached <= options.deviation ? 2 : 1;
  const double wanted = static_cast<double>(samples) * std::clamp(missing, least, 16.0);
  const auto most = static_cast<double>(even(options.most_samples));
  return std::max(samples + 2, even(static_cast<std::size_t>(std::min(wanted, most))));
}

void sample(const Sampler& sampler, const MonteCarloOptions& options, const Context& context,
            Moments& moments, MonteCarlo& result) {
  double relative = 0;
  const std::size_t most = even(options.samples.value_or(options.most_samples));
  while (moments.samples < most) {
    const std::size_t target =
        options.samples ? most : std::min(most, next_samples(options, moments.samples, relative));
    const double total = static_cast<double>(target);
    const double from = static_cast<double>(moments.samples) / total;
    add_samples(sampler.draw, sampler.places, target - moments.samples, moments, result.times,
                context, {"sampling", from, 1});
    ++result.rounds;
    relative = relative_deviation(moments);
    result.relative_deviation.reset();
    if (means_something(relative, moments, sampler.places)) result.relative_deviation = relative;
    result.reached =
        options.samples || (result.relative_deviation && relative <= options.deviation);
    if (!options.samples && result.reached) break;
  }
}

void check_finite(const Moments& moments) {
  for (const Coefficients* part : {&moments.sum, &moments.square}) {
    for (const double value : part->values()) {
      if (std::isfinite(value)) continue;
      throw Error(ErrorCode::kInvalidInput,
                  "the coefficients are not finite numbers: the surface comes too near to the "
                  "centre");
    }
  }
}

Coefficients scaled(Coefficients f, double factor) {
  for (double& value : f.values()) value *= factor;
  return f;
}

std::vector<double> norms_of_degrees(const Coefficients& f) {
  std::vector<double> result = power_spectrum(f);
  for (double& value : result) value = std::sqrt(value);
  return result;
}

void set_norms(const StarChart& chart, MonteCarlo& result) {
  const StageTimer timer(result.times, "norms");
  Expansion& expansion = result.expansion;
  expansion.norm_squared = radius_norm_squared(chart);
  expansion.tail_strength = tail_strength(chart, RadialFunction::kRadius);
  // The errors are three deviations.
  const Coefficients& deviation = result.deviation;
  const CoefficientErrors errors{.mean = 3 * deviation.c(0, 0),
                                 .varying = 3 * std::sqrt(sum_of_squares(deviation, 1))};
  expansion.precision = precision_of(*expansion.norm_squared, expansion.coefficients, errors);
  const ParsevalRest rest = parseval_rest(*expansion.norm_squared, expansion.coefficients, errors);
  result.truncation_rms = rms_of(rest, kBelieved);
  if (result.truncation_rms) result.truncation_rms_doubt = rms_doubt(rest);
}

}  // namespace

EnumNames names_of(SamplePlaces) {
  static constexpr std::array kNames = {"edge", "triangle"};
  return {"places of random points", kNames};
}

MonteCarlo monte_carlo(const StarChart& chart, const MonteCarloOptions& options,
                       const Context& context) {
  check_fields(options);
  report_progress(context, "sampling", 0);
  const StarGeometry geometry = star_geometry(chart);
  const Sampler sampler = options.places == SamplePlaces::kEdges
                              ? edge_sampler(geometry, options.seed, FieldStart::kFace)
                              : triangle_sampler(geometry, options.seed);
  if (sampler.places == 0) {
    throw Error(ErrorCode::kInvalidInput,
                "no direction sees the surface from the centre: its faces have no area");
  }
  MonteCarlo result;
  result.places = sampler.places;
  Moments moments(options.degree);
  sample(sampler, options, context, moments, result);
  check_finite(moments);
  result.samples = moments.samples;
  const double unscale = 1 / geometry.scale;
  result.deviation = scaled(deviation_of(moments), unscale);
  result.degree_deviation = norms_of_degrees(scaled(standard_error_of(moments), unscale));
  result.expansion.coefficients = scaled(mean_of(moments), unscale);
  result.expansion.center = chart.report.center;
  result.expansion.method = std::string("monte-carlo-") + to_string(options.places);
  result.expansion.signed_sum = !chart.report.star_shaped;
  if (chart.report.star_shaped) set_norms(chart, result);
  return result;
}

}  // namespace rholm
