#include "report/picture/scale_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Heights in units of a capital's height.
constexpr double kBar = 0.9, kTick = 0.4, kGap = 0.55, kTitleGap = 0.9;
const Color kInk = {0.03f, 0.03f, 0.035f};

// Returns the smallest of 1, 2, 5 times a power of ten that is at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - 1e-12)) return factor * power;
  }
  return 10 * power;
}

// Returns a label with the decimals that multiples of `step` need, as 0.25 or 1.5e-3.
std::string tick_label(double value, double step, double largest) {
  const int order = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  const int step_order = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  if (std::abs(value) < step / 2) return "0";
  if (order >= -3 && order <= 4) return fmt::format("{:.{}f}", value, std::max(0, -step_order));
  return fmt::format("{:.{}f}e{}", value / std::pow(10.0, order),
                     std::clamp(order - step_order, 0, 15), order);
}

}  // namespace

Ticks make_ticks(double min, double max, int wanted) {
  Ticks ticks;
  const double step = round_step((max / wanted - min / wanted));
  const double largest = std::max(std::abs(min), std::abs(max));
  // Below this bound neighbouring ticks are the same double.
  if (!(step > 4e-16 * largest) || !std::isfinite(step)) return ticks;
  const double first = std::ceil(min / step - 1e-9);
  for (int k = 0; k <= 2 * wanted; ++k) {
    const double value = (first + k) * step;
    if (value > max + 1e-9 * step) break;
    ticks.values.push_back(std::clamp(value, min, max));
    ticks.labels.push_back(tick_label(value, step, largest));
  }
  return ticks;
}

double scale_bar_height(double size, const std::string& title) {
  const double without = kBar + kTick + kGap + 1;
  return (title.empty() ? without : without + kTitleGap + 1.4) * size;
}

void draw_scale_bar(Canvas& canvas, const ColorScale& scale, const std::string& title, double x,
                    double y, double width, double size) {
  const int left = std::clamp(static_cast<int>(x - width / 2), 0, canvas.width);
  const int right = std::clamp(static_cast<int>(x + width / 2), left, canvas.width);
  const int top = std::clamp(static_cast<int>(y), 0, canvas.height);
  const int bottom = std::clamp(static_cast<int>(y + kBar * size), top, canvas.height);
  const double n = std::max(1, right - left);
  for (int j = top; j < bottom; ++j) {
    for (int i = left; i < right; ++i) {
      const double t = (i + 0.5 - left) / n;
      canvas.at(i, j) = scale.color((1 - t) * scale.min + t * scale.max);
    }
  }
  const Ticks ticks = make_ticks(scale.min, scale.max, 6);
  const double thickness = std::max(1.0, 0.09 * size);
  for (std::size_t k = 0; k < ticks.values.size(); ++k) {
    const double part =
        ticks.values[k] / (scale.max - scale.min) - scale.min / (scale.max - scale.min);
    const double at = left + part * n;
    draw_strokes(canvas, {{at, double(bottom), at, bottom + kTick * size}}, thickness, kInk);
    draw_text(canvas, ticks.labels[k], at, bottom + (kTick + kGap + 1) * size, size, kInk);
  }
  draw_text(canvas, title, x, bottom + (kTick + kGap + kTitleGap + 2.1) * size, size, kInk);
}

}  // namespace rholm
