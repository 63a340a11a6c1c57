// A picture. Layer: base.
#pragma once

#include <cstdint>
#include <vector>

namespace rholm {

// Pixels as a screen shows them (sRGB).
struct Image {
  int width = 0, height = 0;           // pixels
  std::vector<std::uint8_t> rgb = {};  // row-major from the top left, 3 bytes per pixel
};

}  // namespace rholm
