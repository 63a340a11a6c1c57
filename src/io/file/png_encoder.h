// The bytes of a PNG file, in one of two ways: by libpng (png_libpng.cpp), or without it
// (png_plain.cpp). Layer: io, private.
#pragma once

#include <vector>

#include "rholm/image.h"

namespace rholm {

// Returns a file with 8-bit RGB. `image` has 3 * width * height bytes, at least one pixel.
std::vector<char> png_of(const Image& image);

}  // namespace rholm
