// PNG files, encoded in memory first, so that a file is written completely or not at all.
#include <vector>

#include "io/file/png_encoder.h"
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
  return png_of(image);
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_file(path, encode_png(image));
}

}  // namespace rholm
