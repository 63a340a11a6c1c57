// The search for the degree that keeps a tolerance: coarse coefficients, cheap beside those in full
// precision, say which degree it is; then it is analysed as any other. The error of a degree is the
// same in all coefficients that have it, so what is known outlives each set of them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "transform/analyze.h"
#include "transform/error/error_of_degree.h"
#include "transform/error/error_sites.h"
#include "transform/tolerance/degree_bracket.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {
namespace {

// Coefficients are computed this far beyond the degree that is to be looked at, where that was
// reached from half of it, for others cost as much; less where it was nearer. Where edges show,
// this far beyond where 1 / (L + 1) would have it.
constexpr double kBeyond = 0.25, kBeyondVertices = 0.15;
// Of Parseval's tails, which are known at every degree at once.
constexpr double kBeyondSpectral = 1.3;
// Tails of final coefficients are exact: a few degrees more than expected are cut off again.
constexpr double kFinalSpectral = 1.015;
// An error that is so little too large says how far to go, wherever it came from.
constexpr double kNear = 1.5;
// And one that is so much lower says little.
constexpr double kFar = 1.5;
// Errors do not fall evenly.
constexpr double kLeastStep = 1.03;
// So much farther than what is known no guess is followed.
constexpr double kFarthest = 12;
// Legendre sums of some 0.3 L^3 ns take as long as a pass of 150 ns a triangle.
constexpr double kCheap = 500, kBeyondCheap = 1.6;
// Coarse coefficients: that the error of the final ones is above the tolerance after all must be
// rare. A degree whose error is not below kEnough of it is hardly too high.
constexpr double kMargin = 0.997, kAim = 0.975, kEnough = 0.95;
// Lower degrees cost so little to look at that they may be the smallest to a step.
constexpr int kLow = 128;
constexpr double kEnoughLow = 0.985;
// Powers of 1 / (L + 1) that are believed of an error: the least, the largest, and that of one
// about which nothing is known (chosen).
constexpr double kLeastDecay = 0.7, kMostDecay = 6, kUsualDecay = 2;

struct Known {
  int degree;
  double value;
};

// The power of 1 / (L + 1) that the error falls like.
double decay(const Known& from, const Known& to) {
  return std::log(from.value / to.value) / std::log((to.degree + 1.0) / (from.degree + 1.0));
}

// Where the decay of the error from one degree to another reaches the limit, if it is that power of
// 1 / (L + 1) at least.
double extrapolated(const Known& from, const Known& to, double least, double limit) {
  const double slope = std::clamp(decay(from, to), least, kMostDecay);
  const double guess = (to.degree + 1) * std::pow(to.value / limit, 1 / slope) - 1;
  return std::max(guess, to.degree + 1.0);
}

class Search {
 public:
  Search(const ToleranceProblem& problem, const Tolerance& wanted, const Context& context)
      : problem_(problem),
        wanted_(wanted),
        precisions_(precisions_for(problem, wanted)),
        context_(context),
        sites_(problem.mesh, problem.center),
        error_(wanted, sites_, std::sqrt(problem.norm_squared / (4 * std::numbers::pi)), context) {}

  ToleranceAnalysis run(const Analysis& first) {
    take(first);
    double degree = is_spectral() ? kFinalSpectral * spectral_degree() + 1 : measured_degree();
    for (;;) {
      finish(degree);
      result_.met = result_.reached <= result_.allowed;
      if (result_.met || highest() == wanted_.max_degree) return std::move(result_);
      // Coarse ones were a little too good.
      degree = std::ceil((highest() + 1) * result_.reached / result_.allowed);
    }
  }

 private:
  bool is_largest() const { return wanted_.norm == ErrorNorm::kMax; }
  bool is_distance() const { return wanted_.measure == ErrorMeasure::kDistance; }
  bool is_spectral() const { return !is_largest() && !is_distance(); }
  Expansion& expansion() { return result_.analysis.expansion; }
  // Degree of the coefficients there are.
  int highest() { return expansion().coefficients.degree(); }

  void take(Analysis analysis) {
    result_.analysis = std::move(analysis);
    result_.degrees.push_back(highest());
    expansion().center = problem_.center;
    expansion().norm_squared = problem_.norm_squared;
    const double mean = expansion().coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
    result_.allowed = absolute_error(problem_, wanted_, mean);
  }
  int within_most(double degree) const {
    return static_cast<int>(std::min<double>(degree, wanted_.max_degree));
  }
  void pilot(double degree) { take(problem_.pilot(within_most(degree), precisions_.pilot)); }

  // By energies: higher and higher degrees, until the tail beyond them is within the tolerance.
  int spectral_degree() {
    for (;;) {
      const double beyond = sampled_rms(expansion(), sites_, precisions_.pilot, context_);
      const std::vector<double> tails =
          rms_tails(expansion().coefficients, 4 * std::numbers::pi * beyond * beyond);
      const double limit = kMargin * result_.allowed;
      const int top = highest();
      if (beyond <= limit || top == wanted_.max_degree) return smallest_degree(tails, limit);
      const Known half{top / 2, tails[static_cast<std::size_t>(top / 2)]};
      const double next = kBeyondSpectral * extrapolated(half, {top, beyond}, kLeastDecay, limit);
      pilot(std::min(next, kFarthest * (top + 1)));
    }
  }

