#include "studio/edits.h"

#include <numbers>

#include "studio/controls.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

ReconstructOptions reconstruct_in(const Json& request) {
  ReconstructOptions options;
  Json fields = request;
  if (string_or(request, "holes", "") == "close") fields["holes"] = to_string(HolePolicy::kFill);
  take_fields(fields, options);
  const std::string noise = string_or(request, "noise", "auto");
  if (noise != "auto" && noise != "none") throw bad_request("'noise' must be auto or none");
  if (noise == "none") options.noise = 0;
  if (const std::optional<double> share = maybe_number(request, "simplify")) {
    if (!(*share > 0 && *share <= 1))
      throw bad_request("'simplify' is a share, above 0, at most 1");
    options.simplify = SimplifyOptions{.share = *share};
  }
  return options;
}

SmoothWish smooth_in(const Json& request) {
  SmoothWish wish;
  wish.regions = regions_in(request, "regions");
  parsed(wish.regions);
  number_of(request, "wavelength");  // throws if missing: there is no default
  take_fields(request, wish.options);
  wish.strength = number_or(request, "strength", 1);
  if (wish.options.repair && wish.options.fitting == PatchFitting::kMean) {
    throw bad_request("'repair' needs a fitting that knows what stands out, not mean");
  }
  return wish;
}

TransferWish transfer_in(const Json& request) {
  TransferWish wish;
  wish.from = strings_of(request, "from");
  wish.to = strings_of(request, "to");
  if (wish.from.empty() || wish.to.empty()) {
    throw bad_request("'from' and 'to' need a region each, as \"vertex:INDEX,RADIUS\"");
  }
  parsed(wish.from);
  parsed(wish.to);
  take_fields(request, wish.options);
  take_fields(request, wish.update);
  wish.degrees = maybe_number(request, "angle");
  if (wish.degrees) wish.update.angle = *wish.degrees * kDegree;
  return wish;
}

}  // namespace rholm::studio
