#include "rholm/analyze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "transform/methods.h"
#include "transform/star_geometry.h"

namespace rholm {
namespace {

void check_options(const AnalyzeOptions& options) {
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

RadialFunction function_of(Method method) {
  return method == Method::kGauge ? RadialFunction::kGauge : RadialFunction::kRadius;
}

MethodOptions method_options(const StarGeometry& geometry, const AnalyzeOptions& options) {
  const MeanAndNorm scale = mean_and_norm(geometry, function_of(options.method));
  const double c00 = std::abs(scale.mean) * std::sqrt(4 * std::numbers::pi);
  // Below the rounding of c_00 there is nothing to gain.
  constexpr double kRounding = 1e-16;
  if (!std::isfinite(scale.norm) || !(c00 > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                "no direction sees the surface from the centre: its faces have no area");
  }
  return {.degree = options.degree,
          .error = std::max(options.precision * scale.norm, kRounding * c00),
          .mean_error = std::max(options.precision, kRounding) * c00};
}

MethodResult run(const StarGeometry& geometry, Method method, const MethodOptions& options,
                 const Context& context) {
  switch (method) {
    case Method::kEdge:
      return edge_method(geometry, options, context);
    case Method::kGauge:
      return gauge_method(geometry, options, context);
    case Method::kCurl:
      return curl_method(geometry, options, context);
    case Method::kArea:
      return area_method(geometry, options, context);
  }
  throw Error(ErrorCode::kInvalidInput, "unknown method");
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

std::optional<double> truncation_rms(double norm_squared, const Coefficients& c) {
  CompensatedSum rest;
  rest.add(norm_squared);
  for (const double value : c.values()) rest.add(-value * value);
  return std::sqrt(std::max(0.0, rest.value()) / (4 * std::numbers::pi));
}

}  // namespace

const char* to_string(Method method) {
  switch (method) {
    case Method::kEdge:
      return "edge";
    case Method::kGauge:
      return "gauge";
    case Method::kCurl:
      return "curl";
    case Method::kArea:
      return "area";
  }
  return "unknown";
}

Method parse_method(const std::string& name) {
  for (const Method method : {Method::kEdge, Method::kGauge, Method::kCurl, Method::kArea}) {
    if (name == to_string(method)) return method;
  }
  throw Error(ErrorCode::kInvalidInput, "unknown method '" + name + "': edge, gauge, curl or area");
}

Analysis analyze(const StarChart& chart, const AnalyzeOptions& options, const Context& context) {
  check_options(options);
  report_progress(context, "transform", 0);
  const StarGeometry geometry = star_geometry(chart);
  const RadialFunction function = function_of(options.method);
  MethodResult sums = run(geometry, options.method, method_options(geometry, options), context);
  const double unscale = function == RadialFunction::kGauge ? geometry.scale : 1 / geometry.scale;
  for (double& value : sums.coefficients.values()) value *= unscale;
  check_finite(sums.coefficients);

  Analysis analysis;
  analysis.edge_nodes = sums.edge_nodes;
  analysis.face_nodes = sums.face_nodes;
  analysis.closure_residual = closure_residual(geometry);
  Expansion& expansion = analysis.expansion;
  expansion.coefficients = std::move(sums.coefficients);
  expansion.function = function;
  expansion.center = chart.report.center;
  expansion.method = to_string(options.method);
  if (chart.report.star_shaped) {
    expansion.norm_squared =
        function == RadialFunction::kGauge ? gauge_norm_squared(chart) : radius_norm_squared(chart);
    expansion.tail_strength = tail_strength(chart, function);
    analysis.truncation_rms = truncation_rms(*expansion.norm_squared, expansion.coefficients);
  }
  return analysis;
}

}  // namespace rholm
