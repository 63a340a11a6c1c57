#include "transform/tolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "transform/error_points.h"
#include "transform/mesh_pass.h"

namespace rholm {
namespace {

// Points over the area: a root mean square to 0.3 %, and to 0.7 % for a first estimate.
constexpr std::size_t kAreaPoints = 100'000;
constexpr std::size_t kPilotPoints = 20'000;
// A degree is searched for with so many of the points, and confirmed with all.
constexpr std::size_t kFewPoints = 3000;
constexpr int kMostConfirmations = 5;
// A pilot goes beyond the degree it expects: another one costs as much as this.
constexpr double kBeyond = 1.3;

// Between a degree that does not keep the tolerance and one that does.
struct Bracket {
  int bad = -1, good = 0;
  double bad_value = 0, good_value = 0;
  int same_side = 0;  // guesses in a row on one side

  // To a fiftieth: the error itself is hardly known better.
  bool closed() const { return good - bad <= std::max(1, good / 50); }
  void add(int degree, double value, double limit) {
    const bool is_good = value <= limit;
    same_side = is_good == (same_side > 0) ? same_side + (is_good ? 1 : -1) : (is_good ? 1 : -1);
    (is_good ? good : bad) = degree;
    (is_good ? good_value : bad_value) = value;
  }
  // Errors fall like a power of the degree.
  int guess(double limit) const {
    const int low = bad + 1, high = good - 1;
    double t = 0.5;
    const double from = std::log(std::max(bad, 0) + 1.0), to = std::log(good + 1.0);
    if (bad >= 0 && good_value > 0 && std::abs(same_side) < 2) {
      t = std::log(bad_value / limit) / std::log(bad_value / good_value);
    }
    const double degree = std::exp(from + std::clamp(t, 0.05, 0.95) * (to - from)) - 1;
    return std::clamp(static_cast<int>(std::ceil(degree)), low, high);
  }
};

// The error of the first L degrees of one set of coefficients, for any L.
class ErrorOfDegree {
 public:
  // `final`: the coefficients are exact enough for Parseval, and all points are used.
  ErrorOfDegree(const ToleranceProblem& problem, const Tolerance& tolerance,
                const Expansion& expansion, bool final, const Context& context)
      : problem_(problem),
        tolerance_(tolerance),
        expansion_(expansion),
        final_(final),
        context_(context),
        silent_{.threads = context.threads} {
    const int degree = expansion.coefficients.degree();
    if (tolerance.norm == ErrorNorm::kMax) {
      points_ = extreme_points(problem.mesh, problem.center, degree);
      points_.append(area_points(problem.mesh, problem.center, kAreaPoints));
    } else if (is_distance() || !final) {
      points_ = area_points(problem.mesh, problem.center, final ? kAreaPoints : kPilotPoints);
    }
    if (is_spectral()) set_tails();
  }

  double of(int degree) const { return is_spectral() ? tails_[degree] : measured(points_, degree); }

  // An estimate of the smallest degree whose error is within the tolerance, that of the
  // coefficients being good; `bracket` says what is known.
  int estimate(Bracket bracket) const {
    if (is_spectral()) return smallest_spectral();
    const PointErrors errors = errors_of(points_, bracket.good);
    const ErrorPoints few = few_of(errors);
    const double few_value = measured(few, bracket.good);
    // What the few say of all.
    const double factor = few_value > 0 ? value_of(errors) / few_value : 1;
    while (!bracket.closed()) {
      const int guess = bracket.guess(tolerance_.error);
      bracket.add(guess, factor * measured(few, guess), tolerance_.error);
    }
    return bracket.good;
  }

  // The smallest good degree near an estimate, and its error; none if that of the coefficients is
  // not good either.
  std::optional<Bracket> confirm(int estimate) const {
    const int most = expansion_.coefficients.degree();
    Bracket bracket{.bad = -1, .good = most + 1};
    if (is_spectral()) {
      if (tails_[most] > tolerance_.error) return std::nullopt;
      bracket.good = smallest_spectral();
      bracket.good_value = tails_[bracket.good];
      return bracket;
    }
    int guess = std::min(estimate, most);
    for (int i = 0; i < kMostConfirmations || bracket.good > most; ++i) {
      bracket.add(guess, of(guess), tolerance_.error);
      if (bracket.good <= most && (bracket.closed() || bracket.bad + 1 == bracket.good)) break;
      if (bracket.bad == most) return std::nullopt;
      if (bracket.good > most) {
        guess = most;
      } else if (bracket.bad < 0) {
        guess = std::max(0, bracket.good - std::max(1, bracket.good / 50));
        if (bracket.good == 0) break;
      } else {
        guess = bracket.guess(tolerance_.error);
      }
    }
    return bracket;
  }

