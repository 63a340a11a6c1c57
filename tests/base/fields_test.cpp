#include "rholm/fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/check_fields.h"
#include "base/field_text.h"
#include "rholm/error.h"
#include "support/made_up_options.h"

namespace rholm {
namespace {

using test::Colour;
using test::Inner;
using test::Outer;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal(const Outer& options) {
  try {
    check_fields(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    return error.what();
  }
  return "";
}

TEST(check_fields, takes_what_is_within_the_bounds) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({.size = 1e-300, .share = 0, .count = 9, .place = Vec3{-1, 0, 1e300}}), "");
  EXPECT_EQ(refusal({.share = 1, .count = 1, .inner = Inner{.depth = kInfinity}}), "");
}

TEST(check_fields, says_name_value_and_limits) {
  EXPECT_EQ(refusal({.size = 0}), "size is 0: it must be above 0");
  EXPECT_EQ(refusal({.size = kInfinity}), "size is inf: it must be above 0");
  EXPECT_EQ(refusal({.share = 1.5}), "share_of_all is 1.5: it must be 0 ... 1");
  EXPECT_EQ(refusal({.count = 10}), "count is 10: it must be 1 ... 9");
  EXPECT_EQ(refusal({.place = Vec3{0, 0, -kInfinity}}), "place is -inf: it must be finite");
  EXPECT_EQ(refusal({.inner = Inner{.depth = -1}}), "depth is -1: it must be 0 or more");
}

TEST(check_fields, refuses_what_is_not_a_number) {
  const double nan = std::nan("");
  EXPECT_EQ(refusal({.size = nan}), "size is nan: it must be above 0");
  EXPECT_NE(refusal({.share = nan}), "");
  EXPECT_NE(refusal({.place = Vec3{nan, 0, 0}}), "");
  EXPECT_NE(refusal({.inner = Inner{.depth = nan}}), "");
}

TEST(text_of_fields, has_every_field_that_changes_the_result) {
  EXPECT_EQ(text_of_fields(Outer{.threads = 7}),
            "size 2 share_of_all none count 3 flag false colour green place none inner none");
  EXPECT_EQ(
      text_of_fields(Outer{.size = 0.1 + 0.2,
                           .share = 0.5,
                           .flag = true,
                           .colour = Colour::kRed,
                           .place = Vec3{1, 2, 3},
                           .inner = Inner{}}),
      "size 0.30000000000000004 share_of_all 0.5 count 3 flag true colour red place 1,2,3 inner "
      "(depth 1)");
}

TEST(names_of, go_there_and_back) {
  EXPECT_STREQ(to_string(Colour::kRed), "red");
  EXPECT_EQ(parse_name<Colour>("green"), Colour::kGreen);
  try {
    parse_name<Colour>("Green");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "no such colour: 'Green'; there are red, green");
  }
}

}  // namespace
}  // namespace rholm
