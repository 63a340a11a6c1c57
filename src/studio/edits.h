// What requests and steps of a recipe ask of reconstruction, smoothing and transfer. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rholm/reconstruct.h"
#include "rholm/smooth.h"
#include "rholm/transfer.h"
#include "studio/items/fields.h"

namespace rholm::studio {

// `noise` is auto or none, `simplify` a share. `holes` may be close for fill.
// Throws Refusal 400.
ReconstructOptions reconstruct_in(const Json& request);

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
