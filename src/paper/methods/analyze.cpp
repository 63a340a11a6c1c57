// All methods behind one signature.
#include "rholm/analyze.h"

#include "paper/methods/paper_methods.h"
#include "rholm/error.h"
#include "rholm/truncation.h"
#include "transform/analyze.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"
#include "transform/methods/sources.h"
#include "transform/tolerance/search.h"

namespace rholm {
namespace {

// Cubature of r conj(Y) dOmega over the flat faces, with r dOmega = d_T dS / |x|^2.
MethodResult area_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context) {
  Sources sources({.degree = options.degree}, context);
  const Allowance allowance =
      undivided_allowance(options.allowed, radius_weight(geometry), options.degree);
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    sources.set_progress(static_cast<double>(t) / static_cast<double>(geometry.faces.size()));
    visit_radius(geometry, t, allowance, [&](const Vec3& x, double w) { sources.add(x, w); });
  }
  MethodResult result;
  result.coefficients = sources.finish();
  result.face_nodes = sources.count();
  result.coefficients.c(0, 0) = radius_mean_coefficient(geometry, options.mean_allowed);
  return result;
}

MethodFunction sums_of(Method method) {
  switch (method) {
    case Method::kEdge:
      return edge_method;
    case Method::kGauge:
      return gauge_method;
    case Method::kCurl:
      return curl_method;
    case Method::kArea:
      return area_method;
  }
  throw Error(ErrorCode::kInvalidInput, "unknown method");
}

}  // namespace

Analysis analyze(const StarChart& chart, const AnalyzeOptions& options, const Context& context) {
  return analyze_by(sums_of(options.method), chart, options, context);
}

ToleranceAnalysis analyze(const StarChart& chart, const Tolerance& tolerance,
                          const AnalyzeOptions& options, const Context& context) {
  return analyze_by(sums_of(options.method), chart, tolerance, options, context);
}

}  // namespace rholm
