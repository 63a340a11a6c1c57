// All methods behind one signature.
#include "rholm/analyze.h"

#include "paper/methods/paper_methods.h"
#include "rholm/error.h"
#include "rholm/truncation.h"
#include "transform/analyze.h"
#include "transform/methods/methods.h"
#include "transform/tolerance/search.h"

namespace rholm {
namespace {

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
