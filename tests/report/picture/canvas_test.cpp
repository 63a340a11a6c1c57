#include "report/picture/canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "report/picture/font.h"
#include "report/picture/scale_bar.h"

namespace rholm {
namespace {

constexpr Color kWhite = {1, 1, 1};

// Returns the amount of ink on the canvas, in pixels.
double ink(const Canvas& canvas) {
  double sum = 0;
  for (const Color& c : canvas.pixels) sum += 1 - c.r;
  return sum;
}

// A line with round ends covers length * thickness + pi thickness^2 / 4. The cover of each pixel is
// computed for a straight edge, which is inexact at the ends only: by less than a pixel.
TEST(draw_strokes, covers_the_area_of_the_line) {
  for (const double angle : {0.0, 0.3, 0.785}) {
    Canvas canvas = make_canvas(200, 200, kWhite);
    const double dx = 80 * std::cos(angle), dy = 80 * std::sin(angle), width = 5;
    draw_strokes(canvas, {{100 - dx, 100 - dy, 100 + dx, 100 + dy}}, width, {0, 0, 0});
    EXPECT_NEAR(ink(canvas), 160 * width + 3.14159 * width * width / 4, 8) << angle;
  }
}

TEST(draw_strokes, does_not_darken_overlaps_and_stays_within_the_canvas) {
  Canvas once = make_canvas(50, 40, kWhite), twice = once;
  const Stroke s = {-30, 10, 90, 25};
  draw_strokes(once, {s}, 3, {0, 0, 0});
  draw_strokes(twice, {s, s}, 3, {0, 0, 0});
  EXPECT_EQ(to_image(once).rgb, to_image(twice).rgb);
  draw_strokes(once, {{-1e9, 1e9, -1e9, 1e9}}, 3, {0, 0, 0});
  EXPECT_EQ(to_image(once).rgb, to_image(twice).rgb);
}

TEST(font, every_letter_is_different_and_keeps_to_its_box) {
  std::set<std::vector<double>> shapes;
  for (char32_t c = U'!'; c <= U'~'; ++c) {
    std::vector<double> shape;
    for (const Stroke& s : glyph_strokes(c)) {
      for (const double x : {s.x0, s.x1}) {
        EXPECT_GE(x, -0.01) << char(c);
        EXPECT_LE(x, glyph_advance(c) - kGlyphGap + 0.01) << char(c);
      }
      for (const double y : {s.y0, s.y1}) {
        EXPECT_GE(y, -0.34) << char(c);  // descenders: 4 of 12 units
        EXPECT_LE(y, 1.17) << char(c);   // 14 of 12
      }
      shape.insert(shape.end(), {s.x0, s.y0, s.x1, s.y1});
    }
    EXPECT_FALSE(shape.empty()) << char(c);
    EXPECT_TRUE(shapes.insert(shape).second) << char(c);
  }
  EXPECT_TRUE(glyph_strokes(U' ').empty());
}

TEST(font, capitals_and_digits_are_one_high) {
  for (const char32_t c : U"ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") {
    if (c == 0) break;
    double top = 0;
    for (const Stroke& s : glyph_strokes(c)) top = std::max({top, s.y0, s.y1});
    EXPECT_NEAR(top, 1, 1e-12) << char(c);
  }
}

TEST(font, takes_any_bytes) {
  EXPECT_EQ(characters("a\xC3\xA4z").size(), 3u);    // a, a-umlaut, z
  EXPECT_EQ(characters("\xE2\x82\xAC").size(), 1u);  // euro sign
  EXPECT_EQ(characters("\xFF\xC3").size(), 2u);      // invalid UTF-8 is taken byte by byte
  EXPECT_EQ(characters("\xE2\x82").size(), 2u);      // cut off
  EXPECT_EQ(characters(std::string("\0x", 2)).size(), 2u);
  EXPECT_FALSE(glyph_strokes(characters("\xC3\xA4")[0]).empty());
  EXPECT_EQ(characters("\xC3\xA4\xE2\x80\x93"), (std::vector<char32_t>{0xE4, 0x2013}));
}

TEST(font, letters_of_latin_1_have_shapes_of_their_own) {
  std::set<std::vector<double>> shapes;
  const auto shape_of = [](char32_t c) {
    std::vector<double> shape;
    for (const Stroke& s : glyph_strokes(c)) {
      for (const double x : {s.x0, s.x1}) {
        EXPECT_GE(x, -0.01) << std::uint32_t{c};
        EXPECT_LE(x, glyph_advance(c) - kGlyphGap + 0.01) << std::uint32_t{c};
      }
      shape.insert(shape.end(), {s.x0, s.y0, s.x1, s.y1});
    }
    return shape;
  };
  shapes.insert(shape_of(0xFFFD));  // the empty box
  for (char32_t c = U'A'; c <= U'z'; ++c) shapes.insert(shape_of(c));
  for (char32_t c = 0xC0; c <= 0xFF; ++c) {
    EXPECT_TRUE(shapes.insert(shape_of(c)).second) << std::uint32_t{c};
  }
}

TEST(draw_text, is_centred_and_as_wide_as_it_says) {
  const std::string text = "HIH L = 64";
  const double size = 20, thickness = kGlyphThickness * size;
  Canvas canvas = make_canvas(400, 60, kWhite);
  draw_text(canvas, text, 200, 40, size, {0, 0, 0});
  int left = 400, right = 0, top = 60, bottom = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 400; ++x) {
      if (canvas.at(x, y).r > 0.5) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  }
  EXPECT_NEAR(right - left, text_width(text, size) + thickness, 2);
  EXPECT_NEAR(left + right, 400, 2);
  EXPECT_NEAR(bottom, 40 + thickness / 2, 1);
  EXPECT_NEAR(top, 20 - thickness / 2, 1);
}

// --- Ticks ---------------------------------------------------------------------------------

std::string joined(const Ticks& ticks) {
  std::string all;
  for (const std::string& label : ticks.labels) all += (all.empty() ? "" : " ") + label;
  return all;
}

TEST(make_ticks, are_round_numbers_with_just_enough_digits) {
  EXPECT_EQ(joined(make_ticks(0, 1, 5)), "0 0.2 0.4 0.6 0.8 1.0");
  EXPECT_EQ(joined(make_ticks(-0.25, 0.2, 5)), "-0.2 -0.1 0 0.1 0.2");
  EXPECT_EQ(joined(make_ticks(0, 1.3e-5, 3)), "0 0.5e-5 1.0e-5");
  EXPECT_EQ(joined(make_ticks(0, 2.5e7, 3)), "0 1e7 2e7");
  EXPECT_EQ(joined(make_ticks(100, 101, 2)), "100.0 100.5 101.0");
  EXPECT_EQ(joined(make_ticks(0, 9000, 5)), "0 2000 4000 6000 8000");
}

TEST(make_ticks, stay_within_the_range_at_any_scale) {
  for (const double scale : {1e-300, 1e-9, 1.0, 1e9, 1e300}) {
    const Ticks ticks = make_ticks(-0.7 * scale, 2.9 * scale, 6);
    EXPECT_GE(ticks.values.size(), 2u) << scale;
    EXPECT_EQ(ticks.values.size(), ticks.labels.size());
    for (const double v : ticks.values) {
      EXPECT_GE(v, -0.7 * scale);
      EXPECT_LE(v, 2.9 * scale);
    }
  }
  EXPECT_TRUE(make_ticks(1, 1 + 2e-16, 6).values.empty());
}

}  // namespace
}  // namespace rholm
