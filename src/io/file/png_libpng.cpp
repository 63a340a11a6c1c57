// PNG by libpng.
#include <png.h>

#include <string>

#include "io/file/png_encoder.h"
#include "rholm/error.h"

namespace rholm {

std::vector<char> png_of(const Image& image) {
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  // Filters and zlib levels that take six times as long save 2 %.
  png.flags = PNG_IMAGE_FLAG_FAST;
  // The simplified interface returns errors as values; the bound on the size saves a second pass.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<char> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    const std::string reason = png.message;
    png_image_free(&png);
    throw Error(ErrorCode::kInvalidInput, "cannot encode a PNG image: " + reason);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace rholm