 private:
  // Known for all degrees from the energies.
  bool is_spectral() const { return tolerance_.norm == ErrorNorm::kRms && !is_distance(); }
  bool is_distance() const { return tolerance_.measure == ErrorMeasure::kDistance; }

  // Summed from the top: small remainders are not lost against the large first degrees.
  void set_tails() {
    const std::vector<double> energy = power_spectrum(expansion_.coefficients);
    double beyond = 0;
    if (final_) {
      CompensatedSum rest;
      rest.add(problem_.norm_squared);
      for (const double e : energy) rest.add(-e);
      beyond = std::max(0.0, rest.value());
    } else {
      const int degree = expansion_.coefficients.degree();
      const double rms = rms_over_solid_angle(points_, errors_of(points_, degree));
      beyond = 4 * std::numbers::pi * rms * rms;
    }
    tails_.resize(energy.size());
    for (std::size_t l = energy.size(); l-- > 0;) {
      tails_[l] = std::sqrt(beyond / (4 * std::numbers::pi));
      beyond += energy[l];
    }
  }

  int smallest_spectral() const {
    int degree = expansion_.coefficients.degree();
    while (degree > 0 && tails_[degree - 1] <= tolerance_.error) --degree;
    return degree;
  }

  PointErrors errors_of(const ErrorPoints& points, int degree) const {
    // A thousandth of the tolerance, against the size of the function.
    const double size = std::sqrt(problem_.norm_squared / (4 * std::numbers::pi));
    const double precision = std::clamp(1e-3 * tolerance_.error / size, 1e-12, 1e-3);
    report_progress(context_, "errors", 0);
    return point_errors(points, expansion_, degree, is_distance(), precision, silent_);
  }
  double value_of(const PointErrors& errors) const {
    if (tolerance_.norm == ErrorNorm::kRms) return rms_distance(errors);
    if (!is_distance()) return largest(errors.radial);
    return std::max(largest(errors.to_model), largest(errors.to_shape));
  }
  double measured(const ErrorPoints& points, int degree) const {
    return value_of(errors_of(points, degree));
  }

  // Points that stand for all: every n-th one and, for the largest error, the worst.
  ErrorPoints few_of(const PointErrors& errors) const {
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
    return points_.subset(indices);
  }

