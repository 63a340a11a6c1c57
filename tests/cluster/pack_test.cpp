#include "cluster/pack.h"

#include <gtest/gtest.h>

#include "base/field_text.h"
#include "cluster/pack_fields.h"
#include "rholm/error.h"
#include "support/made_up_options.h"

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

TEST(pack_fields, gives_back_every_field) {
  using namespace test;
  const Outer all{.size = 0.1,
                  .share = 0.5,
                  .count = -3,
                  .flag = true,
                  .colour = Colour::kRed,
                  .place = Vec3{1, 2, 3},
                  .inner = Inner{.depth = 4},
                  .threads = 5};
  for (const Outer& sent : {Outer{}, all}) {
    Packer packer;
    pack_fields(sent, packer);
    const std::string bytes = packer.take();
    Unpacker packed(bytes);
    Outer got = all;  // what was not given is not left as it was
    unpack_fields(packed, got);
    EXPECT_EQ(text_of_fields(got), text_of_fields(sent));
    EXPECT_EQ(got.threads, sent.threads);
    EXPECT_TRUE(packed.rest().empty());
  }
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
