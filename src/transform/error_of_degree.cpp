#include "transform/error_of_degree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace rholm {
namespace {

// Every so many of the points over the area stand for all where little is asked.
constexpr std::size_t kPart = 5;
// What some points find is at most this much less than what all do (measured: 1.9).
constexpr double kDoubt = 2;
// Root mean squares of some points differ from those of all by 0.7 %.
constexpr double kClose = 1.05;
// Points between vertices that are dense enough for one degree are for those up to this times it.
constexpr double kDenseUpTo = 1.2;

// Points whose error was this part of the largest stand for all where they cost less, unless they
// say that it is within the limit, but not well within.
constexpr double kWorst = 0.3, kWellWithin = 0.9;

// Whether the points cost more than the grid that they are interpolated on: 60 ns each, 45 L^2 ns
// (measured).
bool points_dominate(std::size_t n, int degree) {
  return 60.0 * static_cast<double>(n) > 90.0 * degree * degree;
}

ErrorPoints every(const ErrorPoints& points, std::size_t step) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); i += step) indices.push_back(i);
  return points.subset(indices);
}

}  // namespace

// Summed from the top: small remainders are not lost against the large first degrees.
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
  return is_largest() ? largest_of(expansion, degree, limit) : rms_of(expansion, degree, limit);
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
  const ErrorPoints& all = all_points(degree);
  if (worst_.size() > 0 && points_dominate(all.size(), degree)) {
    const double value = largest(sizes(measured(worst_, expansion, degree, limit)));
    if (value > limit || value < kWellWithin * limit) return value;
  }
  const std::vector<double> errors = sizes(measured(all, expansion, degree, limit));
  const double value = largest(errors);
  keep_worst(all, errors, kWorst * value);
  return value;
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
    some_.append(every(sites_.over_area(), kPart));
  }
  return some_;
}

const ErrorPoints& ErrorOfDegree::all_points(int degree) {
  if (degree > kDenseUpTo * degree_of_all_) degree_of_all_ = degree;
  return sites_.all(degree_of_all_);
}

PointErrors ErrorOfDegree::measured(const ErrorPoints& points, const Expansion& expansion,
                                    int degree, double limit) const {
  // A thousandth of the tolerance.
  const double precision = std::clamp(1e-3 * limit / size_, 1e-12, 1e-3);
  report_progress(context_, "errors", 0);
  return point_errors(points, expansion, degree, is_distance(), precision, silent_);
}

// Of each point what the largest error is the largest of.
std::vector<double> ErrorOfDegree::sizes(PointErrors errors) const {
  if (!is_distance()) return std::move(errors.radial);
  for (std::size_t i = 0; i < errors.to_model.size(); ++i) {
    errors.to_model[i] = std::max(errors.to_model[i], errors.to_shape[i]);
  }
  return std::move(errors.to_model);
}

double sampled_rms(const Expansion& expansion, ErrorSites& sites, double precision,
                   const Context& context) {
  const ErrorPoints points = every(sites.over_area(), kPart);
  const PointErrors errors = point_errors(points, expansion, expansion.coefficients.degree(), false,
                                          precision, {.threads = context.threads});
  return rms_over_solid_angle(points, errors, 0);
}

}  // namespace rholm
