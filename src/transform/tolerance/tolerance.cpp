#include "transform/tolerance/tolerance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/error.h"
#include "shape/vertex_range.h"
#include "transform/norms/exact_norms.h"

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

void require_one_sheet(const StarReport& star) {
  if (star.star_shaped) return;
  throw Error(ErrorCode::kInvalidInput,
              "a tolerance needs a surface that every direction meets once: give a degree");
}

int first_degree(std::size_t n_faces, const Tolerance& tolerance) {
  // The edges' angle times this degree is about 0.6: most faces are lumped (performance.md). It is
  // within 12 and 96 (chosen: lower degrees are no cheaper, higher ones seldom needed).
  const double degree = 0.15 * std::sqrt(static_cast<double>(n_faces));
  return std::min(static_cast<int>(std::clamp(degree, 12.0, 96.0)), tolerance.max_degree);
}

ToleranceProblem tolerance_problem(const MeshView& mesh, const Vec3& center,
                                   const ExactNorms& norms, double precision,
                                   const Context& context) {
  return {.mesh = mesh,
          .center = center,
          .norm_squared = norms.radius_squared,
          .diagonal = diagonal_of(mesh, context),
          .precision = precision,
          .pilot = {},
          .transform = {}};
}

double absolute_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance,
                          double mean) {
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
  const double relative = absolute_tolerance(problem, tolerance, size) / size;
  // Parseval's difference of squares must be right to a few parts in a thousand.
  const bool parseval =
      tolerance.norm == ErrorNorm::kRms && tolerance.measure == ErrorMeasure::kRadius;
  const double needed = parseval ? 1e-3 * relative * relative : 1e-3 * relative;
  const double final = std::min(problem.precision, std::clamp(needed, 1e-13, 1e-2));
  // At single points, errors of coefficients add up to more than their root mean square (measured).
  const double coarse = (tolerance.norm == ErrorNorm::kMax ? 0.02 : 0.1) * relative;
  return {.pilot = std::max(final, std::clamp(coarse, 1e-7, 1e-3)), .final = final};
}

TransformTarget first_pilot(const ToleranceProblem& problem, const Tolerance& tolerance) {
  return {.degree = first_degree(problem.mesh.n_faces, tolerance),
          .precision = precisions_for(problem, tolerance).pilot};
}

EnumNames names_of(ErrorNorm) {
  static constexpr const char* kNames[] = {"rms", "max"};
  return {"norm of errors", kNames};
}

EnumNames names_of(ErrorMeasure) {
  static constexpr const char* kNames[] = {"radius", "distance"};
  return {"measure of errors", kNames};
}

EnumNames names_of(ToleranceUnit) {
  static constexpr const char* kNames[] = {"absolute", "diagonal", "radius"};
  return {"unit of a tolerance", kNames};
}

}  // namespace rholm
