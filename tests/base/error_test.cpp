#include "rholm/error_info.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace rholm {
namespace {

// The number of enum values is written here, so that a value without a line is noticed.
TEST(error, has_a_line_of_the_table_for_every_code) {
  constexpr int kCodes = static_cast<int>(ErrorCode::kCancelled) + 1;
  ASSERT_EQ(error_infos().size(), std::size_t{kCodes});
  std::set<std::string> names, classes;
  for (int i = 0; i < kCodes; ++i) {
    const ErrorInfo& info = error_infos()[static_cast<std::size_t>(i)];
    EXPECT_EQ(static_cast<int>(info.code), i);
    EXPECT_STREQ(to_string(info.code), info.name);
    EXPECT_EQ(info.python_class, info.name + std::string("Error"));
    names.insert(info.name);
    classes.insert(info.python_class);
  }
  EXPECT_EQ(names.size(), std::size_t{kCodes});
  EXPECT_EQ(classes.size(), std::size_t{kCodes});
}

TEST(error, names_a_kind_in_small_letters_for_json) {
  EXPECT_EQ(snake_case_name(ErrorCode::kNotStarShaped), "not_star_shaped");
  EXPECT_EQ(snake_case_name(ErrorCode::kIo), "io");
}

}  // namespace
}  // namespace rholm