  const ToleranceProblem& problem_;
  const Tolerance& tolerance_;
  const Expansion& expansion_;
  bool final_;
  const Context& context_;
  Context silent_;
  std::vector<double> tails_;
  ErrorPoints points_;
};

struct Known {
  int degree;
  double value;
};

// Where the decay of the error from one degree to another reaches the tolerance.
int next_degree(const Known& from, const Known& to, const Tolerance& tolerance) {
  const double decay =
      std::log(from.value / to.value) / std::log((to.degree + 1.0) / (from.degree + 1.0));
  const double slope = std::clamp(decay, 0.4, 6.0);
  const double guess = kBeyond * to.degree * std::pow(to.value / tolerance.error, 1 / slope);
  const double next = std::clamp(guess, 1.15 * to.degree + 2, 5.0 * to.degree + 8);
  return static_cast<int>(std::min<double>(next, tolerance.max_degree));
}

}  // namespace

void check(const Tolerance& tolerance) {
  if (!(tolerance.error > 0 && std::isfinite(tolerance.error))) {
    throw Error(ErrorCode::kInvalidInput,
                "the tolerance must be above 0, not " + std::to_string(tolerance.error));
  }
  if (tolerance.max_degree < 0 || tolerance.max_degree > kMaxDegree) {
    throw Error(ErrorCode::kInvalidInput, "the largest degree must be between 0 and " +
                                              std::to_string(kMaxDegree) + ", not " +
                                              std::to_string(tolerance.max_degree));
  }
}

int first_degree(std::size_t n_triangles, const Tolerance& tolerance) {
  // The edges' angle times this is about 0.6: most triangles are lumped (performance.md).
  const double degree = 0.15 * std::sqrt(static_cast<double>(n_triangles));
  return std::min(static_cast<int>(std::clamp(degree, 12.0, 96.0)), tolerance.max_degree);
}

namespace {

// `mean`: of the radius.
double absolute_error(const ToleranceProblem& problem, const Tolerance& tolerance, double mean) {
  switch (tolerance.unit) {
    case ToleranceUnit::kAbsolute:
      return tolerance.error;
    case ToleranceUnit::kDiagonal:
      return tolerance.error * problem.diagonal;
    case ToleranceUnit::kRadius:
      return tolerance.error * mean;
  }
  return tolerance.error;
}

}  // namespace

Precisions precisions_for(const ToleranceProblem& problem, const Tolerance& tolerance) {
  const double size = std::sqrt(problem.norm_squared / (4 * std::numbers::pi));
  const double relative = absolute_error(problem, tolerance, size) / size;
  // Parseval's difference of squares must hold a few parts in a thousand.
  const bool parseval =
      tolerance.norm == ErrorNorm::kRms && tolerance.measure == ErrorMeasure::kRadius;
  const double needed = parseval ? 1e-3 * relative * relative : 1e-3 * relative;
  const double final = std::min(problem.precision, std::clamp(needed, 1e-13, 1e-2));
  return {.pilot = std::max(final, std::clamp(0.03 * relative, 1e-7, 1e-3)), .final = final};
}

ToleranceAnalysis search_tolerance(const ToleranceProblem& problem, const Tolerance& wanted,
                                   const Analysis& pilot, const Context& context) {
  const Precisions precisions = precisions_for(problem, wanted);
  ToleranceAnalysis result;
  Tolerance tolerance = wanted;
  const auto take = [&](Analysis analysis) {
    result.analysis = std::move(analysis);
    Expansion& expansion = result.analysis.expansion;
    result.degrees.push_back(expansion.coefficients.degree());
    expansion.norm_squared = problem.norm_squared;
    const double mean = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
    tolerance.error = result.allowed = absolute_error(problem, wanted, mean);
    return expansion.coefficients.degree();
  };
  // Pilots: coefficients and points good enough to say which degree it will be.
  int estimate = 0;
  int degree = take(pilot);
  for (std::optional<Known> before;;) {
    const ErrorOfDegree error(problem, tolerance, result.analysis.expansion, false, context);
    const Known now{degree, error.of(degree)};
    if (!before) before = Known{degree / 2, error.of(degree / 2)};
    if (now.value <= tolerance.error) {
      const bool fails = before->value > tolerance.error;
      estimate = error.estimate({.bad = fails ? before->degree : -1,
                                 .good = degree,
                                 .bad_value = before->value,
                                 .good_value = now.value});
      break;
    }
    estimate = tolerance.max_degree;
    if (degree == tolerance.max_degree) break;
    const int next = next_degree(*before, now, tolerance);
    before = now;
    degree = take(problem.transform(next, precisions.pilot));
  }
  // Some more than they say, so that another try is rare.
  degree = static_cast<int>(std::min<double>(1.03 * estimate + 2, tolerance.max_degree));
  for (;;) {
    degree = take(problem.transform(degree, precisions.final));
    Coefficients& coefficients = result.analysis.expansion.coefficients;
    const ErrorOfDegree error(problem, tolerance, result.analysis.expansion, true, context);
    if (const std::optional<Bracket> found = error.confirm(estimate)) {
      result.met = true;
      result.reached = found->good_value;
      coefficients = coefficients.resized(found->good);
      return result;
    }
    result.reached = error.of(degree);
    if (degree == tolerance.max_degree) return result;
    estimate = degree;
    const Known half{degree / 2, error.of(degree / 2)};
    degree = next_degree(half, {degree, result.reached}, tolerance);
  }
}

const char* to_string(ErrorNorm norm) { return norm == ErrorNorm::kRms ? "rms" : "max"; }

const char* to_string(ErrorMeasure measure) {
  return measure == ErrorMeasure::kRadius ? "radius" : "distance";
}

const char* to_string(ToleranceUnit unit) {
  switch (unit) {
    case ToleranceUnit::kAbsolute:
      return "absolute";
    case ToleranceUnit::kDiagonal:
      return "diagonal";
    case ToleranceUnit::kRadius:
      return "radius";
  }
  return "unknown";
}

ToleranceUnit parse_tolerance_unit(const std::string& name) {
  for (const ToleranceUnit unit :
       {ToleranceUnit::kAbsolute, ToleranceUnit::kDiagonal, ToleranceUnit::kRadius}) {
    if (name == to_string(unit)) return unit;
  }
  throw Error(ErrorCode::kInvalidInput,
              "unknown unit '" + name + "': absolute, diagonal or radius");
}

ErrorNorm parse_error_norm(const std::string& name) {
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    if (name == to_string(norm)) return norm;
  }
  throw Error(ErrorCode::kInvalidInput, "unknown norm '" + name + "': rms or max");
}

ErrorMeasure parse_error_measure(const std::string& name) {
  for (const ErrorMeasure measure : {ErrorMeasure::kRadius, ErrorMeasure::kDistance}) {
    if (name == to_string(measure)) return measure;
  }
  throw Error(ErrorCode::kInvalidInput, "unknown measure '" + name + "': radius or distance");
}

}  // namespace rholm
