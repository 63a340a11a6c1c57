#include "report/picture/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "report/picture/utf8.h"

namespace rholm {
namespace {

// A glyph is a width and a path on a grid. Coordinates are one base-36 digit each, x then y.
// Descenders go down to 0; the baseline is 4, small letters reach C (12), capitals G (16).
//   m xy     move            h xy   quarter of an ellipse that leaves horizontally
//   l xy     line            v xy   quarter of an ellipse that leaves vertically
//   q ab xy  parabola with control point ab (quadratic Bezier curve)
// A line of length 0 is a dot.
struct Glyph {
  int width;
  std::string_view path;
};

constexpr std::array<Glyph, 95> kGlyphs = {{
    {4, ""},                                             // space
    {0, "m0Gl08m04l04"},                                 // !
    {3, "m0Gl0Dm3Gl3D"},                                 // "
    {8, "m24l3Gm54l6Gm08l88m0Cl8C"},                     // #
    {8, "m8Dq7G4Gh0Dv4Ah87v44q1407m4Il42"},              // $
    {10, "m04lAGm2Gh0Ev2Ch4Ev2Gm88h66v84hA6v88"},        // %
    {8, "m84l1Dv3Gh5Dq5B29q0807v34q6489"},               // &
    {0, "m0Gl0D"},                                       // '
    {3, "m3Hq0E0Aq0633"},                                // (
    {3, "m0Hq3E3Aq3603"},                                // )
    {6, "m38l3Em0Dl69m09l6D"},                           // *
    {8, "m45l4Dm09l89"},                                 // +
    {1, "m14l02"},                                       // ,
    {5, "m09l59"},                                       // -
    {0, "m04l04"},                                       // .
    {6, "m03l6H"},                                       // /
    {8, "m4Gh0Cl08v44h88l8Cv4G"},                        // 0
    {8, "m1Dl5Gl54"},                                    // 1
    {8, "m0Dv4Gh8Dq8B69l04l84"},                         // 2
    {8, "m0Ev4Gh8Dv4Al3Am4Ah87v44h06"},                  // 3
    {8, "m64l6Gl08l88"},                                 // 4
    {8, "m7Gl1Gl0Aq1C4Ch88v44h06"},                      // 5
    {8, "m7Fq6G4Gh0Al08v44h88v4Ch08"},                   // 6
    {8, "m0Gl8Gl34"},                                    // 7
    {8, "m4Gh1Dv4Ah7Dv4Gm4Ah07v44h87v4A"},               // 8
    {8, "m15q2444h8Al8Cv4Gh0Cv48h8C"},                   // 9
    {0, "m0Bl0Bm04l04"},                                 // :
    {1, "m1Bl1Bm14l02"},                                 // ;
    {7, "m7El09l74"},                                    // <
    {7, "m07l77m0Bl7B"},                                 // =
    {7, "m0El79l04"},                                    // >
    {7, "m0Dv3Gl4Gh7Dq7B49l48m44l44"},                   // ?
    {12, "m6Ch39v66h99v6Cm9Cl98vB6hC9lCAv6Gh0Av63l93"},  // @
    {8, "m04l4Gl84m28l68"},                              // A
    {8, "m04l0Gl4Gh7Dv4Al0Am4Ah87v44l04"},               // B
    {9, "m9Dq8G5Gh0Av54q8497"},                          // C
    {8, "m04l0Gl3Gh8Bl89v34l04"},                        // D
    {7, "m7Gl0Gl04l74m0Al6A"},                           // E
    {7, "m7Gl0Gl04m0Al6A"},                              // F
    {9, "m9Dq8G5Gh0Av54h98l9Al6A"},                      // G
    {8, "m04l0Gm84l8Gm0Al8A"},                           // H
    {0, "m04l0G"},                                       // I
    {6, "m6Gl68v34h07"},                                 // J
    {8, "m04l0Gm8Gl08m3Bl84"},                           // K
    {7, "m0Gl04l74"},                                    // L
    {10, "m04l0Gl58lAGlA4"},                             // M
    {8, "m04l0Gl84l8G"},                                 // N
    {10, "m5Gh0Av54hAAv5G"},                             // O
    {8, "m04l0Gl4Gh8Dv4Al0A"},                           // P
    {10, "m5Gh0Av54hAAv5Gm67lA3"},                       // Q
    {8, "m04l0Gl4Gh8Dv4Al0Am4Al84"},                     // R
    {8, "m8Dq7G4Gh0Dv4Ah87v44q1407"},                    // S
    {8, "m0Gl8Gm4Gl44"},                                 // T
    {8, "m0Gl08v44h88l8G"},                              // U
    {8, "m0Gl44l8G"},                                    // V
    {12, "m0Gl34l6Gl94lCG"},                             // W
    {8, "m04l8Gm0Gl84"},                                 // X
    {8, "m0Gl4Al8Gm4Al44"},                              // Y
    {8, "m0Gl8Gl04l84"},                                 // Z
    {3, "m3Hl0Hl03l33"},                                 // [
    {6, "m0Hl63"},                                       // backslash
    {3, "m0Hl3Hl33l03"},                                 // ]
    {6, "m0Cl3Gl6C"},                                    // ^
    {7, "m02l72"},                                       // _
    {2, "m0Gl2D"},                                       // `
    {7, "m78v4Cl3Ch08v34l44h78m7Cl74"},                  // a
    {7, "m0Gl04m08v3Cl4Ch78v44l34h08"},                  // b
    {6, "m6Bq5C4Cl3Ch08v34l44q5465"},                    // c
    {7, "m7Gl74m78v4Cl3Ch08v34l44h78"},                  // d
    {7, "m08l78v4Cl3Ch08v34l44q6476"},                   // e
    {5, "m5Gl4Gh2El24m0Cl5C"},                           // f
    {7, "m78v4Cl3Ch08v34l44h78m7Cl73v40l30q1001"},       // g
    {6, "m0Gl04m08v3Ch69l64"},                           // h
    {0, "m0Cl04m0Gl0G"},                                 // i
    {3, "m3Cl32v10l00m3Gl3G"},                           // j
    {6, "m0Gl04m6Cl07m29l64"},                           // k
    {2, "m0Gl06v24"},                                    // l
    {10, "m04l0Cm09v3Ch59l54m59v8ChA9lA4"},              // m
    {6, "m04l0Cm08v3Ch69l64"},                           // n
    {7, "m3Ch08v34l44h78v4Cl3C"},                        // o
    {7, "m00l0Cm08v3Cl4Ch78v44l34h08"},                  // p
    {7, "m70l7Cm78v4Cl3Ch08v34l44h78"},                  // q
    {4, "m04l0Cm08v3Cl4C"},                              // r
    {6, "m6Bq5C3Ch0Av38h66v34q1405"},                    // s
    {5, "m2Gl26v44l54m0Cl5C"},                           // t
    {6, "m0Cl07v34h68m6Cl64"},                           // u
    {6, "m0Cl34l6C"},                                    // v
    {10, "m0Cl24l5Cl84lAC"},                             // w
    {6, "m04l6Cm0Cl64"},                                 // x
    {6, "m0Cl34m6Cl20"},                                 // y
    {6, "m0Cl6Cl04l64"},                                 // z
    {4, "m4Hh2El2Cv0Ah28l26v43"},                        // {
    {0, "m0Hl02"},                                       // |
    {4, "m0Hh2El2Cv4Ah28l26v03"},                        // }
    {8, "m09q2C4Aq688B"},                                // ~
}};
constexpr Glyph kUnknown = {7, "m04l0Gl7Gl74l04"};

// Marks above small letters, below the baseline, or across.
enum class Mark { kGrave, kAcute, kCircumflex, kTilde, kDiaeresis, kRing, kCedilla };
constexpr std::array<Glyph, 7> kMarks = {{
    {3, "m0Hl3E"},
    {3, "m0El3H"},
    {4, "m0El2Hl4E"},
    {6, "m0Eq1I3Gq5D6H"},
    {4, "m0Fl0Fm4Fl4F"},
    {4, "m2Ih0Gv2Eh4Gv2I"},
    {3, "m24l23q4331q2000"},
}};
constexpr int kRaised = 4;  // shift of marks above capitals

// Latin-1 letters that consist of another letter and a mark.
struct Marked {
  char32_t character;
  char base;
  Mark mark;
};
constexpr Marked kMarked[] = {
    {U'\u00C0', 'A', Mark::kGrave},      {U'\u00C1', 'A', Mark::kAcute},
    {U'\u00C2', 'A', Mark::kCircumflex}, {U'\u00C3', 'A', Mark::kTilde},
    {U'\u00C4', 'A', Mark::kDiaeresis},  {U'\u00C5', 'A', Mark::kRing},
    {U'\u00C7', 'C', Mark::kCedilla},    {U'\u00C8', 'E', Mark::kGrave},
    {U'\u00C9', 'E', Mark::kAcute},      {U'\u00CA', 'E', Mark::kCircumflex},
    {U'\u00CB', 'E', Mark::kDiaeresis},  {U'\u00CC', 'I', Mark::kGrave},
    {U'\u00CD', 'I', Mark::kAcute},      {U'\u00CE', 'I', Mark::kCircumflex},
    {U'\u00CF', 'I', Mark::kDiaeresis},  {U'\u00D1', 'N', Mark::kTilde},
    {U'\u00D2', 'O', Mark::kGrave},      {U'\u00D3', 'O', Mark::kAcute},
    {U'\u00D4', 'O', Mark::kCircumflex}, {U'\u00D5', 'O', Mark::kTilde},
    {U'\u00D6', 'O', Mark::kDiaeresis},  {U'\u00D9', 'U', Mark::kGrave},
    {U'\u00DA', 'U', Mark::kAcute},      {U'\u00DB', 'U', Mark::kCircumflex},
    {U'\u00DC', 'U', Mark::kDiaeresis},  {U'\u00DD', 'Y', Mark::kAcute},
    {U'\u00E0', 'a', Mark::kGrave},      {U'\u00E1', 'a', Mark::kAcute},
    {U'\u00E2', 'a', Mark::kCircumflex}, {U'\u00E3', 'a', Mark::kTilde},
    {U'\u00E4', 'a', Mark::kDiaeresis},  {U'\u00E5', 'a', Mark::kRing},
    {U'\u00E7', 'c', Mark::kCedilla},    {U'\u00E8', 'e', Mark::kGrave},
    {U'\u00E9', 'e', Mark::kAcute},      {U'\u00EA', 'e', Mark::kCircumflex},
    {U'\u00EB', 'e', Mark::kDiaeresis},  {U'\u00EC', 'i', Mark::kGrave},
    {U'\u00ED', 'i', Mark::kAcute},      {U'\u00EE', 'i', Mark::kCircumflex},
    {U'\u00EF', 'i', Mark::kDiaeresis},  {U'\u00F1', 'n', Mark::kTilde},
    {U'\u00F2', 'o', Mark::kGrave},      {U'\u00F3', 'o', Mark::kAcute},
    {U'\u00F4', 'o', Mark::kCircumflex}, {U'\u00F5', 'o', Mark::kTilde},
    {U'\u00F6', 'o', Mark::kDiaeresis},  {U'\u00F9', 'u', Mark::kGrave},
    {U'\u00FA', 'u', Mark::kAcute},      {U'\u00FB', 'u', Mark::kCircumflex},
    {U'\u00FC', 'u', Mark::kDiaeresis},  {U'\u00FD', 'y', Mark::kAcute},
    {U'\u00FF', 'y', Mark::kDiaeresis},
};
constexpr Glyph kDotlessI = {0, "m0Cl04"};

// Other letters and signs of Latin-1, dashes and the apostrophe.
struct Other {
  char32_t character;
  Glyph glyph;
};
constexpr Other kOthers[] = {
    {U'\u00A0', {4, ""}},
    {U'\u00B0', {4, "m2Hh0Fv2Dh4Fv2H"}},                                  // degree sign
    {U'\u00B1', {8, "m48l4Em0Bl8Bm04l84"}},                               // plus-minus
    {U'\u00B2', {4, "m0Fv2Hh4Fq4D0Al4A"}},                                // squared
    {U'\u00B3', {4, "m0Hl4Hl2Eh4Cv2Ah0B"}},                               // cubed
    {U'\u00B5', {6, "m0Cl00m07v34h68m6Cl64"}},                            // micro
    {U'\u00B7', {0, "m0Al0A"}},                                           // middle dot
    {U'\u00B9', {2, "m0Fl2Hl2A"}},                                        // to the first
    {U'\u00C6', {12, "m04l6GlCGm6Gl64lC4m28l68m6AlBA"}},                  // AE
    {U'\u00D0', {8, "m04l0Gl3Gh8Bl89v34l04m0Al4A"}},                      // Eth
    {U'\u00D7', {8, "m16l7Cm1Cl76"}},                                     // times
    {U'\u00D8', {10, "m5Gh0Av54hAAv5Gm13l9H"}},                           // O with a stroke
    {U'\u00DE', {8, "m04l0Gm0Dl4Dh8Av47l07"}},                            // Thorn
    {U'\u00DF', {7, "m04l0Cv3Gh6Dv3Am3Ah77v34l24"}},                      // sharp s
    {U'\u00E6', {11, "m0Bq1C2Ch58m58lB8v8Ch58v84qA4B6m58v34h06v38l58"}},  // ae
    {U'\u00F0', {7, "m78v34h08v3Ch78q7E3Hm2El6H"}},                       // eth
    {U'\u00F7', {8, "m09l89m4Dl4Dm45l45"}},                               // divided by
    {U'\u00F8', {7, "m3Ch08v34l44h78v4Cl3Cm03l7D"}},                      // o with a stroke
    {U'\u00FE', {7, "m00l0Gm08v3Cl4Ch78v44l34h08"}},                      // thorn
    {U'\u2013', {7, "m09l79"}},                                           // en dash
    {U'\u2014', {11, "m09lB9"}},                                          // em dash
    {U'\u2019', {0, "m0Gl0D"}},                                           // apostrophe
};

constexpr double kUnit = 1.0 / 12;    // of the grid, in heights of a capital
constexpr double kNarrow = 0.9 / 12;  // horizontal unit; with kUnit letters look too wide
constexpr int kBaseline = 4;
constexpr int kArcPieces = 8;  // straight segments of a curve: the error is 0.5 % of its radius

const Marked* marked_letter(char32_t c) {
  const auto* found = std::find_if(std::begin(kMarked), std::end(kMarked),
                                   [&](const Marked& m) { return m.character == c; });
  return found == std::end(kMarked) ? nullptr : found;
}

// Returns the glyph of a character; for a letter with a mark, the letter alone.
const Glyph& glyph_of(char32_t c) {
  if (c >= U' ' && c <= U'~') return kGlyphs[c - U' '];
  if (const Marked* marked = marked_letter(c)) {
    return marked->base == 'i' ? kDotlessI : kGlyphs[static_cast<std::size_t>(marked->base - ' ')];
  }
  for (const Other& other : kOthers) {
    if (other.character == c) return other.glyph;
  }
  return kUnknown;
}

const Glyph& mark_of(const Marked& marked) { return kMarks[static_cast<std::size_t>(marked.mark)]; }

// Returns the width with room for the mark.
int width_of(char32_t c) {
  const Marked* marked = marked_letter(c);
  return std::max(glyph_of(c).width, marked ? mark_of(*marked).width : 0);
}

struct Point {
  double x = 0;
  double y = 0;
};

double digit(char c) { return c <= '9' ? c - '0' : c - 'A' + 10; }

// Reads a path and emits its straight segments.
class PathReader {
 public:
  explicit PathReader(std::string_view path) : path_(path) {}
  std::vector<Stroke> strokes() {
    while (next_ < path_.size()) {
      const char command = path_[next_++];
      const Point control = command == 'q' ? point() : Point{};
      const Point from = pen_, to = point();
      pen_ = to;
      switch (command) {
        case 'l':
          curve(from, 1, [&](double t) { return t < 1 ? from : to; });
          break;
        case 'q':
          curve(from, kArcPieces, [&](double t) {
            const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
            return Point{a * from.x + b * control.x + c * to.x,
                         a * from.y + b * control.y + c * to.y};
          });
          break;
        case 'h':
        case 'v':
          curve(from, kArcPieces, [&](double t) {
            const double s = std::sin(t * std::numbers::pi / 2);
            const double c = 1 - std::cos(t * std::numbers::pi / 2);
            const double fx = command == 'h' ? s : c, fy = command == 'h' ? c : s;
            return Point{from.x + fx * (to.x - from.x), from.y + fy * (to.y - from.y)};
          });
          break;
        default:  // 'm'
          break;
      }
    }
    return std::move(strokes_);
  }

