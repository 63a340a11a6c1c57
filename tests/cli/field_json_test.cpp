#include "cli/terminal/field_json.h"

#include <gtest/gtest.h>

#include <limits>

#include "rholm/compress.h"
#include "rholm/star.h"
#include "support/made_up_options.h"

namespace rholm::cli {
namespace {

TEST(json_of_fields, has_every_field_by_its_name) {
  EXPECT_EQ(json_of_fields(test::Outer{.share = 0.5, .place = Vec3{1, 2, 3}}).dump(),
            R"({"size":2.0,"share_of_all":0.5,"count":3,"flag":false,"colour":"green",)"
            R"("place":[1.0,2.0,3.0],"inner":null,"threads":0})");
  EXPECT_EQ(json_of_fields(test::Outer{.inner = test::Inner{.depth = 2}})["inner"].dump(),
            R"({"depth":2.0})");
}

TEST(json_of_fields, has_null_for_what_is_not_finite) {
  EXPECT_TRUE(json_of_value(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(json_of_value(std::numeric_limits<double>::quiet_NaN()).is_null());
}

TEST(json_of_fields, has_both_times_of_each_stage) {
  CompressReport report;
  report.times["fit"] = {.wall = 1, .cpu = 2};
  EXPECT_EQ(json_of_fields(report)["times"].dump(), R"({"fit":{"wall":1.0,"cpu":2.0}})");
}

}  // namespace
}  // namespace rholm::cli
