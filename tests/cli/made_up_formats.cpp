// The program rholm with a made-up format of shapes and a made-up format of coefficients. Each has
// a reader, a writer and a line of a table. formats_test.py checks that all parts of the program
// have both formats.
//
// This program is linked without the sources of the two tables. These sources are included below,
// with one more line in each table.
#include "cli/program.h"
#include "cli/terminal/interrupt.h"
#include "io/coefficients/coefficients_formats.h"
#include "io/shapes/shape_formats.h"

namespace rholm {
namespace {

// MADE: an OFF file after a first line.
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

// FANCY: an SHTOOLS text after a first line.
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

}  // namespace rholm

#define RHOLM_EXTRA_SHAPE_FORMATS "cli/made_up_shape_format.inc"
#define RHOLM_EXTRA_COEFFICIENTS_FORMATS "cli/made_up_coefficients_format.inc"
// NOLINTBEGIN(bugprone-suspicious-include): the tables themselves, with a line more
#include "io/coefficients/coefficients_formats.cpp"
#include "io/shapes/shape_formats.cpp"
// NOLINTEND(bugprone-suspicious-include)

int main(int argc, char** argv) {
  rholm::cli::install_signal_handlers();
  return rholm::cli::run_program({argv + 1, argv + argc});
}
