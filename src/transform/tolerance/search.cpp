#include "transform/tolerance/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "transform/error/error_of_degree.h"
#include "transform/error/error_sites.h"
#include "transform/error/partial_errors.h"
#include "transform/tolerance/degree_bracket.h"
#include "transform/transform.h"

namespace rholm {
namespace {

// A search between degrees ends at an error in this range, times the tolerance, and aims at the
// middle. The lower end is chosen: without it commands took up to twice as long on boxes. Where the
// error falls like 1 / (L + 1), as at vertices and slower than elsewhere, a degree 5 % lower would
// be too low. The upper end leaves room for the errors of coarse coefficients. In one search of 180
// final coefficients were above the tolerance after all (scripts/measure-tolerance: one more degree
// computed).
constexpr double kEnough = 0.95, kMargin = 0.997, kAim = (kEnough + kMargin) / 2;
// Tails of final coefficients are exact, tails of coarse ones are off by 0.7 % (sampled_rms). Three
// times that is 1.4 % of the degree where tails fall like (L + 1)^-1.5, as for edges (method 5),
// and less where they fall faster. Degrees that are too many are cut off.
constexpr double kFinalByEnergies = 1.014;

// Final coefficients have 3 % more degrees than coarse ones ask for, because coarse ones may be a
// little too good (chosen).
constexpr double kFinalByWitnesses = 1.03;
// Largest error at points because of errors of coefficients, in root mean squares (chosen).
constexpr double kUncertainty = 10;

// A distance that is this many times too large to first order is too large in fact (chosen).
constexpr double kTooFar = 2;
// Root mean squares of distances and of radial errors
// are proportional within this factor (chosen).
constexpr double kProportional = 1.1;
// A degree whose distances are this many times too large at few points is not measured at all
// points (chosen: twice the difference between both).
constexpr double kScreened = 1.01;

class Search {
 public:
  Search(const ToleranceProblem& problem, const Tolerance& tolerance, const Context& context)
      : problem_(problem),
        tolerance_(tolerance),
        precisions_(precisions_for(problem, tolerance)),
        context_(context),
        sites_(problem.mesh, problem.center, context.threads),
        error_(tolerance, sites_, std::sqrt(problem.norm_squared / (4 * std::numbers::pi)),
               context) {}

  ToleranceTransform run(const Transform& first) {
    take(first);
    double degree = by_energies() ? kFinalByEnergies * degree_by_energies() + 1
                                  : kFinalByWitnesses * degree_by_points() + 1;
    for (;;) {
      finish(degree);
      result_.met = result_.reached <= result_.allowed;
      if (result_.met || highest() == tolerance_.max_degree) return std::move(result_);
      // The coarse coefficients were a little too good.
      degree = std::ceil((highest() + 1) * result_.reached / result_.allowed);
    }
  }

 private:
  bool is_largest() const { return tolerance_.norm == ErrorNorm::kMax; }
  bool is_distance() const { return tolerance_.measure == ErrorMeasure::kDistance; }
  bool by_energies() const { return !is_largest() && !is_distance(); }
  Expansion& expansion() { return result_.transform.expansion; }
  // Returns the degree of the present coefficients.
  int highest() { return expansion().coefficients.degree(); }

  void take(Transform transform) {
    result_.transform = std::move(transform);
    result_.degrees.push_back(highest());
    expansion().center = problem_.center;
    expansion().norm_squared = problem_.norm_squared;
    const double mean = expansion().coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
    result_.allowed = absolute_tolerance(problem_, tolerance_, mean);
  }
  int within_most(double degree) const {
    return static_cast<int>(std::min<double>(degree, tolerance_.max_degree));
  }

  // Returns true if the error of the present coefficients is too large, and higher degrees are
  // allowed.
  bool goes_on(double error, double limit) {
    return error > limit && highest() < tolerance_.max_degree;
  }
  // Computes coarse coefficients of twice as many degrees.
  void double_degree() {
    take(problem_.pilot({within_most(2.0 * (highest() + 1)), precisions_.pilot}));
  }

  // Parseval's tails are known at every degree at once, except for the energy beyond all degrees.
  int degree_by_energies() {
    double beyond = rms_beyond();
    while (goes_on(beyond, result_.allowed)) {
      double_degree();
      beyond = rms_beyond();
    }
    return smallest_degree(rms_tails(expansion().coefficients, energy_of(beyond)), result_.allowed);
  }
  double rms_beyond() { return sampled_rms(expansion(), sites_, precisions_.pilot, context_); }
  static double energy_of(double rms) { return 4 * std::numbers::pi * rms * rms; }

  // Measures errors at points: of all present degrees until their error is small enough, then
  // between.
  int degree_by_points() {
    DegreeBracket bracket;
    while (goes_on(try_degree(highest(), bracket), kMargin * result_.allowed)) double_degree();
    if (bracket.bad == highest()) return highest();
    while (!bracket.closed() && bracket.good_value < kEnough * result_.allowed) {
      try_degree(bracket.guess(kAim * result_.allowed), bracket);
    }
    return bracket.good;
  }

  double try_degree(int degree, DegreeBracket& bracket) {
    const double limit = kMargin * result_.allowed;
    const double error = error_.of(expansion(), degree, limit);
    bracket.add(degree, error, limit);
    return error;
  }

  // Computes final coefficients, and their error as it is measured for any model.
  void finish(double degree) {
    take(problem_.transform({within_most(degree), precisions_.final}));
    if (by_energies()) {
      cut_by_parseval(expansion().coefficients);
      return;
    }
    cut_to_smallest();
  }

