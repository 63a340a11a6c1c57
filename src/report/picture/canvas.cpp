#include "report/picture/canvas.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

double distance_to_stroke(const Stroke& s, double x, double y) {
  const double ex = s.x1 - s.x0, ey = s.y1 - s.y0, length2 = ex * ex + ey * ey;
  double t = 0;
  if (length2 > 0) t = std::clamp(((x - s.x0) * ex + (y - s.y0) * ey) / length2, 0.0, 1.0);
  return std::hypot(x - s.x0 - t * ex, y - s.y0 - t * ey);
}

// Whole pixels from floor(low) to ceil(high), within 0 ... size.
struct PixelRange {
  int begin, end;
};
PixelRange pixel_range(double low, double high, int size) {
  const double n = size;
  return {static_cast<int>(std::clamp(std::floor(low), 0.0, n)),
          static_cast<int>(std::clamp(std::ceil(high), 0.0, n))};
}

}  // namespace

Canvas make_canvas(int width, int height, const Color& background) {
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {width, height, std::vector<Color>(n, background)};
}

Image to_image(const Canvas& canvas) {
  Image image{canvas.width, canvas.height, std::vector<std::uint8_t>(3 * canvas.pixels.size())};
  auto byte = image.rgb.begin();
  for (const Color& c : canvas.pixels) {
    for (const float x : {c.r, c.g, c.b}) *byte++ = to_srgb_byte(x);
  }
  return image;
}

void draw_strokes(Canvas& canvas, const std::vector<Stroke>& strokes, double thickness,
                  const Color& color) {
  if (strokes.empty()) return;
  const double reach = thickness / 2 + 0.5;
  double left = strokes[0].x0, right = left, top = strokes[0].y0, bottom = top;
  for (const Stroke& s : strokes) {
    left = std::min({left, s.x0, s.x1});
    right = std::max({right, s.x0, s.x1});
    top = std::min({top, s.y0, s.y1});
    bottom = std::max({bottom, s.y0, s.y1});
  }
  const PixelRange columns = pixel_range(left - reach, right + reach, canvas.width);
  const PixelRange rows = pixel_range(top - reach, bottom + reach, canvas.height);
  for (int y = rows.begin; y < rows.end; ++y) {
    for (int x = columns.begin; x < columns.end; ++x) {
      double nearest = reach;
      for (const Stroke& s : strokes) {
        nearest = std::min(nearest, distance_to_stroke(s, x + 0.5, y + 0.5));
      }
      // Share of a pixel that a straight edge at this distance covers.
      const auto cover = static_cast<float>(std::clamp(reach - nearest, 0.0, 1.0));
      Color& pixel = canvas.at(x, y);
      pixel = (1 - cover) * pixel + cover * color;
    }
  }
}

double text_width(std::string_view text, double size) {
  double width = 0;
  for (const char32_t c : characters(text)) width += glyph_advance(c);
  return std::max(0.0, width - kGlyphGap) * size;
}

void draw_text(Canvas& canvas, std::string_view text, double x, double y, double size,
               const Color& color) {
  double pen = x - text_width(text, size) / 2;
  for (const char32_t c : characters(text)) {
    std::vector<Stroke> strokes = glyph_strokes(c);
    for (Stroke& s : strokes) {
      s = {pen + s.x0 * size, y - s.y0 * size, pen + s.x1 * size, y - s.y1 * size};
    }
    draw_strokes(canvas, strokes, std::max(1.0, kGlyphThickness * size), color);
    pen += glyph_advance(c) * size;
  }
}

}  // namespace rholm
