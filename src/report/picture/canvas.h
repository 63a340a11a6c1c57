// Canvas in linear light, on which lines and text are drawn.
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

// Pixel (i, j) covers [i, i+1) x [j, j+1); y points down. The drawing is
// antialiased; overlapping strokes of one call do not darken each other.
void draw_strokes(Canvas& canvas, const std::vector<Stroke>& strokes, double thickness,
                  const Color& color);

// `size` is the height of capitals in pixels; the text is UTF-8.
// Characters missing in the font (see font.h) are drawn as an empty box.
double text_width(std::string_view text, double size);
// Draws text centred at x, with its baseline at y.
void draw_text(Canvas& canvas, std::string_view text, double x, double y, double size,
               const Color& color);

}  // namespace rholm
