// A picture in the making: linear light, with lines and text drawn over it.
#pragma once

#include <string_view>
#include <vector>

#include "report/picture/color.h"
#include "report/picture/font.h"
#include "rholm/image.h"

namespace rholm {

struct Canvas {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;  // row-major from the top left
  Color& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

Canvas make_canvas(int width, int height, const Color& background);
Image to_image(const Canvas& canvas);

// Pixel (i, j) covers [i, i+1) x [j, j+1); y points down. Antialiased; strokes of one call do not
// darken each other where they overlap.
void draw_strokes(Canvas& canvas, const std::vector<Stroke>& strokes, double thickness,
                  const Color& color);

// `size` is the height of capitals in pixels. UTF-8; what the font does not have (see font.h) is
// drawn as an empty box.
double text_width(std::string_view text, double size);
// Centred at x, with its baseline at y.
void draw_text(Canvas& canvas, std::string_view text, double x, double y, double size,
               const Color& color);

}  // namespace rholm
