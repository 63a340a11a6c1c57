#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "rholm/render.h"

namespace rholm {
namespace {

// Returns true if every element is closed in order, without bare & or control characters.
bool is_balanced(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag[0] == '?' || tag.back() == '/') continue;
    if (tag[0] != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    } else {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

double number_after(const std::string& text, const std::string& key, std::size_t from) {
  return std::strtod(text.c_str() + text.find(key, from) + key.size(), nullptr);
}

// Returns zonal coefficients with the given energy per degree.
template <typename Energy>
Expansion with_energy(int degree, const Energy& energy) {
  Expansion expansion;
  expansion.coefficients = Coefficients(degree);
  expansion.coefficients.c(0, 0) = 3;
  for (int l = 1; l <= degree; ++l) expansion.coefficients.c(l, 0) = std::sqrt(energy(l));
  return expansion;
}

// A spectrum that equals its predicted tail: all points of the curve lie on the dashed line.
// Coordinates are printed to 0.01.
TEST(spectrum_svg, a_spectrum_that_is_the_tail_lies_on_the_straight_line) {
  const double strength = 5;
  Expansion expansion =
      with_energy(60, [&](double l) { return strength / (std::numbers::pi * l * l * l * l); });
  expansion.tail_strength = strength;
  const std::string svg = spectrum_svg(expansion, "tail");
  const std::size_t dash = svg.rfind("<line", svg.find("stroke-dasharray"));
  const double x1 = number_after(svg, " x1=\"", dash), y1 = number_after(svg, " y1=\"", dash);
  const double x2 = number_after(svg, " x2=\"", dash), y2 = number_after(svg, " y2=\"", dash);
  ASSERT_GT(x2, x1 + 100);
  int points = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    const double x = number_after(svg, "cx=\"", at), y = number_after(svg, "cy=\"", at);
    EXPECT_NEAR(y, y1 + (x - x1) / (x2 - x1) * (y2 - y1), 0.03);
    ++points;
  }
  EXPECT_EQ(points, 60);
}

TEST(spectrum_svg, degrees_without_energy_are_marked_and_named) {
  const Expansion even = with_energy(20, [](int l) { return l % 2 ? 0.0 : 1.0 / l; });
  const std::string svg = spectrum_svg(even, "ellipsoid");
  EXPECT_TRUE(is_balanced(svg));
  EXPECT_NE(svg.find("10 of 20 degrees"), std::string::npos);
  EXPECT_EQ(count(svg, "<circle"), 10u);
}

TEST(spectrum_svg, is_a_document_for_every_expansion) {
  const double huge = 1e200;
  std::vector<Expansion> all = {Expansion{},
                                with_energy(0, [](int) { return 0.0; }),
                                with_energy(1, [](int) { return 1.0; }),
                                with_energy(5, [](int) { return 0.0; }),
                                with_energy(300, [](int l) { return std::exp(-l); }),
                                with_energy(4, [&](int) { return huge * huge; }),  // infinite
                                with_energy(4, [](int) { return std::nan(""); }),
                                with_energy(4, [](int l) { return l == 2 ? 1.7e308 : 1.0; }),
                                with_energy(4, [](int) { return 1e-320; })};
  all[3].coefficients.c(0, 0) = 0;
  for (Expansion& expansion : all) {
    for (const double strength : {0.0, 1.0, 1e-300, 1e300, std::nan("")}) {
      expansion.tail_strength = strength;
      const std::string svg = spectrum_svg(expansion, "title");
      EXPECT_TRUE(is_balanced(svg));
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_EQ(svg.find("inf"), std::string::npos);
      EXPECT_LT(svg.size(), 200000u);
    }
  }
}

TEST(spectrum_svg, escapes_title_and_unit) {
  Expansion expansion = with_energy(3, [](int) { return 1.0; });
  expansion.unit = "<m>";
  const std::string svg = spectrum_svg(expansion, "a < b & \"c\" > d \x01\xFF\xC3\xA4");
  EXPECT_TRUE(is_balanced(svg));
  EXPECT_NE(svg.find("a &lt; b &amp; \"c\" &gt; d ??\xC3\xA4"), std::string::npos);
  EXPECT_NE(svg.find("&lt;m&gt;"), std::string::npos);
}

TEST(spectrum_svg, says_which_function_it_shows) {
  Expansion expansion = with_energy(3, [](int) { return 1.0; });
  EXPECT_NE(spectrum_svg(expansion, "").find("radius r"), std::string::npos);
  expansion.function = RadialFunction::kGauge;
  EXPECT_NE(spectrum_svg(expansion, "").find("gauge 1/r"), std::string::npos);
}

}  // namespace
}  // namespace rholm