  // By errors at points: a bracket from outside, then from inside.
  int measured_degree() {
    for (int degree = highest(); !tried(degree);) {
      const double guess = std::min<double>(good_ ? inside() : beyond(), wanted_.max_degree);
      if (guess > highest()) reach(guess);
      degree = std::min(static_cast<int>(std::ceil(guess)), highest());
    }
    return good_ ? good_->degree : wanted_.max_degree;
  }

  // Coarse coefficients up to a degree and beyond it.
  void reach(double degree) {
    const double known = bad_->degree + 1;
    const double far = std::clamp(std::log2((degree + 1) / known), 0.2, 1.0);
    double beyond = kBeyond * far;
    if (is_at_vertices(bad_->degree)) {
      const double slowest = known * bad_->value / (kAim * result_.allowed);
      beyond = (1 + kBeyondVertices) * slowest / (degree + 1) - 1;
      beyond = std::clamp(beyond, kBeyondVertices, kBeyond);
    }
    const double ahead = (1 + beyond) * (degree + 1);
    const double next = std::min(ahead, kFarthest * known);
    pilot(std::max(next, std::min(cheap_degree(), kBeyondCheap * next)));
  }

  // Takes note of a degree; whether it is the one.
  bool tried(int degree) {
    const double limit = kMargin * result_.allowed;
    const Known now{degree, error_.of(expansion(), degree, limit)};
    if (now.value > limit) {
      before_ = bad_;
      bad_ = now;
      if (degree == wanted_.max_degree) return true;
    } else {
      good_ = now;
      const double enough = (degree > kLow ? kEnough : kEnoughLow) * result_.allowed;
      if (degree == 0 || now.value >= enough) return true;
    }
    bracket_.add(degree, now.value, limit);
    return good_ && bracket_.closed();
  }

  double inside() {
    const double aim = kAim * result_.allowed;
    const bool slow = is_at_vertices(good_->degree);
    const double power = slow ? 1 : kUsualDecay;
    const double guess = (good_->degree + 1) * std::pow(good_->value / aim, 1 / power) - 1;
    if (!bad_) return std::clamp<double>(guess, 0, good_->degree - 1);
    // What is far away says less than the law does.
    const bool far = good_->degree > kFar * bad_->degree && bracket_.same_side < 2;
    const bool inside = guess > bad_->degree + bracket_.step() && std::floor(guess) < good_->degree;
    return slow && far && inside ? std::floor(guess) : bracket_.guess(aim);
  }

  // All that were tried are bad: how the error falls from half the degree says where it will be
  // good.
  double beyond() {
    const double aim = kAim * result_.allowed;
    const bool near = bad_->value < kNear * aim;
    if (!before_ || (3 * before_->degree < bad_->degree && !near)) {
      const int half = bad_->degree / 2;
      before_ = Known{half, error_.of(expansion(), half, aim)};
    }
    const bool slow = is_at_vertices(bad_->degree);
    double guess = extrapolated(*before_, *bad_, slow ? 1 : kLeastDecay, aim);
    // Where edges begin to show it falls faster than it will.
    if (slow) guess = std::sqrt((guess + 1) * (bad_->degree + 1) * bad_->value / aim) - 1;
    return std::max(guess, kLeastStep * bad_->degree);
  }

  // Where the pass over the faces takes longer than what grows with the degree, higher ones cost
  // little.
  double cheap_degree() const {
    return std::cbrt(kCheap * static_cast<double>(problem_.mesh.n_triangles));
  }

  // Whether the largest error is one at vertices, that falls like 1 / (L + 1).
  bool is_at_vertices(int degree) const {
    return is_largest() && shows_its_edges(problem_.mesh, degree);
  }

  // Final coefficients, and their error as it is measured for any model.
  void finish(double degree) {
    take(problem_.transform(within_most(degree), precisions_.final));
    if (is_spectral()) {
      cut_by_parseval(expansion().coefficients);
      return;
    }
    const bool predict = problem_.mesh.n_triangles <= kMostPredicted;
    const double precision = known_error(result_.analysis);
    expansion().errors = truncation_errors(
        expansion(), {.precision = precision, .predict = predict}, sites_, context_);
    result_.reached = error_in(*expansion().errors, wanted_);
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
  const Tolerance& wanted_;
  Precisions precisions_;
  const Context& context_;
  ErrorSites sites_;
  ErrorOfDegree error_;
  ToleranceAnalysis result_;
  // The last degrees that are good and bad, and the bad one before.
  std::optional<Known> good_, bad_, before_;
  DegreeBracket bracket_;
};

}  // namespace

ToleranceAnalysis search_tolerance(const ToleranceProblem& problem, const Tolerance& wanted,
                                   const Analysis& pilot, const Context& context) {
  return Search(problem, wanted, context).run(pilot);
}

}  // namespace rholm
