#include "report/picture/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace rholm {
namespace {

struct Lab {
  double l, a, b;
};

// Converts linear sRGB to Oklab, with the other pair of the source's matrices.
Lab to_oklab(const Color& c) {
  const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
  const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
  const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double difference(const Lab& p, const Lab& q) {
  return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

bool displayable(const Color& c) {
  for (const float x : {c.r, c.g, c.b}) {
    if (x < 0 || x > 1) return false;
  }
  return true;
}

// The bound is 1e-6: matrices are published with ten digits, and colours have single precision.
TEST(from_oklch, is_the_inverse_of_the_published_matrices) {
  for (const double hue : {0.0, 75.0, 200.0, 310.0}) {
    const Lab lab = to_oklab(from_oklch(0.7, 0.1, hue));
    EXPECT_NEAR(lab.l, 0.7, 1e-6);
    EXPECT_NEAR(lab.a, 0.1 * std::cos(hue * std::numbers::pi / 180), 1e-6);
    EXPECT_NEAR(lab.b, 0.1 * std::sin(hue * std::numbers::pi / 180), 1e-6);
  }
}

TEST(color_scale, is_displayable_uniform_and_monotonic_in_lightness) {
  constexpr int n = 200;
  for (const ColorScale& scale : {ColorScale{0, 1}, ColorScale{5, 7}, ColorScale{-2, 2}}) {
    const auto at = [&](int k) { return scale.color(scale.min + (scale.max - scale.min) * k / n); };
    const double step = difference(to_oklab(at(0)), to_oklab(at(1)));
    EXPECT_GT(step, 0);
    for (int k = 0; k < n; ++k) {
      ASSERT_TRUE(displayable(at(k)) && displayable(at(k + 1))) << k;
      const Lab here = to_oklab(at(k)), next = to_oklab(at(k + 1));
      // The steps are chords of an arc; blue and red end equally far from the middle.
      ASSERT_NEAR(difference(here, next), step, 0.01 * step) << k;
      if (!scale.diverging() || k < n / 2) {
        ASSERT_GT(next.l, here.l);
      } else {
        ASSERT_LT(next.l, here.l);
      }
    }
  }
}

// Maps are drawn from tables. At twenty places of each step a component is within 2e-5 of the exact
// map, computed at every place from the ends and hues that color.cpp gives.
TEST(color_scale, is_the_map_between_the_places_of_its_table) {
  for (int k = 0; k <= 5120; ++k) {
    const double t = k / 5120.0;
    const auto expect_near = [&](const Color& color, const Color& wanted) {
      ASSERT_NEAR(color.r, wanted.r, 2e-5) << t;
      ASSERT_NEAR(color.g, wanted.g, 2e-5) << t;
      ASSERT_NEAR(color.b, wanted.b, 2e-5) << t;
    };
    expect_near(ColorScale{0, 1}.color(t), from_oklch(0.34 + t * 0.58, 0.095, 300 - t * 195));
    expect_near(ColorScale{-1, 1}.color(t), from_oklch(0.95 - t * 0.45, t * 0.155, 28));
    expect_near(ColorScale{-1, 1}.color(-t), from_oklch(0.95 - t * 0.45, t * 0.155, 255));
  }
}

TEST(color_scale, is_neutral_at_zero_also_of_a_lopsided_range) {
  const Lab middle = to_oklab(ColorScale{-1, 3}.color(0));
  EXPECT_NEAR(std::hypot(middle.a, middle.b), 0, 1e-6);
  EXPECT_GT(ColorScale({-1, 3}).color(3).r, ColorScale({-1, 3}).color(3).b);    // red
  EXPECT_LT(ColorScale({-1, 3}).color(-1).r, ColorScale({-1, 3}).color(-1).b);  // blue
}

TEST(color_scale, shows_values_outside_its_range_as_its_ends) {
  const ColorScale scale = {1, 2};
  EXPECT_EQ(scale.color(-5).g, scale.color(1).g);
  EXPECT_EQ(scale.color(1e300).g, scale.color(2).g);
  EXPECT_TRUE(displayable(ColorScale({3, 3}).color(3)));
}

// IEC 61966-2-1: 0.5 in linear light is 188 (0.7354 * 255). The straight part ends at 0.0031308:
// 12.92 * 0.0031308 * 255 = 10.3.
TEST(to_srgb_byte, follows_the_standard_and_clips) {
  EXPECT_EQ(to_srgb_byte(0), 0);
  EXPECT_EQ(to_srgb_byte(1), 255);
  EXPECT_EQ(to_srgb_byte(0.5f), 188);
  EXPECT_EQ(to_srgb_byte(0.0031308f), 10);
  EXPECT_EQ(to_srgb_byte(-3), 0);
  EXPECT_EQ(to_srgb_byte(7), 255);
}

// Rounding of floats, 1e-4 of a byte, may decide ties. Steps are proportional, to test dark values.
TEST(to_srgb_byte, rounds_the_encoded_value_to_the_nearest) {
  for (double x = 1e-6; x < 1; x *= 1.0001) {
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    ASSERT_NEAR(to_srgb_byte(static_cast<float>(x)), 255 * encoded, 0.5001) << x;
  }
}

}  // namespace
TEST(Color, srgb_there_and_back_is_the_byte) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(to_srgb_byte(from_srgb(static_cast<float>(byte) / 255)), byte);
  }
}

}  // namespace rholm
