// Stroke font of lines and arcs for the pictures, drawn for this project.
#pragma once

#include <string_view>
#include <vector>

namespace rholm {

// Line with round ends.
struct Stroke {
  double x0, y0, x1, y1;
};

// Lengths are in heights of a capital; y points up from the baseline.
inline constexpr double kGlyphThickness = 0.14;
inline constexpr double kGlyphGap = 0.28;  // between the middle lines of neighbours

// Returns the characters of UTF-8 text; each byte that is not UTF-8 becomes
// U+FFFD. There are glyphs for ASCII, letters and some signs of Latin-1, dashes
// and the apostrophe. All other characters have the glyph of an empty box.
std::vector<char32_t> characters(std::string_view text);

double glyph_advance(char32_t character);  // width and gap
std::vector<Stroke> glyph_strokes(char32_t character);

}  // namespace rholm
