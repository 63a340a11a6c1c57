// A bar of the colours of a scale with ticks, numbers and a title.
#pragma once

#include <string>
#include <vector>

#include "report/picture/canvas.h"

namespace rholm {

// Round numbers (1, 2 or 5 times a power of ten apart) within min ... max, at least two if max -
// min is not lost in the rounding of the numbers, at most about `wanted` + 1.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
};
Ticks make_ticks(double min, double max, int wanted);

// Height of the whole bar for text of capitals of `size` pixels.
double scale_bar_height(double size, const std::string& title);

// Centred at x, from y downwards.
void draw_scale_bar(Canvas& canvas, const ColorScale& scale, const std::string& title, double x,
                    double y, double width, double size);

}  // namespace rholm
