#include "transform/tolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/error.h"

namespace rholm {
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

Precisions precisions_for(const ToleranceProblem& problem, const Tolerance& tolerance) {
  const double size = std::sqrt(problem.norm_squared / (4 * std::numbers::pi));
  const double relative = absolute_error(problem, tolerance, size) / size;
  // Parseval's difference of squares must hold a few parts in a thousand.
  const bool parseval =
      tolerance.norm == ErrorNorm::kRms && tolerance.measure == ErrorMeasure::kRadius;
  const double needed = parseval ? 1e-3 * relative * relative : 1e-3 * relative;
  const double final = std::min(problem.precision, std::clamp(needed, 1e-13, 1e-2));
  // At single points errors of coefficients add up to more than their root mean square (measured).
  const double coarse = (tolerance.norm == ErrorNorm::kMax ? 0.02 : 0.1) * relative;
  return {.pilot = std::max(final, std::clamp(coarse, 1e-7, 1e-3)), .final = final};
}

double known_error(const Analysis& analysis) {
  if (!analysis.fast) return analysis.precision;
  // The fast engine's is relative to the degrees found, which may hold next to nothing.
  const Coefficients& c = analysis.expansion.coefficients;
  const double mean = c.c(0, 0);
  const double varying = analysis.expansion.norm_squared.value_or(0) - mean * mean;
  if (!(varying > 0)) return analysis.fast->error;
  double found = 0;
  for (const double value : c.values().subspan(1)) found += value * value;
  return analysis.fast->error * std::sqrt(std::min(1.0, found / varying));
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
