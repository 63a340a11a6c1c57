// Bar with the colours of a scale, ticks, numbers and a title.
#pragma once

#include <string>
#include <vector>

#include "report/picture/canvas.h"

namespace rholm {

// Round numbers (1, 2 or 5 times a power of ten apart) within min ... max, at most about
// `wanted` + 1. There are at least two if max - min exceeds the rounding of the numbers.
struct Ticks {
  std::vector<double> values;
  std::vector<std::string> labels;
};
Ticks make_ticks(double min, double max, int wanted);

// Returns the height of the whole bar for text with capitals of `size` pixels.
double scale_bar_height(double size, const std::string& title);

// Draws the bar centred at x, from y downwards.
void draw_scale_bar(Canvas& canvas, const ColorScale& scale, const std::string& title, double x,
                    double y, double width, double size);

}  // namespace rholm
