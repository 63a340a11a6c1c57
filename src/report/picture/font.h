// The lettering of the pictures: a stroke font of lines and arcs, drawn for this project.
#pragma once

#include <string_view>
#include <vector>

namespace rholm {

// A line with round ends.
struct Stroke {
  double x0, y0, x1, y1;
};

// Lengths in heights of a capital; y points up from the baseline.
inline constexpr double kGlyphThickness = 0.14;
inline constexpr double kGlyphGap = 0.28;  // between neighbours' middle lines

// The characters of UTF-8 text; bytes that are not UTF-8 count one by one, as U+FFFD. There are
// glyphs for ASCII, the letters and some signs of Latin-1, dashes and the apostrophe; all others
// have that of an empty box.
std::vector<char32_t> characters(std::string_view text);

double glyph_advance(char32_t character);  // width and gap
std::vector<Stroke> glyph_strokes(char32_t character);

}  // namespace rholm
