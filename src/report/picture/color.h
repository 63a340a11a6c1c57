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

// Converts from Oklab's lightness (0 ... 1), chroma and hue (degrees): Ottosson 2020, "A
// perceptual color space for image processing". Components are not clipped to 0 ... 1.
Color from_oklch(double lightness, double chroma, double hue_degrees);

// Returns the linear component of an sRGB encoded one, 0 ... 1.
float from_srgb(float encoded);

// Returns the byte of the sRGB encoding (IEC 61966-2-1) of a linear component; clipped.
std::uint8_t to_srgb_byte(float linear);

// Range of values that the colours represent. A range with 0 inside has a diverging map
// with 0 as neutral middle; other ranges have a sequential map from dark to light. Equal
// steps of the value are equal steps in Oklab, and lightness is monotonic on each side.
struct ColorScale {
  double min = 0;
  double max = 1;
  bool diverging() const { return min < 0 && max > 0; }
  Color color(double value) const;  // values outside the range get the colour of its end
};

}  // namespace rholm
