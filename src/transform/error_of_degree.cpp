#include "transform/error_of_degree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/compensated_sum.h"
#include "base/parallel.h"

namespace rholm {
namespace {

// Points over the area: a root mean square to 0.3 %, and to 0.7 % for a first estimate.
constexpr std::size_t kAreaPoints = 100'000;
constexpr std::size_t kPilotPoints = 20'000;
// The largest error is searched for at vertices and so many other points, and confirmed at all.
constexpr std::size_t kSearchPoints = 30'000;
// And degrees with so many of these.
constexpr std::size_t kFewPoints = 3000;
constexpr int kMostConfirmations = 5;

ErrorPoints every(const ErrorPoints& points, std::size_t step) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); i += step) indices.push_back(i);
  return points.subset(indices);
}

}  // namespace

ErrorOfDegree::ErrorOfDegree(const ToleranceProblem& problem, const Tolerance& tolerance,
                             const Expansion& expansion, bool final, double at_vertices,
                             const Context& context)
    : problem_(problem),
      tolerance_(tolerance),
      expansion_(expansion),
      final_(final),
      at_vertices_(at_vertices),
      context_(context),
      silent_{.threads = context.threads} {
  if (tolerance.norm == ErrorNorm::kMax) {
    all_ = extreme_points(problem.mesh, problem.center, degree());
    if (final) all_.append(area_points(problem.mesh, problem.center, kAreaPoints));
    // Vertices, and of the others a part.
    points_ = extreme_points(problem.mesh, problem.center, 0);
    points_.append(every(all_, all_.size() / kSearchPoints + 1));
  } else if (is_distance() || !final) {
    points_ = area_points(problem.mesh, problem.center, final ? kAreaPoints : kPilotPoints);
  }
  if (is_spectral()) set_tails();
}

double ErrorOfDegree::of(int degree) const {
  if (is_spectral()) return tails_[static_cast<std::size_t>(degree)];
  return degree == this->degree() ? value_of(whole()) : measured(points_, degree);
}

int ErrorOfDegree::estimate(const DegreeBracket& bracket) const {
  if (is_spectral()) return smallest_spectral();
  const ErrorPoints few = few_of(points_, whole());
  // What the few say of all.
  const double few_value = measured(few, degree());
  const double factor = few_value > 0 ? value_of(whole()) / few_value : 1;
  return narrowed(few, factor, bracket).good;
}

std::optional<DegreeBracket> ErrorOfDegree::confirm(int estimate) const {
  const int most = degree();
  DegreeBracket bracket{.bad = -1, .good = most + 1};
  if (is_spectral()) {
    if (tails_[static_cast<std::size_t>(most)] > tolerance_.error) return std::nullopt;
    bracket.good = smallest_spectral();
    bracket.good_value = tails_[static_cast<std::size_t>(bracket.good)];
    return bracket;
  }
  if (tolerance_.norm == ErrorNorm::kMax) return confirm_largest();
  int guess = std::min(estimate, most);
  for (int i = 0; i < kMostConfirmations || bracket.good > most; ++i) {
    bracket.add(guess, of(guess), tolerance_.error);
    if (bracket.good <= most && bracket.closed()) break;
    if (bracket.bad == most) return std::nullopt;
    if (bracket.good > most) {
      guess = most;
    } else if (bracket.bad < 0) {
      guess = std::max(0, bracket.good - bracket.step());
      if (bracket.good == 0) break;
    } else {
      guess = bracket.guess(tolerance_.error);
    }
  }
  return bracket;
}

// A degree is bad if the few points say so, the worst of a higher degree among them; one that they
// take for good has to be so at all points.
std::optional<DegreeBracket> ErrorOfDegree::confirm_largest() const {
  DegreeBracket bracket{.bad = -1,
                        .good = degree(),
                        .bad_value = 0,
                        .good_value = value_of(whole()),
                        .at_vertices = at_vertices_ > 0};
  if (bracket.good_value > tolerance_.error) return std::nullopt;
  ErrorPoints few = few_of(points_, whole());
  for (int i = 0; i < kMostConfirmations; ++i) {
    const DegreeBracket guess = narrowed(few, 1, bracket);
    bracket.bad = guess.bad, bracket.bad_value = guess.bad_value;
    const PointErrors errors = errors_of(all_, guess.good);
    const double value = value_of(errors);
    if (value <= tolerance_.error) {
      bracket.good = guess.good, bracket.good_value = value;
      return bracket;
    }
    if (guess.good == degree()) return std::nullopt;
    bracket.bad = guess.good, bracket.bad_value = value;
    few.append(few_of(all_, errors));
  }
  bracket.good_value = reached();
  if (bracket.good_value > tolerance_.error) return std::nullopt;
  return bracket;
}

