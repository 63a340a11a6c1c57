// The program rholm with a format of shapes and a format of coefficients that are made up here: a
// reader, a writer and a line of a table each. formats_test.py looks for both in every face of the
// program.
//
// This program is linked without the sources of the two tables. They are taken in below, and a line
// is added to each.
#define shape_format_lines known_shape_format_lines
#include "io/shapes/shape_formats.cpp"
#undef shape_format_lines
#define coefficients_format_lines known_coefficients_format_lines
#include "io/coefficients/coefficients_formats.cpp"
#undef coefficients_format_lines

#include "cli/program.h"
#include "cli/terminal/interrupt.h"

namespace rholm {
namespace {

// MADE: OFF behind a line of its own.
constexpr std::string_view kMade = "MADE\n";

bool looks_like_made(std::span<const char> bytes) {
  return std::string_view(bytes.data(), bytes.size()).starts_with(kMade);
}

ShapeFile read_made(const ShapeSource& source) {
  ShapeSource rest = source;
  rest.bytes = rest.bytes.subspan(kMade.size());
  ShapeFile file = read_off(rest);
  file.format = static_cast<ShapeFormat>(100);
  return file;
}

std::vector<std::string> format_made(const ShapeView& shape, const ShapeWriting& how,
                                     OutputBuffer& out) {
  out.text(kMade);
  return format_off(shape, how, out);
}

// FANCY: SHTOOLS text behind a line of its own.
constexpr std::string_view kFancy = "FANCY\n";

bool looks_like_fancy(std::string_view bytes) { return bytes.starts_with(kFancy); }

ParsedCoefficients parse_fancy(std::string_view bytes, const std::string& name) {
  return parse_shtools(bytes.substr(kFancy.size()), name);
}

std::string format_fancy(const Expansion& expansion, const Coefficients& external,
                         const Convention& convention) {
  return std::string(kFancy) + format_shtools(expansion, external, convention);
}

}  // namespace

std::vector<ShapeFormatLine> shape_format_lines() {
  std::vector<ShapeFormatLine> lines = known_shape_format_lines();
  lines.push_back({.info = {.format = static_cast<ShapeFormat>(100),
                            .file = {.name = "made",
                                     .title = "MADE",
                                     .extensions = {{"mad"}, {"made"}},
                                     .text = true,
                                     .help = "A format of shapes that only this test has"},
                            .faces = true,
                            .normals = true},
                   .mark = "MADE",
                   .told_by = ToldBy::kFirstWord,
                   .looks_like = looks_like_made,
                   .read = read_made,
                   .write = format_made});
  return lines;
}

std::vector<CoefficientsFormatLine> coefficients_format_lines() {
  std::vector<CoefficientsFormatLine> lines = known_coefficients_format_lines();
  lines.push_back({.info = {.format = static_cast<CoefficientsFormat>(100),
                            .file = {.name = "fancy",
                                     .title = "FANCY",
                                     .extensions = {{"fcy"}},
                                     .text = true,
                                     .help = "A format of coefficients that only this test has"},
                            .meaning = true},
                   .told_by = ToldBy::kFirstWord,
                   .looks_like = looks_like_fancy,
                   .is_surely = looks_like_fancy,
                   .parse = parse_fancy,
                   .write = format_fancy});
  return lines;
}

}  // namespace rholm

int main(int argc, char** argv) {
  rholm::cli::install_signal_handlers();
  return rholm::cli::run_program({argv + 1, argv + argc});
}
