// PNG by libpng, into memory first: a file appears whole or not at all.
#include <png.h>

#include <vector>

#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

void check(const Image& image) {
  const bool positive = image.width > 0 && image.height > 0;
  const std::size_t wanted =
      positive ? 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)
               : 0;
  if (!positive || image.rgb.size() != wanted) {
    throw Error(ErrorCode::kInvalidInput,
                "an image of " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " pixels with a buffer of " +
                    std::to_string(image.rgb.size()) + " bytes cannot be written");
  }
}

}  // namespace

std::vector<char> encode_png(const Image& image) {
  check(image);
  png_image png = {};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  // Filters and levels of zlib that take six times as long save 2 %.
  png.flags = PNG_IMAGE_FLAG_FAST;
  // The simplified interface reports errors as values; the bound on the size spares a second pass.
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

void write_png(const std::filesystem::path& path, const Image& image) {
  write_file(path, encode_png(image));
}

}  // namespace rholm
