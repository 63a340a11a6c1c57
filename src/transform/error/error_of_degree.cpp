#include "transform/error/error_of_degree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "harmonic/nonuniform/cost_model.h"
#include "shape/vertex_range.h"
#include "transform/error/distance_check.h"
#include "transform/error/error_peaks.h"
#include "transform/error/largest_radial.h"
#include "transform/error/sampled_distances.h"

namespace rholm {
namespace {

// About this many of the points over the area stand for all where little accuracy is needed.
constexpr std::size_t kPart = 20'000;
// Number of points that show whether first order holds. They are used where the error and the limit
// differ by less than the factor kNear.
constexpr std::size_t kFew = 1000;
constexpr double kNear = 2.5;
// Few and many closest points give values that differ by a per cent.
constexpr double kCloseFew = 1.04;
// The largest error at all points is at most this many times the one at some points
// (scripts/constants: 1.9).
constexpr double kDoubt = 2;
// Root mean squares over some points and over all points differ by 0.7 %.
constexpr double kClose = 1.05;
// Points between vertices that are dense enough for one degree serve degrees up to this many times
// it.
constexpr double kDenseUpTo = 1.2;

// Points whose error was this part of the largest stand for all points where they cost less. They
// do not decide where the error is within the limit, but not well within it.
constexpr double kWorst = 0.3, kWellWithin = 0.9;

// Number of witnesses of a degree that errs too much; number of climbs to the largest distances
// (chosen).
constexpr std::size_t kWitnesses = 16, kDistancePeaks = 16;
// Largest number of witnesses for distances (chosen: some milliseconds a degree).
constexpr std::size_t kMostWitnesses = 128;
// Where closest points are used, steps from the ray may miss the closest point. Beyond this factor
// a point is too far all the same (chosen).
constexpr double kOnOtherSides = 1.2;

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

// The points may miss a fifth of the largest error where faces are long against 1/L.
constexpr double kFarWithin = 0.7;

// Returns true if the points cost more than twice the grid on which they are interpolated.
bool points_dominate(std::size_t n, int degree) {
  return error_point_cost() * static_cast<double>(n) > 2 * error_grid_cost(degree);
}

ErrorPoints part_of(const ErrorPoints& points, std::size_t n) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / n);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); i += step) indices.push_back(i);
  return points.subset(indices);
}

}  // namespace

// The sum begins at the top, so that small remainders are not lost against the large first degrees.
std::vector<double> rms_tails(const Coefficients& coefficients, double beyond) {
  const std::vector<double> energy = power_spectrum(coefficients);
  std::vector<double> tails(energy.size());
  for (std::size_t l = energy.size(); l-- > 0;) {
    tails[l] = std::sqrt(beyond / (4 * std::numbers::pi));
    beyond += energy[l];
  }
  return tails;
}

int smallest_degree(const std::vector<double>& tails, double limit) {
  std::size_t degree = tails.size() - 1;
  while (degree > 0 && tails[degree - 1] <= limit) --degree;
  return static_cast<int>(degree);
}

double error_in(const TruncationErrors& errors, const Tolerance& tolerance) {
  const bool distance = tolerance.measure == ErrorMeasure::kDistance;
  if (tolerance.norm == ErrorNorm::kRms) return distance ? *errors.distance_rms : *errors.rms;
  return distance ? *errors.measured_max_distance : *errors.measured_max;
}

ErrorOfDegree::ErrorOfDegree(const Tolerance& tolerance, ErrorSites& sites, double size,
                             const Context& context)
    : tolerance_(tolerance),
      sites_(sites),
      size_(size),
      context_(context),
      silent_{.threads = context.threads} {}