 private:
  Point point() {
    const Point p = {kNarrow * digit(path_[next_]), kUnit * (digit(path_[next_ + 1]) - kBaseline)};
    next_ += 2;
    return p;
  }
  template <typename Curve>
  void curve(Point from, int pieces, const Curve& at) {
    for (int k = 1; k <= pieces; ++k) {
      const Point to = at(static_cast<double>(k) / pieces);
      strokes_.push_back({from.x, from.y, to.x, to.y});
      from = to;
    }
  }
  std::string_view path_;
  std::size_t next_ = 0;
  Point pen_;
  std::vector<Stroke> strokes_;
};

// Returns the code point of a character of `length` bytes.
char32_t code_point(std::string_view text, std::size_t length) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (length == 1) return byte(0);
  char32_t code = byte(0) & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte(i) & 0x3Fu);
  return code;
}

}  // namespace

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    result.push_back(length == 0 ? U'\uFFFD' : code_point(text, length));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

double glyph_advance(char32_t character) { return kNarrow * width_of(character) + kGlyphGap; }

std::vector<Stroke> glyph_strokes(char32_t character) {
  const Glyph& glyph = glyph_of(character);
  const auto shifted = [&](const Glyph& part, double up) {
    std::vector<Stroke> strokes = PathReader(part.path).strokes();
    const double right = 0.5 * kNarrow * (width_of(character) - part.width);
    for (Stroke& s : strokes) s.x0 += right, s.x1 += right, s.y0 += up, s.y1 += up;
    return strokes;
  };
  std::vector<Stroke> strokes = shifted(glyph, 0);
  if (const Marked* marked = marked_letter(character)) {
    const bool raised = marked->base <= 'Z' && marked->mark != Mark::kCedilla;
    const std::vector<Stroke> mark = shifted(mark_of(*marked), raised ? kRaised * kUnit : 0);
    strokes.insert(strokes.end(), mark.begin(), mark.end());
  }
  return strokes;
}

}  // namespace rholm
