#include "surface/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "surface/utf8.h"

namespace rholm {
namespace {

// A glyph is a width and a path on a grid. Coordinates are one base-36 digit each, x then y;
// descenders reach down to 0, the baseline is 4, small letters reach C (12), capitals G (16).
//   m xy     move            h xy   quarter of an ellipse that leaves horizontally
//   l xy     line            v xy   quarter of an ellipse that leaves vertically
//   q ab xy  parabola with control point ab (quadratic Bezier curve)
// A line of no length is a dot.
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

constexpr double kUnit = 1.0 / 12;    // of the grid, in heights of a capital
constexpr double kNarrow = 0.9 / 12;  // the same across: the letters look too wide without
constexpr int kBaseline = 4;
constexpr int kArcPieces = 8;  // straight pieces of a curve: off by 0.5 % of its radius

const Glyph& glyph_of(char32_t c) { return c >= U' ' && c <= U'~' ? kGlyphs[c - U' '] : kUnknown; }

struct Point {
  double x = 0;
  double y = 0;
};

double digit(char c) { return c <= '9' ? c - '0' : c - 'A' + 10; }

// Reads a path and emits its straight pieces.
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

}  // namespace

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    result.push_back(length == 1 ? static_cast<char32_t>(text[0]) : U'\uFFFD');
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

double glyph_advance(char32_t character) { return kNarrow * glyph_of(character).width + kGlyphGap; }

std::vector<Stroke> glyph_strokes(char32_t character) {
  return PathReader(glyph_of(character).path).strokes();
}

}  // namespace rholm
