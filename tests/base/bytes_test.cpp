#include "base/bytes.h"

#include <gtest/gtest.h>

#include "base/field_bytes.h"
#include "base/field_text.h"
#include "rholm/error.h"
#include "support/made_up_options.h"

namespace rholm {
namespace {

TEST(bytes, give_back_what_was_written) {
  const std::string zeros(3, '\0');
  const std::string bytes = ByteWriter()
                                .number(0)
                                .number(~std::uint64_t{0})
                                .text("")
                                .text(zeros)
                                .texts({"a", "", "bc"})
                                .take();
  ByteReader reader(bytes);
  EXPECT_EQ(reader.number(), 0U);
  EXPECT_EQ(reader.number(), ~std::uint64_t{0});
  EXPECT_EQ(reader.text(), "");
  EXPECT_EQ(reader.text(), zeros);
  EXPECT_EQ(reader.texts(), (std::vector<std::string>{"a", "", "bc"}));
  EXPECT_THROW(reader.number(), Error);
}

TEST(field_bytes, give_back_every_field) {
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
    ByteWriter writer;
    write_fields(sent, writer);
    const std::string bytes = writer.take();
    ByteReader reader(bytes);
    Outer got = all;  // fields that are not sent are reset
    read_fields(reader, got);
    EXPECT_EQ(text_of_fields(got), text_of_fields(sent));
    EXPECT_EQ(got.threads, sent.threads);
    EXPECT_TRUE(reader.rest().empty());
  }
}

TEST(bytes, are_never_read_beyond_the_end) {
  const std::string bytes = ByteWriter().text("some text").texts({"a", "b"}).take();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader reader(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(
        {
          reader.text();
          reader.texts();
        },
        Error)
        << size;
  }
}

}  // namespace
}  // namespace rholm
