#include <cmath>

#include "reconstruct/file/atlas_read.h"
#include "rholm/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const rholm::AtlasModel model =
        rholm::parse_atlas({reinterpret_cast<const char*>(data), size}, "fuzz");
    for (const rholm::Cap& cap : model.atlas.caps) {
      for (const double c : model.atlas.coefficients_of(cap)) {
        if (!std::isfinite(c)) __builtin_trap();
      }
    }
    if (model.rules) {
      const rholm::SurfaceRules& rules = *model.rules;
      if (rules.spacings.size() != rules.spacing_places.size()) __builtin_trap();
      if (rules.seen) {
        const auto& size = rules.seen->size;
        if (8 * rules.seen->bits.size() < size[0] * size[1] * size[2]) __builtin_trap();
      }
    }
  } catch (const rholm::Error& refused) {
    if (refused.what()[0] == '\0') __builtin_trap();  // the error must have a message
  }
  return 0;
}
