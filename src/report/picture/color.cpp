#include "report/picture/color.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace rholm {
namespace {

// Sequential map: lightness and hue run linearly at constant chroma, a helix like
// "cubehelix" (Green 2011), but in Oklab, so that its speed is constant. It runs from
// violet through teal to yellow. Chosen: the largest chroma that stays within sRGB.
constexpr double kDarkest = 0.34, kLightest = 0.92;
constexpr double kFirstHue = 300, kLastHue = 105;
constexpr double kHelixChroma = 0.095;

// Diverging map: two straight lines in Oklab from a near-white to blue
// and to red of equal lightness. The ends are chosen just within sRGB.
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

// Table of a map at equal steps, interpolated linearly. The error is an eighth of a
// step's square times second derivatives. These are below 8 in linear light (by
// differences), so the error is 2e-5: a twentieth of a byte where bytes are densest.
class Steps {
 public:
  explicit Steps(Color (*map)(double)) {
    for (int k = 0; k <= kSteps; ++k) colors_[k] = map(static_cast<double>(k) / kSteps);
  }
  Color at(double t) const {  // 0 ... 1
    const int k = std::min(static_cast<int>(t * kSteps), kSteps - 1);
    const auto rest = static_cast<float>(t * kSteps - k);
    return (1 - rest) * colors_[k] + rest * colors_[k + 1];
  }

 private:
  static constexpr int kSteps = 256;
  std::array<Color, kSteps + 1> colors_;
};

}  // namespace

Color from_oklch(double lightness, double chroma, double hue_degrees) {
  const double hue = hue_degrees * (std::numbers::pi / 180);
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  // These matrices are from the source.
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

// Uses a table instead of powers, indexed by the exponent and kBits of the mantissa. From
// 2^-kOctaves on, below half a byte, a step holds at most one change of the byte. The curve
// has at most 255 * 1.055 / 2.4 = 112 bytes per factor of e, a step at most 2^-kBits of that.
std::uint8_t to_srgb_byte(float linear) {
  constexpr int kBits = 8, kOctaves = 13, kShift = std::numeric_limits<float>::digits - 1 - kBits;
  constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(0x1p-13f) >> kShift;
  struct Table {
    std::array<float, 257> least;
    std::array<std::uint8_t, kOctaves << kBits> byte = {};
    Table() {
      for (std::size_t b = 0; b < least.size(); ++b) {
        least[b] = from_srgb((static_cast<float>(b) - 0.5f) / 255);
      }
      for (std::uint32_t k = 0; k < byte.size(); ++k) {
        const auto at = std::bit_cast<float>((kFirst + k) << kShift);
        byte[k] = static_cast<std::uint8_t>(std::upper_bound(least.begin(), least.end(), at) -
                                            least.begin() - 1);
      }
    }
  };
  static const Table table;
  if (linear >= 1) return 255;  // white paper
  if (!(linear >= 0x1p-13f)) return 0;
  const std::uint8_t byte = table.byte[(std::bit_cast<std::uint32_t>(linear) >> kShift) - kFirst];
  return static_cast<std::uint8_t>(byte + (linear >= table.least[byte + 1u]));
}

Color ColorScale::color(double value) const {
  const double x = std::clamp(value, min, max);
  if (diverging()) {
    static const Steps low([](double t) { return rholm::diverging(-t); });
    static const Steps high(rholm::diverging);
    return (x < 0 ? low : high).at(std::abs(x) / std::max(-min, max));
  }
  static const Steps steps(sequential);
  return steps.at(max > min ? std::clamp(x / (max - min) - min / (max - min), 0.0, 1.0) : 0);
}

}  // namespace rholm
