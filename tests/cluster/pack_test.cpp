#include "cluster/pack.h"

#include <gtest/gtest.h>

#include "rholm/error.h"

namespace rholm {
namespace {

TEST(pack, gives_back_what_was_packed) {
  const std::string zeros(3, '\0');
  const std::string bytes = Packer()
                                .number(0)
                                .number(~std::uint64_t{0})
                                .text("")
                                .text(zeros)
                                .texts({"a", "", "bc"})
                                .take();
  Unpacker packed(bytes);
  EXPECT_EQ(packed.number(), 0U);
  EXPECT_EQ(packed.number(), ~std::uint64_t{0});
  EXPECT_EQ(packed.text(), "");
  EXPECT_EQ(packed.text(), zeros);
  EXPECT_EQ(packed.texts(), (std::vector<std::string>{"a", "", "bc"}));
  EXPECT_THROW(packed.number(), Error);
}

TEST(pack, never_reads_beyond_the_end) {
  const std::string bytes = Packer().text("some text").texts({"a", "b"}).take();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Unpacker packed(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(
        {
          packed.text();
          packed.texts();
        },
        Error)
        << size;
  }
}

}  // namespace
}  // namespace rholm
