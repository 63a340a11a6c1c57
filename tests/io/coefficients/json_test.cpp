#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/coefficients/test_support.h"

namespace rholm {
namespace {

using namespace coefficients_testing;

const std::string kRows = R"("coefficients":{"C":[[1],[2,3]],"S":[[0],[0,4]]})";
std::string with(const std::string& members) {
  return R"({"format":"rholm-coefficients",)" + members + "}";
}

TEST(json, members_may_stand_in_any_order_and_most_may_be_missing) {
  for (const std::string& text :
       {with(kRows), "{" + kRows + R"(,"format":"rholm-coefficients"})",
        with(R"("normalization":"4pi","csphase":1,"degree":1,"version":1,)" + kRows),
        with(R"("center":[0,0.0,-0],"norm_squared":1e3,"tail_strength":7,)" + kRows)}) {
    const CoefficientsFile file = parse(text);
    const double factor = std::sqrt(4 * std::numbers::pi);
    ASSERT_EQ(file.expansion.coefficients.degree(), 1);
    EXPECT_DOUBLE_EQ(file.expansion.coefficients.c(0, 0), 1 * factor);
    EXPECT_DOUBLE_EQ(file.expansion.coefficients.c(1, 0), 2 * factor);
    EXPECT_DOUBLE_EQ(file.expansion.coefficients.c(1, 1), 3 * factor);
    EXPECT_DOUBLE_EQ(file.expansion.coefficients.s(1, 1), 4 * factor);
  }
}

TEST(json, unknown_members_of_any_kind_are_passed_over) {
  parse(with(R"("a":null,"b":true,"c":"x","d":1.5,"e":-1,"f":[1,[2],{"g":[]}],"h":{"C":{}},)" +
             kRows));
}

TEST(json, members_of_the_wrong_kind_are_refused) {
  for (const std::string member :
       {R"("degree":"1")",        R"("degree":[1])",       R"("degree":1.5)",
        R"("degree":-1)",         R"("degree":16385)",     R"("degree":null)",
        R"("degree":2)",          R"("normalization":4)",  R"("normalization":"3pi")",
        R"("csphase":2)",         R"("csphase":"1")",      R"("function":"log")",
        R"("function":1)",        R"("center":1)",         R"("center":[1,2])",
        R"("center":[1,2,3,4])",  R"("center":["a",2,3])", R"("center":[[1],2,3])",
        R"("center":[null,2,3])", R"("center":{"x":1})",   R"("unit":1)",
        R"("unit":"a\nb")",       R"("unit":"a\u0000b")",  R"("method":true)",
        R"("norm_squared":-1)",   R"("norm_squared":"1")", R"("tail_strength":[])",
        R"("version":"1")",       R"("coefficients":1)",   R"("coefficients":[[1]])"}) {
    expect_refused(with(member + "," + kRows), "");
  }
}

TEST(json, rows_must_be_triangular_and_of_one_degree) {
  for (const std::string rows :
       {R"({"C":[[1],[2]],"S":[[0],[0]]})", R"({"C":[[1,2]],"S":[[0,0]]})", R"({"C":[],"S":[]})",
        R"({"C":[[]],"S":[[]]})", R"({"C":[[1]]})", R"({"S":[[1]]})", R"({"C":[[1]],"S":[]})",
        R"({"C":[[1],[2,3]],"S":[[0]]})", R"({"C":[1],"S":[0]})", R"({"C":[[[1]]],"S":[[0]]})",
        R"({"C":[[1]],"C":[[1]],"S":[[0]]})", R"({"C":[[1]],"S":[[0]],"T":[[0]]})",
        R"({"C":[[null]],"S":[[0]]})", R"({"C":[["1"]],"S":[[0]]})", R"({"C":{},"S":{}})",
        R"({"C":[[1]],"S":[[1]]})", R"({"C":1,"S":2})", R"({"C":[{"a":1}],"S":[[0]]})", "{}"}) {
    expect_refused(with(R"("coefficients":)" + rows), "");
  }
}

TEST(json, broken_and_foreign_json_is_refused) {
  for (const std::string text :
       {"{", "[", "{}x", "[]", "{\"format\":", "{\"format\":\"rholm-coefficients\"}",
        "{\"format\":\"rholm-coefficients\",}", "[1,2,3]", "{'format':1}"}) {
    expect_refused(text, "");
  }
  expect_refused(with(kRows + ",\"unit\":\"m\",\"unit\":\"m\""), "twice");
  expect_refused(with(R"("norm_squared":1e999,)" + kRows), "out of range");
  expect_refused(with(R"("norm_squared":NaN,)" + kRows), "byte");
  expect_refused(with("\"unit\":\"\xff\"," + kRows), "byte");
  expect_unsupported("{" + kRows + "}", "format");
  expect_unsupported("{}", "format");
  expect_unsupported("{\"format\":\"other\"," + kRows + "}", "'other'");
  expect_unsupported(with(R"("version":2,)" + kRows), "version 2");
}

TEST(json, deep_nesting_is_refused_early) {
  const std::string deep(1000000, '[');
  expect_refused(deep, "array");
  expect_refused(with("\"x\":" + deep), "deeper than 64");
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  expect_refused(objects, "deeper than 64");
}

}  // namespace
}  // namespace rholm
