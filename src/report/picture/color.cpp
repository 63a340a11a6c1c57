#include "report/picture/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {
namespace {

// Sequential: lightness and hue run linearly at constant chroma, a helix like that of Green 2011
// ("cubehelix") but in Oklab, so that its speed is constant. From violet through teal to yellow;
// chosen: the largest chroma that stays within sRGB all the way.
constexpr double kDarkest = 0.34, kLightest = 0.92;
constexpr double kFirstHue = 300, kLastHue = 105;
constexpr double kHelixChroma = 0.095;

// Diverging: two straight lines in Oklab from a near-white to blue and to red of equal lightness;
// the ends chosen just within sRGB.
constexpr double kMiddle = 0.95, kEnd = 0.50;
constexpr double kBlueHue = 255, kRedHue = 28, kEndChroma = 0.155;

Color sequential(double t) {
  return from_oklch(kDarkest + t * (kLightest - kDarkest), kHelixChroma,
                    kFirstHue + t * (kLastHue - kFirstHue));
}

Color diverging(double t) {  // -1 ... 1
  const double a = std::abs(t);
  return from_oklch(kMiddle + a * (kEnd - kMiddle), a * kEndChroma, t < 0 ? kBlueHue : kRedHue);
}

}  // namespace

Color from_oklch(double lightness, double chroma, double hue_degrees) {
  const double hue = hue_degrees * (std::numbers::pi / 180);
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  // The matrices of the source.
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

float from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t to_srgb_byte(float linear) {
  if (linear >= 1) return 255;  // paper
  const float x = std::max(linear, 0.0f);
  const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

Color ColorScale::color(double value) const {
  const double x = std::clamp(value, min, max);
  if (diverging()) return rholm::diverging(x / std::max(-min, max));
  return sequential(max > min ? (x / (max - min) - min / (max - min)) : 0);
}

}  // namespace rholm
