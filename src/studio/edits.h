// What requests ask of smoothing and of transfer, live or as a step. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rholm/smooth.h"
#include "rholm/transfer.h"
#include "studio/items/fields.h"

namespace rholm::studio {

struct SmoothWish {
  std::vector<std::string> regions;
  PatchOptions options;
  double strength = 1;
};
// Throws Refusal 400.
SmoothWish smooth_in(const Json& request);

struct TransferWish {
  std::vector<std::string> from, to;
  TransferOptions options;
  TransferUpdate update;
  std::optional<double> degrees;  // the angle as it was asked for
};
TransferWish transfer_in(const Json& request);

}  // namespace rholm::studio