double ErrorOfDegree::of(const Expansion& expansion, int degree, double limit) {
  if (is_distance() && is_coarse(sites_.mesh()) && may_be_refined(expansion, degree, limit)) {
    closest_rule_ = true;
  }
  if (is_distance() && witnesses_.size() > 0) {
    const double value = witnessed_distance(expansion, degree, limit);
    if (value > (closest_rule_ ? kOnOtherSides : 1) * limit) return value;
  }
  if (closest_rule_) return closest_of(expansion, degree, limit);
  const double value =
      is_largest() ? largest_of(expansion, degree, limit) : rms_of(expansion, degree, limit);
  if (!is_distance() || value > kNear * limit || limit > kNear * value) return value;
  const double ratio = closest_ratio(expansion, degree, limit);
  return closest_rule_ ? closest_of(expansion, degree, limit) : ratio * value;
}

bool ErrorOfDegree::may_be_refined(const Expansion& expansion, int degree, double limit) {
  const PointErrors errors = measured(few_points(), expansion, degree, limit);
  return rholm::may_be_refined(sites_.mesh(), expansion, largest(errors.radial),
                               diagonal_of(sites_.mesh(), {.threads = sites_.threads()}));
}

// Returns the factor for the error to first order. May decide to use closest
// points from now on: a surface that is steep at one degree is steep at the next.
double ErrorOfDegree::closest_ratio(const Expansion& expansion, int degree, double limit) {
  if (!may_be_refined(expansion, degree, limit)) return 1;
  const ErrorPoints over_area = part_of(sites_.over_area(), kPart);
  const ErrorPoints none, &worst = is_largest() ? some_points() : none;
  const RadialModel model(expansion, degree, over_area.size() + worst.size(), true,
                          precision(limit), silent_);
  const PointErrors of_area = point_errors(over_area, model, true, silent_);
  const PointErrors of_worst = point_errors(worst, model, true, silent_);
  const SampledDistances sampled = sampled_distances(
      sites_.mesh(), sites_.center(), model, {over_area, of_area}, {worst, of_worst}, silent_);
  closest_rule_ = !sampled.suffice(sites_.mesh());
  const double first = is_largest() ? largest(sizes(of_worst)) : rms_distance(of_area, 0);
  return first > 0 ? (is_largest() ? sampled.max : sampled.rms) / first : 1;
}

double ErrorOfDegree::witnessed_distance(const Expansion& expansion, int degree,
                                         double limit) const {
  const RadialModel model(expansion, degree, witnesses_.size(), true, precision(limit), silent_);
  return largest(distances_to_model(model, witnesses_));
}

// Uses few points unless their value is close to the limit.
double ErrorOfDegree::closest_of(const Expansion& expansion, int degree, double limit) {
  const ErrorPoints extreme = extreme_points(sites_.mesh(), sites_.center(), sites_.scan(), degree);
  const auto at = [&](bool fine) {
    const SurfaceDistances found =
        sites_.closest(fine).measure(expansion, degree, extreme, precision(limit), silent_);
    return is_largest() ? found.max : found.rms;
  };
  const double value = at(false);
  if (is_largest() && value > limit) {
    witness(extreme, measured(extreme, expansion, degree, limit).to_model, degree);
  }
  return value > kCloseFew * limit || kCloseFew * value < limit ? value : at(true);
}

double ErrorOfDegree::rms_of(const Expansion& expansion, int degree, double limit) {
  const double value = rms_distance(measured(some_points(), expansion, degree, limit), 0);
  if (value > kClose * limit || kClose * value < limit) return value;
  return rms_distance(measured(sites_.over_area(), expansion, degree, limit), 0);
}

double ErrorOfDegree::largest_of(const Expansion& expansion, int degree, double limit) {
  if (first_ < 0) first_ = degree;
  if (degree <= first_ && degree_of_all_ < 0) {
    const double value = largest(sizes(measured(some_points(), expansion, degree, limit)));
    if (value > kDoubt * limit) return value;
  }
  if (!is_distance() && witnesses_.size() > 0) {
    const double value = largest(sizes(measured(witnesses_, expansion, degree, limit)));
    if (value > limit) return value;
  }
  const ErrorPoints& all = all_points(degree);
  if (worst_.size() > 0 && points_dominate(all.size(), degree)) {
    const std::vector<double> errors = sizes(measured(worst_, expansion, degree, limit));
    const double value = largest(errors);
    if (value > limit) witness(worst_, errors, degree);
    if (value > limit || value < kWellWithin * limit) return value;
  }
  const std::vector<double> errors = sizes(measured(all, expansion, degree, limit));
  const double value = largest(errors);
  keep_worst(all, errors, kWorst * value);
  if (value > limit) witness(all, errors, degree);
  if (value > limit || value < kFarWithin * limit) return value;
  return between_points(expansion, degree, limit, all, errors);
}