double ErrorOfDegree::reached() const {
  return tolerance_.norm == ErrorNorm::kMax ? measured(all_, degree()) : of(degree());
}

DegreeBracket ErrorOfDegree::narrowed(const ErrorPoints& few, double factor,
                                      DegreeBracket bracket) const {
  while (!bracket.closed()) {
    const int guess = bracket.guess(tolerance_.error);
    bracket.add(guess, factor * measured(few, guess), tolerance_.error);
  }
  return bracket;
}

bool ErrorOfDegree::is_spectral() const {
  return tolerance_.norm == ErrorNorm::kRms && !is_distance();
}

// Summed from the top: small remainders are not lost against the large first degrees.
void ErrorOfDegree::set_tails() {
  const std::vector<double> energy = power_spectrum(expansion_.coefficients);
  double beyond = 0;
  if (final_) {
    CompensatedSum rest;
    rest.add(problem_.norm_squared);
    for (const double e : energy) rest.add(-e);
    beyond = std::max(0.0, rest.value());
  } else {
    const double rms = rms_over_solid_angle(points_, whole());
    beyond = 4 * std::numbers::pi * rms * rms;
  }
  tails_.resize(energy.size());
  for (std::size_t l = energy.size(); l-- > 0;) {
    tails_[l] = std::sqrt(beyond / (4 * std::numbers::pi));
    beyond += energy[l];
  }
}

int ErrorOfDegree::smallest_spectral() const {
  std::size_t degree = tails_.size() - 1;
  while (degree > 0 && tails_[degree - 1] <= tolerance_.error) --degree;
  return static_cast<int>(degree);
}

PointErrors ErrorOfDegree::errors_of(const ErrorPoints& points, int degree) const {
  // A thousandth of the tolerance, against the size of the function.
  const double size = std::sqrt(problem_.norm_squared / (4 * std::numbers::pi));
  const double precision = std::clamp(1e-3 * tolerance_.error / size, 1e-12, 1e-3);
  report_progress(context_, "errors", 0);
  return point_errors(points, expansion_, degree, is_distance(), precision, silent_);
}

const PointErrors& ErrorOfDegree::whole() const {
  if (!whole_) whole_ = errors_of(points_, degree());
  return *whole_;
}

double ErrorOfDegree::value_of(const PointErrors& errors) const {
  if (tolerance_.norm == ErrorNorm::kRms) return rms_distance(errors);
  if (!is_distance()) return largest(errors.radial);
  return std::max(largest(errors.to_model), largest(errors.to_shape));
}

double ErrorOfDegree::measured(const ErrorPoints& points, int degree) const {
  return value_of(errors_of(points, degree));
}

// Points that stand for all: every n-th one and, for the largest error, the worst.
ErrorPoints ErrorOfDegree::few_of(const ErrorPoints& points, const PointErrors& errors) const {
  const std::vector<double>& values = is_distance() ? errors.to_model : errors.radial;
  std::vector<std::size_t> indices;
  if (tolerance_.norm == ErrorNorm::kMax) {
    indices.resize(values.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    const auto worst = static_cast<std::ptrdiff_t>(std::min(values.size(), kFewPoints));
    std::partial_sort(indices.begin(), indices.begin() + worst, indices.end(),
                      [&](std::size_t a, std::size_t b) {
                        return values[a] != values[b] ? values[a] > values[b] : a < b;
                      });
    indices.resize(static_cast<std::size_t>(worst));
  }
  const std::size_t step = std::max<std::size_t>(1, values.size() / kFewPoints);
  for (std::size_t i = 0; i < values.size(); i += step) indices.push_back(i);
  return points.subset(indices);
}

}  // namespace rholm
