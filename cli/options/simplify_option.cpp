#include "cli/options/simplify_option.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"

namespace rholm::cli {

Option simplify_option(std::string& text, const char* by_default) {
  return {.name = "simplify",
          .value = "auto|N|P%|none",
          .help = fmt::format("reduce the faces of the surface to N, to P per cent, or to as few "
                              "as hardly change it (auto); {}",
                              by_default),
          .target = &text,
          .check = parse_simplify};
}

std::optional<SimplifyOptions> parse_simplify(const std::string& option, const std::string& text) {
  if (text == kNotSimplified) return std::nullopt;
  if (text == "auto") return SimplifyOptions{};
  const bool per_cent = text.ends_with('%');
  const auto number = read_number(per_cent ? text.substr(0, text.size() - 1) : text);
  if (number && per_cent && *number > 0 && *number <= 100)
    return SimplifyOptions{.share = *number / 100};
  if (number && !per_cent && *number >= 4 && *number <= 4e9 && std::floor(*number) == *number) {
    return SimplifyOptions{.faces = static_cast<std::size_t>(*number)};
  }
  throw UsageError(
      fmt::format("{} is '{}'; it must be auto, none, a number of faces from 4, or a percentage, "
                  "for example 10%",
                  option, text));
}

}  // namespace rholm::cli
