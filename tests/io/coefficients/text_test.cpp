// Text formats of SHTOOLS and ICGEM.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "io/coefficients/test_support.h"
#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using namespace coefficients_testing;
using testing::read_all;
using testing::TemporaryFolder;

std::string written(const Expansion& expansion, CoefficientsFormat format,
                    const Convention& convention = {}) {
  const TemporaryFolder folder;
  write_coefficients(expansion, folder / "file", {.format = format, .convention = convention});
  return read_all(folder / "file");
}

// The surface r = 1 + a P_2(cos theta) + b sin^2 theta cos 2 phi + d sin theta cos theta sin phi
// with a = 0.25, b = 0.15, d = 0.3. The 4-pi normalised functions without phase are
//   Y_20 = sqrt(5) P_2,
//   Y_21 = sqrt(2 . 5 . 1!/3!) P_21 = sqrt(5/3) . 3 sin theta cos theta sin phi
//        = sqrt(15) sin theta cos theta sin phi,
//   Y_22 = sqrt(2 . 5 . 0!/4!) P_22 = sqrt(5/12) . 3 sin^2 theta cos 2 phi
//        = sqrt(15)/2 sin^2 theta cos 2 phi,
// so that, with 30 digits by hand (decimal arithmetic),
//   C_00 = 1
//   C_20 = a / sqrt(5)    = 0.111803398874989484820458683437
//   S_21 = d / sqrt(15)   = 0.0774596669241483377035853079957
//   C_22 = 2 b / sqrt(15) = 0.0774596669241483377035853079957
// The internal, orthonormal coefficients are sqrt(4 pi) times these values. Both are rounded: the
// parameters were chosen so that they round to the doubles nearest to the numbers above.
Expansion hand_computed_shape() {
  Expansion expansion;
  expansion.coefficients = Coefficients(2);
  expansion.coefficients.c(0, 0) = std::sqrt(4 * std::numbers::pi);
  expansion.coefficients.c(2, 0) = std::sqrt(4 * std::numbers::pi / 5) * 0.25;
  expansion.coefficients.s(2, 1) = std::sqrt(4 * std::numbers::pi / 15) * 0.3;
  expansion.coefficients.c(2, 2) = std::sqrt(4 * std::numbers::pi / 15) * 0.3;
  return expansion;
}

TEST(shtools, text_of_a_hand_computed_shape_is_right_digit_by_digit) {
  EXPECT_EQ(written(hand_computed_shape(), CoefficientsFormat::kShtools),
            "# format: rholm-coefficients 1\n"
            "# columns: l m C S\n"
            "# degree: 2\n"
            "# lines: 6\n"
            "# normalization: 4pi\n"
            "# csphase: 1\n"
            "# function: radius\n"
            "# center: 0 0 0\n"
            "0 0 1 0\n"
            "1 0 0 0\n"
            "1 1 0 0\n"
            "2 0 0.11180339887498948 0\n"
            "2 1 0 0.07745966692414834\n"
            "2 2 0.07745966692414834 0\n");
}

TEST(shtools, phase_turns_the_sign_of_the_odd_order_only) {
  const std::string text =
      written(hand_computed_shape(), CoefficientsFormat::kShtools, {Normalization::kFourPi, -1});
  EXPECT_NE(text.find("# csphase: -1\n"), std::string::npos);
  EXPECT_NE(text.find("\n1 1 0 0\n"), std::string::npos);
  EXPECT_NE(text.find("\n2 1 0 -0.07745966692414834\n"), std::string::npos);
  EXPECT_NE(text.find("\n2 2 0.07745966692414834 0\n"), std::string::npos);
}

