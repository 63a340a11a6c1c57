#include "cli/commands/measures_report.h"

#include "rholm/error.h"

namespace rholm::cli {
namespace {

// Chosen: measuring takes O(L^3), a second at this degree.
constexpr int kMaxMeasuredDegree = 512;

}  // namespace

MeasuresReport measures_of(const Expansion& expansion, const Context& context) {
  MeasuresReport report;
  if (expansion.coefficients.degree() > kMaxMeasuredDegree) return report;
  if (expansion.function == RadialFunction::kOther) return report;
  try {
    report.measures = measure(expansion, context);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    report.why_not = error.what();
  }
  return report;
}

Json measures_json(const std::optional<SurfaceMeasures>& measures) {
  Json json;
  const SurfaceMeasures known = measures.value_or(SurfaceMeasures{});
  json["volume"] = json_of(known.volume);
  json["area"] = json_of(known.area);
  json["sphericity"] = json_of(known.sphericity());
  json["volume_centroid"] = known.centroid ? json_of(*known.centroid) : Json(nullptr);
  return json;
}

}  // namespace rholm::cli
