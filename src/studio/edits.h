// Options of reconstruction, smoothing and transfer in requests and steps. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rholm/reconstruct.h"
#include "rholm/smooth.h"
#include "rholm/transfer.h"
#include "studio/items/fields.h"

namespace rholm::studio {

// `noise` is auto or none, `simplify` a share. `holes`
// may be close instead of fill. Throws Refusal 400.
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
  std::optional<double> degrees;  // the requested angle
};
TransferWish transfer_in(const Json& request);

}  // namespace rholm::studio
