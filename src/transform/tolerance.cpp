#include "transform/tolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "rholm/error.h"
#include "transform/error_of_degree.h"

namespace rholm {
namespace {

// A pilot goes beyond the degree it expects: another one costs as much as this.
constexpr double kBeyond = 1.3;
// The next try of one that was meant to be the last.
constexpr double kBeyondFinal = 1.06;
// What vertices predict is 16 % too small at worst (measured).
constexpr double kBeyondVertices = 1.18;
// The largest error does not fall evenly.
constexpr double kLeastStep = 1.25;
// Legendre sums of some 0.3 L^3 ns take as long as a pass of 150 ns a triangle.
constexpr double kCheap = 500, kBeyondCheap = 1.6;
// Errors that fall no faster are those at vertices.
constexpr double kSlow = 1.1;

// The largest error at vertices times L + 1, as the mesh predicts it; 0 where it says nothing.
double error_at_vertices(const ToleranceProblem& problem, const Tolerance& tolerance) {
  if (tolerance.norm != ErrorNorm::kMax || problem.mesh.n_triangles > kMostPredicted) return 0;
  const ErrorStrengths strengths = vertex_error_strengths(problem.mesh, problem.center);
  const bool distance = tolerance.measure == ErrorMeasure::kDistance;
  return (distance ? strengths.distance : strengths.radius) / (2 * std::numbers::pi);
}

struct Known {
  int degree;
  double value;
};

// The power of 1 / (L + 1) that the error falls like.
double decay(const Known& from, const Known& to) {
  return std::log(from.value / to.value) / std::log((to.degree + 1.0) / (from.degree + 1.0));
}

// Where the decay of the error from one degree to another reaches the tolerance.
int next_degree(const Known& from, const Known& to, double beyond, const Tolerance& tolerance) {
  const double slope = std::clamp(decay(from, to), 0.4, 6.0);
  const double guess = beyond * to.degree * std::pow(to.value / tolerance.error, 1 / slope);
  const double next = std::clamp(guess, (1 + beyond) / 2 * to.degree + 2, 5.0 * to.degree + 8);
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

namespace {

// One search: coefficients of higher and higher degrees, until the error of what there is lies
// within the tolerance, and no higher than needed.
class Search {
 public:
  Search(const ToleranceProblem& problem, const Tolerance& wanted, const Context& context)
      : problem_(problem),
        wanted_(wanted),
        tolerance_(wanted),
        precisions_(precisions_for(problem, wanted)),
        at_vertices_(error_at_vertices(problem, wanted)),
        context_(context) {}

  ToleranceAnalysis run(const Analysis& pilot) {
    take(pilot, false);
    int estimate = estimate_by_pilots();
    // Some more than they say, so that another try is rare.
    if (!final_) {
      transform(std::max(1.03 * estimate + 2, std::min<double>(degree(), cheap_degree())), true);
    }
    for (;;) {
      if (const std::optional<DegreeBracket> found = error().confirm(estimate)) {
        Coefficients& coefficients = result_.analysis.expansion.coefficients;
        result_.met = true;
        result_.reached = found->good_value;
        coefficients = coefficients.resized(found->good);
        return std::move(result_);
      }
      estimate = degree();
      result_.reached = error().reached();
      if (estimate == tolerance_.max_degree) return std::move(result_);
      const Known half{estimate / 2, error().of(estimate / 2)};
      transform(next_degree(half, {estimate, result_.reached}, kBeyondFinal, tolerance_), true);
    }
  }

 private:
  int degree() const { return result_.analysis.expansion.coefficients.degree(); }
  // Of what there is.
  const ErrorOfDegree& error() {
    if (!error_) {
      error_.emplace(problem_, tolerance_, result_.analysis.expansion, final_, at_vertices_,
                     context_);
    }
    return *error_;
  }

  void take(Analysis analysis, bool final) {
    final_ = final;
    error_.reset();
    result_.analysis = std::move(analysis);
    Expansion& expansion = result_.analysis.expansion;
    result_.degrees.push_back(expansion.coefficients.degree());
    expansion.norm_squared = problem_.norm_squared;
    const double mean = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
    tolerance_.error = result_.allowed = absolute_error(problem_, wanted_, mean);
  }
  void transform(double degree, bool final) {
    const auto whole = static_cast<int>(std::min<double>(degree, tolerance_.max_degree));
    take(problem_.transform(whole, final ? precisions_.final : precisions_.pilot), final);
  }

  // Coefficients and points good enough to say which degree it will be; for the largest error final
  // ones that are within the tolerance.
  int estimate_by_pilots() {
    for (std::optional<Known> before;;) {
      const Known now{degree(), error().of(degree())};
      if (!before) before = Known{degree() / 2, error().of(degree() / 2)};
      if (now.value <= tolerance_.error) {
        if (final_) return now.degree;
        const bool fails = before->value > tolerance_.error;
        return error().estimate({.bad = fails ? before->degree : -1,
                                 .good = now.degree,
                                 .bad_value = before->value,
                                 .good_value = now.value});
      }
      if (now.degree == tolerance_.max_degree) return now.degree;
      if (wanted_.norm == ErrorNorm::kMax) {
        transform(next_by_vertices(*before, now), true);
      } else {
        transform(next_degree(*before, now, kBeyond, tolerance_), false);
      }
      before = now;
    }
  }

  // Where the pass over the faces takes longer than what grows with the degree, higher ones cost
  // little.
  double cheap_degree() const {
    return std::cbrt(kCheap * static_cast<double>(problem_.mesh.n_triangles));
  }

  // Of the largest error: what vertices ask for where that is less than what the decay does, for on
  // fine meshes they say too much.
  double next_by_vertices(const Known& before, const Known& now) {
    double next = next_degree(before, now, kBeyond, tolerance_);
    if (decay(before, now) < kSlow) {
      at_vertices_ = std::max(at_vertices_, now.value * (now.degree + 1));
    }
    const double by_vertices = kBeyondVertices * at_vertices_ / tolerance_.error;
    if (by_vertices > now.degree && by_vertices <= next) {
      next = std::max(by_vertices, kLeastStep * now.degree);
    }
    return std::max(next, std::min(cheap_degree(), kBeyondCheap * next));
  }

  const ToleranceProblem& problem_;
  const Tolerance& wanted_;
  Tolerance tolerance_;
  Precisions precisions_;
  double at_vertices_;
  const Context& context_;
  ToleranceAnalysis result_;
  bool final_ = false;  // how exact the coefficients are
  std::optional<ErrorOfDegree> error_;
};

}  // namespace

ToleranceAnalysis search_tolerance(const ToleranceProblem& problem, const Tolerance& wanted,
                                   const Analysis& pilot, const Context& context) {
  return Search(problem, wanted, context).run(pilot);
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