TEST(icgem, text_of_a_hand_computed_shape_is_right_digit_by_digit) {
  Expansion expansion = hand_computed_shape();
  expansion.unit = "km";
  EXPECT_EQ(written(expansion, CoefficientsFormat::kIcgem),
            "product_type shape\n"
            "modelname rholm\n"
            "max_degree 2\n"
            "errors no\n"
            "norm fully_normalized\n"
            "rholm_format 1\n"
            "rholm_lines 6\n"
            "rholm_csphase 1\n"
            "rholm_function radius\n"
            "rholm_center 0 0 0\n"
            "rholm_unit km\n"
            "key l m C S\n"
            "end_of_head\n"
            "gfc 0 0 1 0\n"
            "gfc 1 0 0 0\n"
            "gfc 1 1 0 0\n"
            "gfc 2 0 0.11180339887498948 0\n"
            "gfc 2 1 0 0.07745966692414834\n"
            "gfc 2 2 0.07745966692414834 0\n");
}

// All forms that pyshtools reads or writes, and the output of Fortran programs.
TEST(shtools, separators_order_missing_pairs_and_further_columns_are_free) {
  Coefficients expected(2);
  expected.c(0, 0) = 1;
  expected.c(2, 1) = -2.5;
  expected.s(2, 1) = 1e-3;
  for (const std::string text :
       {"0 0 1 0\n2 1 -2.5 0.001\n", "2,1,-2.5,0.001\n0,0,1\n",
        "  0,    0,  0.1E+01,  0.0\n\n  2,    1, -0.25D+01, 1.0d-03\n",
        "0 0 1 0 0.1 0\r\n2 1 -2.5 1e-3 0.1 0.2\r\n", "0 0 1 0\r2 1 -2.5 1e-3\r",
        "# text\n#\n\t0\t0\t+1\t0\n# x: y\n2 1 -2.5 .001", "0 0 1 0\n2 1 -2.5 1e-3\n2 2 0 0\n"}) {
    const CoefficientsFile file = parse(text, {.convention = {Normalization::kOrthonormal, 1}});
    EXPECT_EQ(file.format, CoefficientsFormat::kShtools);
    expect_same_numbers(file.expansion.coefficients, expected);
  }
}

TEST(shtools, stated_degree_fills_up_with_zeros) {
  EXPECT_EQ(parse("# degree: 5\n0 0 1 0\n").expansion.coefficients.degree(), 5);
  expect_refused("# degree: 1\n2 0 1 0\n", "degree 1");
}

TEST(shtools, malformed_lines_are_refused_with_their_number) {
  expect_refused("0 0 1 0\n1 2 1 0\n", "line 2: order m = 2 exceeds degree l = 1");
  expect_refused("0 0 nan 0\n", "finite");
  expect_refused("0 0 inf 0\n", "finite");
  expect_refused("0 0 1 0\n1 1 1 -infinity\n", "line 2");
  expect_refused("0 0 1e999 0\n", "range");
  expect_refused("0 0 1x 0\n", "'1x'");
  expect_refused("0 0 1 0 x\n", "'x'");
  expect_refused("0 0 0x10 0\n", "'0x10'");
  expect_refused("0 0 +-1 0\n", "'+-1'");
  expect_refused("0\n", "line 1");
  expect_refused("0 0\n", "line 1");
  expect_refused("1 1 1\n", "line 1");
  expect_refused("-1 0 1 0\n", "'-1'");
  expect_refused("0 0 1 0\n1 -1 1 0\n", "'-1'");
  expect_refused("16385 0 1 0\n", "16384");
  expect_refused("99999999999999999999 0 1 0\n", "16384");
  expect_refused("0 0 1 0\n0 0 1 0\n", "l = 0, m = 0 is given twice");
  expect_refused("1 0 1 0.5\n", "sin 0");
  expect_refused("1738.0, 4902.8, 900, 900\n0 0 1 0\n", "put '#' before");
  expect_refused("hello\n", "'hello'");
  expect_refused("# nothing\n\n", "no line");
  expect_refused(std::string("0 0 1\0002 0\n", 10), "'1?2'");
  expect_refused("\xff\xfe\n", "'\?\?'");
  expect_refused(std::string(100000, 'x'), "...");
}

