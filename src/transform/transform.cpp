#include "transform/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/rounding.h"
#include "base/stopwatch.h"
#include "rholm/error.h"
#include "transform/geometry/star_geometry.h"
#include "transform/mesh_pass/verify.h"
#include "transform/methods/methods.h"
#include "transform/norms/parseval.h"

namespace rholm {

RadialFunction function_of(Method method) {
  return method == Method::kGauge ? RadialFunction::kGauge : RadialFunction::kRadius;
}

namespace {

MethodOptions method_options(const StarGeometry& geometry, const TransformOptions& options) {
  const MeanAndNorm scale = mean_and_norm(geometry, function_of(options.method));
  const double c00 = std::abs(scale.mean) * std::sqrt(4 * std::numbers::pi);
  // An error below the rounding of c_00 cannot be reached, however exact the sum is.
  constexpr double kRounding = rounding_of_sum(0);
  if (!std::isfinite(scale.norm) || !(c00 > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                "no direction sees the surface from the centre: its faces have no area");
  }
  return {.degree = options.degree,
          .engine = options.engine,
          .allowed = std::max(options.precision * scale.norm, kRounding * c00),
          .mean_allowed = std::max(options.precision, kRounding) * c00};
}

void check_finite(const Coefficients& c) {
  for (const double value : c.values()) {
    if (!std::isfinite(value)) {
      throw Error(ErrorCode::kInvalidInput,
                  "the coefficients are not finite numbers: the surface comes too near to the "
                  "centre");
    }
  }
}

// The relative error of c_00 is the precision: a separate cubature sums each face to that
// precision.
void set_truncation_rms(double norm_squared, Transform& transform) {
  const Coefficients& c = transform.expansion.coefficients;
  const CoefficientErrors errors =
      coefficient_errors(norm_squared, c, transform.precision, known_error(transform));
  const ParsevalRest rest = parseval_rest(norm_squared, c, errors);
  transform.truncation_rms = rms_of(rest, kBelieved);
  if (transform.truncation_rms) transform.truncation_rms_uncertainty = rms_uncertainty(rest);
}

}  // namespace

EnumNames names_of(Method) {
  static constexpr const char* kNames[] = {"edge", "gauge", "curl", "area"};
  return {"method", kNames};
}

namespace {

// Computes coefficients by one of the methods: direct sums, or the gauge's fast sums.
void by_method(MethodFunction method, const StarChart& chart, const TransformOptions& options,
               const Context& context, Transform& transform) {
  const StarGeometry geometry = star_geometry(chart);
  MethodResult sums = method(geometry, method_options(geometry, options), context);
  const bool gauge = options.method == Method::kGauge;
  const double unscale = gauge ? geometry.scale : 1 / geometry.scale;
  for (double& value : sums.coefficients.values()) value *= unscale;
  transform.edge_nodes = sums.edge_nodes;
  transform.face_nodes = sums.face_nodes;
  transform.closure_residual = closure_residual(geometry);
  transform.expansion.coefficients = std::move(sums.coefficients);
}

void by_mesh_pass(const StarChart& chart, const TransformOptions& options, const Context& context,
                  Transform& transform) {
  const MeshView mesh = view_of(chart.mesh);
  const MeshPassOptions wanted{.degree = options.degree, .precision = options.precision};
  MeshPassResult pass = mesh_pass(mesh, wanted, context);
  verify_pass(mesh, wanted, context, pass);
  set_pass(pass, transform);
}

}  // namespace

void check(const TransformOptions& options) {
  if (options.degree < 0 || options.degree > kMaxDegree) {
    throw Error(ErrorCode::kInvalidInput, "the degree must be between 0 and " +
                                              std::to_string(kMaxDegree) + ", not " +
                                              std::to_string(options.degree));
  }
  if (!(options.precision >= 1e-14 && options.precision <= 0.1)) {
    throw Error(ErrorCode::kInvalidInput, "the precision must be between 1e-14 and 0.1, not " +
                                              std::to_string(options.precision));
  }
}

bool uses_mesh_pass(const TransformOptions& options) {
  return options.engine == Engine::kFast && options.method == Method::kEdge;
}

void set_pass(MeshPassResult& pass, Transform& transform) {
  transform.fast = pass.report;
  transform.times.insert(pass.times.begin(), pass.times.end());
  transform.expansion.coefficients = std::move(pass.coefficients);
}

Transform transform_of(MeshPassResult pass, double precision) {
  Transform transform;
  set_pass(pass, transform);
  transform.precision = precision;
  return transform;
}

double known_error(const Transform& transform) {
  if (!transform.fast) return transform.precision;
  // The error of the fast engine is relative to the degrees found, which may hold next to nothing.
  const Coefficients& c = transform.expansion.coefficients;
  const double mean = c.c(0, 0);
  const double varying = transform.expansion.norm_squared.value_or(0) - mean * mean;
  if (!(varying > 0)) return transform.fast->error;
  double found = 0;
  for (const double value : c.values().subspan(1)) found += value * value;
  return transform.fast->error * std::sqrt(std::min(1.0, found / varying));
}

void finish_transform(const TransformOptions& options, const Vec3& center, Transform& transform) {
  Expansion& expansion = transform.expansion;
  check_finite(expansion.coefficients);
  expansion.function = function_of(options.method);
  expansion.center = center;
  expansion.method = to_string(options.method);
  const bool reached = !transform.fast || transform.fast->reached;
  expansion.precision =
      reached ? transform.precision : std::max(transform.precision, known_error(transform));
  if (expansion.norm_squared) {
    set_truncation_rms(*expansion.norm_squared, transform);
  }
}

Transform expand_without_norms(MethodFunction method, const StarChart& chart,
                               const TransformOptions& options, const Context& context) {
  report_progress(context, "transform", 0);
  Transform transform;
  transform.precision = options.precision;
  if (uses_mesh_pass(options)) {
    by_mesh_pass(chart, options, context, transform);
  } else {
    by_method(method, chart, options, context, transform);
  }
  return transform;
}

Transform expand_by(MethodFunction method, const StarChart& chart, const TransformOptions& options,
                    const Context& context) {
  check(options);
  Transform transform = expand_without_norms(method, chart, options, context);
  transform.expansion.signed_sum = !chart.report.star_shaped;
  if (chart.report.star_shaped) {
    const StageTimer timer(transform.times, "norms");
    const bool gauge = options.method == Method::kGauge;
    transform.expansion.norm_squared =
        gauge ? gauge_norm_squared(chart) : radius_norm_squared(chart);
    transform.expansion.tail_strength = tail_strength(chart, function_of(options.method));
  }
  finish_transform(options, chart.report.center, transform);
  return transform;
}

}  // namespace rholm
