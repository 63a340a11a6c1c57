#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#include "base/random.h"
#include "io/shapes/test_support.h"
#include "rholm/file.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Decodes a PNG file of ours with zlib and the definition of PNG's filters; verifies checksums.
Image decoded(const std::string& png) {
  Image image;
  std::string stream;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = big_endian(png, at);
    const std::string name = png.substr(at + 4, 4), data = png.substr(at + 8, size);
    const auto* checked = reinterpret_cast<const Bytef*>(png.data() + at + 4);
    EXPECT_EQ(big_endian(png, at + 8 + size), ::crc32(0, checked, static_cast<uInt>(size + 4)));
    if (name == "IHDR") {
      image.width = static_cast<int>(big_endian(data, 0));
      image.height = static_cast<int>(big_endian(data, 4));
      EXPECT_EQ(data.substr(8), std::string("\x08\x02\0\0\0", 5));
    }
    if (name == "IDAT") stream += data;
    at += size + 12;
  }
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(image.height) * (row + 1));
  uLongf size = bytes.size();
  EXPECT_EQ(
      uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(stream.data()), stream.size()),
      Z_OK);
  EXPECT_EQ(size, bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t x = i % (row + 1), y = i / (row + 1);
    if (x == 0) continue;  // index of the filter
    const std::size_t at = image.rgb.size();
    const int left = x > 3 ? image.rgb[at - 3] : 0, up = y > 0 ? image.rgb[at - row] : 0;
    const int corner = x > 3 && y > 0 ? image.rgb[at - row - 3] : 0;
    const int p = left + up - corner;
    const int of_left = std::abs(p - left), of_up = std::abs(p - up);
    const int of_corner = std::abs(p - corner);
    const int paeth = of_left <= of_up && of_left <= of_corner ? left
                      : of_up <= of_corner                     ? up
                                                               : corner;
    const std::array<int, 5> predicted = {0, left, up, (left + up) / 2, paeth};
    image.rgb.push_back(static_cast<std::uint8_t>(bytes[i] + predicted.at(bytes[i - x])));
  }
  return image;
}

// Noise, one colour, slopes in both directions, and rows that repeat after 100 rows.
std::uint8_t sample(int kind, int x, int y) {
  if (kind == 0)
    return static_cast<std::uint8_t>(random_bits(3, std::uint64_t(y) << 32 | unsigned(x)));
  if (kind == 1) return 200;
  if (kind == 2) return static_cast<std::uint8_t>(x / 7 + 5 * y);
  return static_cast<std::uint8_t>(random_bits(4, std::uint64_t(y % 100) << 32 | unsigned(x)));
}

TEST(encode_png, pixels_decode_by_zlib) {
  for (int kind = 0; kind < 4; ++kind) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {257, 3}, {90, 250}}) {
      Image image{.width = width, .height = height, .rgb = {}};
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 3 * width; ++x) image.rgb.push_back(sample(kind, x, y));
      }
      const std::vector<char> png = encode_png(image);
      const Image found = decoded({png.data(), png.size()});
      EXPECT_EQ(found.width, width);
      EXPECT_EQ(found.height, height);
      EXPECT_EQ(found.rgb, image.rgb) << kind << " " << width << " x " << height;
    }
  }
}

TEST(encode_png, flat_pictures_take_a_fiftieth_of_their_bytes) {
  const Image image{.width = 400, .height = 300, .rgb = std::vector<std::uint8_t>(360000, 60)};
  EXPECT_LT(encode_png(image).size(), image.rgb.size() / 50);
}

// The signature and the first chunk of the PNG specification: width, height, depth 8, colour type 2
// (RGB) at bytes 16 ... 25.
TEST(write_png, file_has_the_signature_and_size) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", {.width = 3, .height = 2, .rgb = std::vector<std::uint8_t>(18, 77)});
  const std::string bytes = testing::read_all(folder / "a.png");
  ASSERT_GT(bytes.size(), 33u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(big_endian(bytes, 16), 3u);
  EXPECT_EQ(big_endian(bytes, 20), 2u);
  EXPECT_EQ(bytes[24], 8);
  EXPECT_EQ(bytes[25], 2);
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
}

TEST(write_png, buffer_that_does_not_fit_is_refused) {
  const TemporaryFolder folder;
  const auto refuse = [&](const Image& image) {
    expect_error([&] { write_png(folder / "a.png", image); }, ErrorCode::kInvalidInput, {"pixels"});
  };
  refuse({});
  refuse({.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(11)});
  refuse({.width = -1, .height = 2, .rgb = {}});
  EXPECT_EQ(folder.n_files(), 0u);
}

}  // namespace
}  // namespace rholm