// One line of 14 bytes must not cost gigabytes. Dense files of any degree may omit zeros.
TEST(shtools, high_degrees_need_lines_that_support_them) {
  expect_refused("16384 0 1 0\n", "at least one in 16");
  expect_refused("1024 0 1 0\n", "at least one in 16");
  expect_refused("# degree: 16384\n0 0 1 0\n", "at least one in 16");
  EXPECT_EQ(parse("1023 0 1 0\n").expansion.coefficients.degree(), 1023);
  std::string every_fourth_order;
  for (int l = 0; l <= 1030; ++l) {
    for (int m = 0; m <= l; m += 4) {
      every_fourth_order += std::to_string(l) + " " + std::to_string(m) + " 1 0\n";
    }
  }
  EXPECT_EQ(parse(every_fourth_order).expansion.coefficients.degree(), 1030);
}

TEST(shtools, comments_with_known_keys_must_make_sense) {
  const std::string line = "0 0 1 0\n";
  expect_refused("# normalization: 5pi\n" + line, "line 1: normalization");
  expect_refused("# csphase: 0\n" + line, "csphase");
  expect_refused("# function: log-radius\n" + line, "function");
  expect_refused("# center: 1 2\n" + line, "three numbers");
  expect_refused("# center: 1 2 nan\n" + line, "finite");
  expect_refused("# degree: -1\n" + line, "degree");
  expect_refused("# degree: 16385\n" + line, "degree");
  expect_refused("# lines: 2\n" + line, "lines");
  expect_refused("# norm_squared: -1\n" + line, "norm_squared");
  expect_refused("# tail_strength: x\n" + line, "tail_strength");
  expect_refused("# unit: \xff\n" + line, "unit");
  for (const std::string twice : {"# csphase: 1\n", "# unit: m\n", "# center: 0 0 0\n",
                                  "# degree: 0\n", "# normalization: 4pi\n", "# method: edge\n"}) {
    expect_refused(twice + twice + line, "twice");
  }
  expect_unsupported("# format: rholm-coefficients 2\n" + line, "rholm-coefficients 1");
  EXPECT_EQ(parse("#unit:m\n# other: key\n# format: free\n" + line).expansion.unit, "m");
}

constexpr const char* kPublishedStyle =
    "A model of something, as published. The free text may have the words of the header:\n"
    "norm of no one\n"
    "max_degree of nothing\n"
    "begin_of_head ==============================================\n"
    "product_type              gravity_field\n"
    "modelname                 TEST\n"
    "earth_gravity_constant    0.3986004415E+15\n"
    "radius                    0.6378136300E+07\n"
    "max_degree                2\n"
    "errors                    formal\n"
    "norm                      fully_normalized\n"
    "tide_system               tide_free\n"
    "\n"
    "key    L    M         C                  S           sigma C    sigma S\n"
    "end_of_head =================================================\n"
    "gfc    0    0  1.0d+00  0.0d+00  0.0 0.0\n"
    "gfc    2    0 -4.8D-04  0.0D+00  1e-11 0.0\n"
    "gfc    2    2  2.4e-06 -1.4e-06  1e-11 1e-11\n";

