#include "studio/edits.h"

#include <numbers>

#include "rholm/error.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

SmoothWish smooth_in(const Json& request) {
  SmoothWish wish;
  wish.regions = regions_in(request, "regions");
  parsed(wish.regions);
  wish.options.wavelength = number_of(request, "wavelength");
  wish.options.repair = flag_of(request, "repair");
  wish.strength = number_or(request, "strength", 1);
  try {
    wish.options.fitting = parse_name<PatchFitting>(string_or(request, "fitting", "robust"));
  } catch (const Error& error) {
    throw bad_request(error.what());
  }
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
  wish.options.from_degree = integer_or(request, "from_degree", wish.options.from_degree);
  wish.options.scale = number_or(request, "scale", 1);
  wish.options.refine = flag_of(request, "refine");
  wish.update.height = number_or(request, "height", 1);
  wish.degrees = maybe_number(request, "angle");
  if (wish.degrees) wish.update.angle = *wish.degrees * kDegree;
  wish.update.repeat = flag_of(request, "repeat");
  wish.update.remove_own = flag_of(request, "remove_own");
  return wish;
}

}  // namespace rholm::studio
