// SHTOOLS text: a line `l m C S` per pair, with fields between blanks or commas. Lines that begin
// with '#' are comments (pyshtools skips them; the Fortran routine needs their number in `skip`).
// Comments `# key: value` with a known key state what the numbers mean.
#include <fmt/format.h>

#include <optional>

#include "base/cancel.h"
#include "base/plain_text.h"
#include "io/coefficients/codec.h"
#include "io/coefficients/text_table.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::string_view kFormat = "rholm-coefficients 1";

struct State {
  ParsedCoefficients parsed;
  CoefficientTable table;
  std::optional<int> degree;
  std::optional<int> lines;
};

void take_comment(const TextLine& line, State& state) {
  const std::string_view content = trimmed(line.content).substr(1);
  const std::size_t colon = content.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view key = trimmed(content.substr(0, colon));
  const std::string_view value = trimmed(content.substr(colon + 1));
  if (key == "format" && value.starts_with("rholm-") && value != kFormat) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{}: the format is {}, this version reads '{}'", *line.name,
                            in_quotes(value), kFormat));
  }
  if (key == "degree") {
    set_once(state.degree, parse_count(value, "degree", kMaxDegree, line), key, line);
  } else if (key == "lines") {
    const auto most = static_cast<int>(n_pairs(kMaxDegree));
    set_once(state.lines, parse_count(value, "lines", most, line), key, line);
  } else if (key == "normalization") {
    if (value != "4pi" && value != "orthonormal" && value != "schmidt") {
      refuse_line(line, "normalization is " + in_quotes(value) +
                            ": it must be 4pi, orthonormal or schmidt");
    }
    set_once(state.parsed.normalization, parse_name<Normalization>(std::string(value)), key, line);
  } else {
    take_description(key, value, line, state.parsed);
  }
}

}  // namespace

bool is_own_shtools(std::string_view bytes) {
  return trimmed(bytes.substr(0, kHeaderBytes)).starts_with("# format: rholm-coefficients");
}

ParsedCoefficients parse_shtools(std::string_view bytes, const std::string& name) {
  State state;
  TextCursor text{bytes};
  const auto take = [&](const TextLine& line, std::span<const std::string_view> fields) {
    if (fields[0].starts_with('#')) {
      take_comment(line, state);
    } else if (fields[0].find_first_not_of("+-0123456789") != std::string_view::npos) {
      refuse_line(line, "it begins with " + in_quotes(fields[0]) +
                            ", not with a degree: put '#' before lines that are no coefficients");
    } else {
      state.table.add(fields, line);
    }
  };
  const bool last_line_complete = visit_lines(text, name, take);
  check_line_count(state.lines, state.table, last_line_complete, name);
  state.parsed.external = state.table.assemble(state.degree, name);
  return state.parsed;
}

std::string format_shtools(const Expansion& expansion, const Coefficients& external,
                           const Convention& convention) {
  const int degree = external.degree();
  std::string text = fmt::format(
      "# format: {}\n# columns: l m C S\n# degree: {}\n# lines: {}\n"
      "# normalization: {}\n# csphase: {}\n",
      kFormat, degree, n_pairs(degree), to_string(convention.normalization), convention.csphase);
  for (const auto& [key, value] : describe(expansion))
    text += fmt::format("# {}: {}\n", key, value);
  CancelPoll poll;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      poll();
      append_pair(text, l, m, external);
    }
  }
  return text;
}

}  // namespace rholm
