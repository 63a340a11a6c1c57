// A picture. Layer: base.
#pragma once

#include <cstdint>
#include <vector>

namespace rholm {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb = {};  // row-major from the top left, 3 bytes per pixel
};

}  // namespace rholm