TEST(icgem, published_files_are_read_and_what_they_are_is_said) {
  const CoefficientsFile file = parse(kPublishedStyle);
  EXPECT_EQ(file.format, CoefficientsFormat::kIcgem);
  EXPECT_EQ(file.convention, (Convention{Normalization::kFourPi, 1}));
  EXPECT_EQ(file.assumed, (std::vector<std::string>{"csphase 1", "center 0 0 0"}));
  EXPECT_EQ(file.expansion.gravity, (GravityField{0.3986004415e15, 0.63781363e7}));
  EXPECT_TRUE(file.passed_over.empty());
  const double factor = std::sqrt(4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(file.expansion.coefficients.c(2, 0), -4.8e-4 * factor);
  EXPECT_DOUBLE_EQ(file.expansion.coefficients.s(2, 2), -1.4e-6 * factor);
  EXPECT_EQ(file.expansion.coefficients.c(1, 0), 0);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(icgem, gravity_field_is_no_radius) {
  const CoefficientsFile file = parse(kPublishedStyle);
  EXPECT_EQ(file.expansion.function, RadialFunction::kOther);
  EXPECT_EQ(file.product, "gravity_field");
  EXPECT_THROW(require_surface(file.expansion), Error);
  // A gravity constant marks the file where the type of product does not. A field of our own takes
  // precedence.
  const std::string type = "product_type              gravity_field\n";
  EXPECT_EQ(parse(replaced(kPublishedStyle, type, "")).expansion.function, RadialFunction::kOther);
  const std::string shape = replaced(kPublishedStyle, type, "product_type shape\n");
  EXPECT_EQ(parse(shape).expansion.function, RadialFunction::kRadius);
  const std::string own = replaced(kPublishedStyle, type, type + "rholm_function gauge\n");
  EXPECT_EQ(parse(own).expansion.function, RadialFunction::kGauge);
}

constexpr CoefficientsFormat kTexts[] = {CoefficientsFormat::kShtools, CoefficientsFormat::kIcgem,
                                         CoefficientsFormat::kJson};

TEST(gravity_field, what_it_is_relative_to_is_written_and_read) {
  Expansion field = parse(kPublishedStyle).expansion;
  field.gravity = {4.9028e12, 1738000.5};
  for (const auto format : kTexts) {
    const CoefficientsFile again = parse(written(field, format));
    EXPECT_EQ(again.expansion.gravity, field.gravity) << to_string(format);
    EXPECT_EQ(again.expansion.function, RadialFunction::kOther);
    EXPECT_TRUE(again.passed_over.empty());
    EXPECT_EQ(again.product, format == CoefficientsFormat::kIcgem ? "gravity_field" : "");
    expect_same_numbers(again.expansion.coefficients, field.coefficients);
  }
}

TEST(precision, is_written_and_read_and_unknown_where_nothing_is_said) {
  Expansion expansion;
  EXPECT_FALSE(parse(written(expansion, CoefficientsFormat::kJson)).expansion.precision);
  for (const auto format : kTexts) {
    expansion.precision = 1e-3;
    EXPECT_EQ(parse(written(expansion, format)).expansion.precision, 1e-3) << to_string(format);
    expansion.precision = -1;
    EXPECT_THROW(written(expansion, format), Error);
  }
}

TEST(gravity_field, is_refused_where_it_cannot_be) {
  const double infinity = std::numeric_limits<double>::infinity();
  Expansion field = parse(kPublishedStyle).expansion;
  for (const auto format : kTexts) {
    for (const GravityField& wrong :
         {GravityField{0, 1}, GravityField{1, -1}, GravityField{infinity, 1}}) {
      field.gravity = wrong;
      EXPECT_THROW(written(field, format), Error);
    }
    Expansion shape = field;
    shape.gravity = {1, 1};
    shape.function = RadialFunction::kRadius;
    EXPECT_THROW(written(shape, format), Error);
  }
  const std::string head = "# function: other\n# gravity_constant: 1\n", line = "0 0 1 0\n";
  expect_refused(head + line, "reference_radius");
  expect_refused(head + "# reference_radius: 0\n" + line, "reference radius");
  expect_refused("# gravity_constant: 1\n# reference_radius: 1\n" + line, "'other'");
}

TEST(icgem, published_gravity_fields_have_their_constant_and_radius) {
  const std::string radius = "radius                    0.6378136300E+07\n";
  for (const char* wrong : {"", "radius large\n", "radius -1\n", "radius 1e999\n", "radius\n"}) {
    const CoefficientsFile file = parse(replaced(kPublishedStyle, radius, wrong));
    EXPECT_FALSE(file.expansion.gravity) << wrong;
    ASSERT_FALSE(file.passed_over.empty());
    EXPECT_EQ(file.passed_over[0], "earth_gravity_constant '0.3986004415E+15'");
  }
  const std::string type = "product_type              gravity_field";
  const CoefficientsFile shape = parse(replaced(kPublishedStyle, type, "product_type shape"));
  EXPECT_FALSE(shape.expansion.gravity);
  EXPECT_EQ(shape.passed_over.size(), 2u);
}

TEST(icgem, what_is_no_radius_stays_so_in_every_format) {
  Expansion field = parse(kPublishedStyle).expansion;
  field.gravity.reset();
  for (const auto format :
       {CoefficientsFormat::kShtools, CoefficientsFormat::kIcgem, CoefficientsFormat::kJson}) {
    const CoefficientsFile again = parse(written(field, format));
    EXPECT_EQ(again.expansion.function, RadialFunction::kOther) << to_string(format);
    EXPECT_EQ(again.product, "");
  }
}

TEST(icgem, malformed_files_are_refused) {
  const std::string head = "max_degree 1\nnorm fully_normalized\nend_of_head\n";
  expect_refused("max_degree 1\ngfc 0 0 1 0\n", "end_of_head");
  expect_refused(head, "no line");
  expect_refused(head + "gfc\n", "without numbers");
  expect_refused(head + "gfc 0\n", "line 4");
  expect_refused(head + "gfc 2 0 1 0\n", "degree 1");
  expect_refused(head + "gfc 1 2 1 0\n", "order");
  expect_refused(head + "gfc 1 1 1 nan\n", "finite");
  expect_refused(head + "gfc 0 0 1 0\ngfc 0 0 1 0\n", "twice");
  expect_refused(head + "0 0 1 0\n", "instead of gfc");
  expect_refused("max_degree x\n" + head + "gfc 0 0 1 0\n", "max_degree");
  expect_refused("max_degree 0\n" + head + "gfc 0 0 1 0\n", "twice");
  expect_refused("max_degree 16384\nend_of_head\ngfc 0 0 1 0\n", "at least one in 16");
  expect_refused("rholm_lines 2\n" + head + "gfc 0 0 1 0\n", "lines");
  for (const char* key : {"gfct", "trnd", "acos", "asin"}) {
    expect_unsupported(head + key + " 0 0 1 0\n", "vary in time");
  }
  expect_unsupported("norm unnormalized\nend_of_head\ngfc 0 0 1 0\n", "unnormalized");
  expect_unsupported("rholm_format 2\n" + head + "gfc 0 0 1 0\n", "rholm_format");
}

// Files written by version 0.1.0: later versions must read the same values from them. The values
// are C_lm = 1/(1 + l + m), S_lm = m/(l + 1) in the file's convention.
TEST(golden_files, texts_json_and_npy_of_version_0_1_are_read) {
  for (const char* name : {"degree4.sh", "degree4.gfc", "degree4.json", "degree4.npy"}) {
    SCOPED_TRACE(name);
    const CoefficientsFile file =
        read_coefficients(std::filesystem::path(RHOLM_TEST_DATA) / "coefficients" / name,
                          {.convention = {Normalization::kSchmidt, -1}});
    EXPECT_EQ(file.convention, (Convention{Normalization::kSchmidt, -1}));
    const Coefficients numbers = to_convention(file.expansion.coefficients, file.convention);
    ASSERT_EQ(numbers.degree(), 4);
    for (int l = 0; l <= 4; ++l) {
      for (int m = 0; m <= l; ++m) {
        EXPECT_DOUBLE_EQ(numbers.c(l, m), 1.0 / (1 + l + m));
        EXPECT_DOUBLE_EQ(numbers.s(l, m), m / (l + 1.0));
      }
    }
    if (file.format == CoefficientsFormat::kNpy) continue;
    EXPECT_EQ(file.expansion.function, RadialFunction::kGauge);
    EXPECT_EQ(file.expansion.center, (Vec3{1, -2, 0.5}));
    EXPECT_EQ(file.expansion.unit, "\xc2\xb5m");
    EXPECT_EQ(file.expansion.method, "gauge");
    EXPECT_EQ(file.expansion.norm_squared, 12.5);
    EXPECT_EQ(file.expansion.tail_strength, 0.125);
    EXPECT_TRUE(file.assumed.empty());
  }
}

}  // namespace
}  // namespace rholm
