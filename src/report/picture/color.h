// Colours in linear light, and the two colour maps of the pictures.
#pragma once

#include <cstdint>

namespace rholm {

struct Color {  // linear light with the primaries of sRGB, 0 ... 1
  float r = 0;
  float g = 0;
  float b = 0;
};
inline Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Color operator*(float s, const Color& a) { return {s * a.r, s * a.g, s * a.b}; }

// From Oklab's lightness (0 ... 1), chroma and hue (degrees): Ottosson 2020, "A perceptual color
// space for image processing". Not clipped: components may leave 0 ... 1.
Color from_oklch(double lightness, double chroma, double hue_degrees);

// The linear component of an sRGB encoded one, 0 ... 1.
float from_srgb(float encoded);

// The byte of the sRGB encoding (IEC 61966-2-1) of a linear component; clipped.
std::uint8_t to_srgb_byte(float linear);

// What range of values the colours stand for. A range with 0 inside is shown by a diverging map
// whose neutral middle is 0, any other by a sequential one from dark to light. Along either map
// equal steps of the value are equal steps in Oklab, and lightness is monotonic on each side.
struct ColorScale {
  double min = 0;
  double max = 1;
  bool diverging() const { return min < 0 && max > 0; }
  Color color(double value) const;  // values outside the range get the colour of its end
};

}  // namespace rholm
