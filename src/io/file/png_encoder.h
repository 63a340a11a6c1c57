// The bytes of a PNG file, in one of two ways: by libpng (png_libpng.cpp), or without it
// (png_plain.cpp). Layer: io, private.
#pragma once

#include <vector>

#include "rholm/image.h"

namespace rholm {

// The file has RGB of 8 bits a colour. The image has 3 * width * height bytes, at least one pixel.
std::vector<char> png_of(const Image& image);

}  // namespace rholm