  void measure(ErrorPoints* worst) {
    const bool predict = problem_.mesh.n_faces <= kMostPredicted;
    const double precision = known_error(result_.transform);
    expansion().errors = truncation_errors(
        expansion(), {.precision = precision, .predict = predict}, sites_, context_, worst);
    result_.reached = error_in(*expansion().errors, tolerance_);
  }

  // Cuts to the smallest degree within the tolerance, if there is one. Each lower degree errs more,
  // at points at which some degree erred most or where it was measured.
  void cut_to_smallest() {
    const Transform all = result_.transform;
    const Coefficients& coefficients = all.expansion.coefficients;
    std::vector<double> least = least_errors(coefficients);
    const auto may_be_good = [&](double error) { return error <= result_.allowed + uncertainty(); };
    int tried = -1;
    for (;;) {
      const auto good = std::ranges::find_if(least, may_be_good);
      if (good == least.end()) break;
      const int degree = static_cast<int>(good - least.begin());
      *good = std::numeric_limits<double>::infinity();
      if (is_distance() && degree < coefficients.degree() && is_too_far(all.expansion, degree)) {
        continue;
      }
      tried = degree;
      ErrorPoints worst;
      measure_first(tried, all, worst);
      if (result_.reached <= result_.allowed) return;
      if (is_distance()) continue;
      const std::vector<double> more = largest_partial_errors(worst, coefficients, context_);
      for (std::size_t l = 0; l < least.size(); ++l) least[l] = std::max(least[l], more[l]);
    }
    if (tried != coefficients.degree()) {
      result_.transform = all;
      measure(nullptr);
    }
  }

  // Returns a lower limit of the error of each degree, as far as a look at all degrees gives one.
  std::vector<double> least_errors(const Coefficients& coefficients) {
    if (!is_distance()) return largest_partial_errors(error_.witnesses(), coefficients, context_);
    std::vector<double> least;
    double part = 1 / kTooFar;
    if (is_largest()) {
      least = largest_partial_distances(error_.witnesses(), coefficients, context_);
    } else {
      const int degree = coefficients.degree();
      least = rms_tails(coefficients, energy_of(rms_beyond()));
      const double tail = least.back();
      const double distance = error_.of(expansion(), degree, result_.allowed);
      part = tail > 0 ? distance / (tail * kProportional) : 0;
    }
    for (double& error : least) error *= part;
    return least;
  }

  bool is_too_far(const Expansion& all, int degree) {
    return error_.of(all, degree, result_.allowed) > kScreened * result_.allowed;
  }

  // Returns the amount that errors of coefficients may add to errors at points.
  double uncertainty() const {
    return kUncertainty * precisions_.final *
           std::sqrt(problem_.norm_squared / (4 * std::numbers::pi));
  }

  // Takes the first degrees of final coefficients. If these may be good enough, computes
  // coefficients of just that degree, the same as without a tolerance. Then the answer does not
  // depend on the number of further degrees.
  void measure_first(int degree, const Transform& all, ErrorPoints& worst) {
    result_.transform = all;
    const bool cut = degree < highest();
    if (cut) expansion().coefficients = expansion().coefficients.resized(degree);
    measure(&worst);
    if (!cut || result_.reached > result_.allowed + uncertainty()) return;
    take(problem_.transform({degree, precisions_.final}));
    measure(&worst);
  }

  void cut_by_parseval(Coefficients& coefficients) {
    CompensatedSum rest;
    rest.add(problem_.norm_squared);
    for (const double value : coefficients.values()) rest.add(-value * value);
    const std::vector<double> tails = rms_tails(coefficients, std::max(0.0, rest.value()));
    const int degree = smallest_degree(tails, result_.allowed);
    result_.reached = tails[static_cast<std::size_t>(degree)];
    if (degree < coefficients.degree()) coefficients = coefficients.resized(degree);
  }

  const ToleranceProblem& problem_;
  const Tolerance& tolerance_;
  Precisions precisions_;
  const Context& context_;
  ErrorSites sites_;
  ErrorOfDegree error_;
  ToleranceTransform result_;
};

}  // namespace

ToleranceTransform search_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance,
                                    const Transform& pilot, const Context& context) {
  return Search(problem, tolerance, context).run(pilot);
}

ToleranceTransform expand_by(MethodFunction method, const StarChart& chart,
                             const Tolerance& tolerance, const TransformOptions& options,
                             const Context& context) {
  check(tolerance);
  check(options);
  if (function_of(options.method) != RadialFunction::kRadius) {
    throw Error(ErrorCode::kInvalidInput,
                "a tolerance is one of the radius: the method gauge expands its inverse");
  }
  require_one_sheet(chart.report);
  const MeshView mesh = view_of(chart.mesh);
  ToleranceProblem problem =
      tolerance_problem(mesh, {}, exact_norms(mesh, {}, context), options.precision, context);
  const auto expanded = [&](TransformOptions wanted, const TransformTarget& target) {
    wanted.degree = target.degree;
    wanted.precision = target.precision;
    return expand_without_norms(method, chart, wanted, context);
  };
  // Pilots use the fast sums for every method: the coefficients are the same.
  problem.pilot = [&](const TransformTarget& target) {
    const MeshPassOptions wanted{.degree = target.degree, .precision = target.precision};
    return transform_of(mesh_pass(mesh, wanted, context), target.precision);
  };
  problem.transform = [&](const TransformTarget& target) { return expanded(options, target); };
  const Transform pilot = problem.pilot(first_pilot(problem, tolerance));
  ToleranceTransform result = search_tolerance(problem, tolerance, pilot, context);
  result.transform.expansion.tail_strength = tail_strength(chart, RadialFunction::kRadius);
  finish_transform(options, chart.report.center, result.transform);
  return result;
}

}  // namespace rholm
