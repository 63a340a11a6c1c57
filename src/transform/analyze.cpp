#include "transform/analyze.h"

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

MethodOptions method_options(const StarGeometry& geometry, const AnalyzeOptions& options) {
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
void set_truncation_rms(double norm_squared, Analysis& analysis) {
  const Coefficients& c = analysis.expansion.coefficients;
  const CoefficientErrors errors =
      coefficient_errors(norm_squared, c, analysis.precision, known_error(analysis));
  const ParsevalRest rest = parseval_rest(norm_squared, c, errors);
  analysis.truncation_rms = rms_of(rest, kBelieved);
  if (analysis.truncation_rms) analysis.truncation_rms_doubt = rms_doubt(rest);
}

}  // namespace

EnumNames names_of(Method) {
  static constexpr const char* kNames[] = {"edge", "gauge", "curl", "area"};
  return {"method", kNames};
}

namespace {

// Computes coefficients by one of the methods: direct sums, or the gauge's fast sums.
void by_method(MethodFunction method, const StarChart& chart, const AnalyzeOptions& options,
               const Context& context, Analysis& analysis) {
  const StarGeometry geometry = star_geometry(chart);
  MethodResult sums = method(geometry, method_options(geometry, options), context);
  const bool gauge = options.method == Method::kGauge;
  const double unscale = gauge ? geometry.scale : 1 / geometry.scale;
  for (double& value : sums.coefficients.values()) value *= unscale;
  analysis.edge_nodes = sums.edge_nodes;
  analysis.face_nodes = sums.face_nodes;
  analysis.closure_residual = closure_residual(geometry);
  analysis.expansion.coefficients = std::move(sums.coefficients);
}

void by_mesh_pass(const StarChart& chart, const AnalyzeOptions& options, const Context& context,
                  Analysis& analysis) {
  const MeshView mesh = view_of(chart.mesh);
  const MeshPassOptions wanted{.degree = options.degree, .precision = options.precision};
  MeshPassResult pass = mesh_pass(mesh, wanted, context);
  verify_pass(mesh, wanted, context, pass);
  set_pass(pass, analysis);
}

}  // namespace

void check(const AnalyzeOptions& options) {
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

bool uses_mesh_pass(const AnalyzeOptions& options) {
  return options.engine == Engine::kFast && options.method == Method::kEdge;
}

void set_pass(MeshPassResult& pass, Analysis& analysis) {
  analysis.fast = pass.report;
  analysis.times.insert(pass.times.begin(), pass.times.end());
  analysis.expansion.coefficients = std::move(pass.coefficients);
}

Analysis analysis_of(MeshPassResult pass, double precision) {
  Analysis analysis;
  set_pass(pass, analysis);
  analysis.precision = precision;
  return analysis;
}

double known_error(const Analysis& analysis) {
  if (!analysis.fast) return analysis.precision;
  // The error of the fast engine is relative to the degrees found, which may hold next to nothing.
  const Coefficients& c = analysis.expansion.coefficients;
  const double mean = c.c(0, 0);
  const double varying = analysis.expansion.norm_squared.value_or(0) - mean * mean;
  if (!(varying > 0)) return analysis.fast->error;
  double found = 0;
  for (const double value : c.values().subspan(1)) found += value * value;
  return analysis.fast->error * std::sqrt(std::min(1.0, found / varying));
}

void finish_analysis(const AnalyzeOptions& options, const Vec3& center, Analysis& analysis) {
  Expansion& expansion = analysis.expansion;
  check_finite(expansion.coefficients);
  expansion.function = function_of(options.method);
  expansion.center = center;
  expansion.method = to_string(options.method);
  const bool reached = !analysis.fast || analysis.fast->reached;
  expansion.precision =
      reached ? analysis.precision : std::max(analysis.precision, known_error(analysis));
  if (expansion.norm_squared) {
    set_truncation_rms(*expansion.norm_squared, analysis);
  }
}

Analysis analyze_without_norms(MethodFunction method, const StarChart& chart,
                               const AnalyzeOptions& options, const Context& context) {
  report_progress(context, "transform", 0);
  Analysis analysis;
  analysis.precision = options.precision;
  if (uses_mesh_pass(options)) {
    by_mesh_pass(chart, options, context, analysis);
  } else {
    by_method(method, chart, options, context, analysis);
  }
  return analysis;
}

Analysis analyze_by(MethodFunction method, const StarChart& chart, const AnalyzeOptions& options,
                    const Context& context) {
  check(options);
  Analysis analysis = analyze_without_norms(method, chart, options, context);
  analysis.expansion.signed_sum = !chart.report.star_shaped;
  if (chart.report.star_shaped) {
    const StageTimer timer(analysis.times, "norms");
    const bool gauge = options.method == Method::kGauge;
    analysis.expansion.norm_squared =
        gauge ? gauge_norm_squared(chart) : radius_norm_squared(chart);
    analysis.expansion.tail_strength = tail_strength(chart, function_of(options.method));
  }
  finish_analysis(options, chart.report.center, analysis);
  return analysis;
}

}  // namespace rholm
