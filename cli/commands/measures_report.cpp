#include "cli/commands/measures_report.h"

#include "rholm/descriptors.h"
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
  for (const Descriptor& one : descriptors()) json[one.name] = json_of(one.value(known));
  json["volume_centroid"] = known.centroid ? json_of(*known.centroid) : Json(nullptr);
  return json;
}

std::string descriptor_names() {
  const std::span<const Descriptor> all = descriptors();
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const char* joint = i == 0 ? "" : i + 1 == all.size() ? " and " : ", ";
    text += joint + std::string(all[i].name);
  }
  return text;
}

}  // namespace rholm::cli
