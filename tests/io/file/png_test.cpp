#include <gtest/gtest.h>

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

// The signature and the first chunk by the PNG specification: width, height, depth 8, colour type
// 2 (RGB) at bytes 16 ... 25. That the pixels decode is shown by viewers; libpng wrote them.
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