// Returns the largest error on the whole surface, if the errors at the points are within the
// limit.
double ErrorOfDegree::between_points(const Expansion& expansion, int degree, double limit,
                                     const ErrorPoints& points, const std::vector<double>& errors) {
  Expansion first = expansion;
  first.coefficients = expansion.coefficients.resized(degree);
  const RadialModel model(first, degree, points.size(), is_distance(), precision(limit), silent_);
  if (!is_distance()) {
    const double rms = root_mean_square(errors);
    const LargestRadial found = largest_radial(first, model, points, errors, rms, sites_, silent_);
    witnesses_.append(found.worst(degree));
    return found.value;
  }
  // Climbs as truncation_errors() does: from the shape to the model.
  const Context alone{.threads = 1};
  const PeakSearch search{
      point_errors(points, model, true, silent_).to_model,
      [&](const ErrorPoints& at) { return point_errors(at, model, true, alone).to_model; }};
  return std::max(largest(errors), largest(local_maxima(sites_.mesh(), sites_.center(), points,
                                                        search, degree, kDistancePeaks, silent_)
                                               .values));
}

void ErrorOfDegree::witness(const ErrorPoints& points, const std::vector<double>& errors,
                            int degree) {
  if (is_distance() && witnesses_.size() >= kMostWitnesses) return;
  witnesses_.append(points.subset(worst_apart(points, errors, degree, kWitnesses)));
}

void ErrorOfDegree::keep_worst(const ErrorPoints& points, const std::vector<double>& errors,
                               double least) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] >= least) indices.push_back(i);
  }
  worst_ = points.subset(indices);
}

const ErrorPoints& ErrorOfDegree::some_points() {
  if (some_.size() == 0) {
    if (is_largest()) some_ = sites_.vertices();
    some_.append(part_of(sites_.over_area(), kPart));
  }
  return some_;
}

const ErrorPoints& ErrorOfDegree::all_points(int degree) {
  if (degree > kDenseUpTo * degree_of_all_) degree_of_all_ = degree;
  return sites_.all(degree_of_all_);
}

const ErrorPoints& ErrorOfDegree::few_points() {
  if (few_.size() == 0) few_ = part_of(sites_.over_area(), kFew);
  return few_;
}

// Returns a thousandth of the tolerance.
double ErrorOfDegree::precision(double limit) const {
  return std::clamp(1e-3 * limit / size_, 1e-12, 1e-3);
}

PointErrors ErrorOfDegree::measured(const ErrorPoints& points, const Expansion& expansion,
                                    int degree, double limit) const {
  report_progress(context_, "errors", 0);
  return point_errors(points, expansion, degree, is_distance(), precision(limit), silent_);
}

// Returns for each point the error of which the largest error is the maximum.
std::vector<double> ErrorOfDegree::sizes(PointErrors errors) const {
  if (!is_distance()) return std::move(errors.radial);
  for (std::size_t i = 0; i < errors.to_model.size(); ++i) {
    errors.to_model[i] = std::max(errors.to_model[i], errors.to_shape[i]);
  }
  return std::move(errors.to_model);
}

double sampled_rms(const Expansion& expansion, ErrorSites& sites, double precision,
                   const Context& context) {
  const ErrorPoints points = part_of(sites.over_area(), kPart);
  const PointErrors errors = point_errors(points, expansion, expansion.coefficients.degree(), false,
                                          precision, {.threads = context.threads});
  return rms_over_solid_angle(points, errors, 0);
}

}  // namespace rholm
