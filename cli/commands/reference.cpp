// rholm reference: docs/reference.md, from the tables of the library.
#include "cli/commands/reference.h"

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/session.h"
#include "rholm/descriptors.h"
#include "rholm/filter.h"

namespace rholm::cli {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string parameter_text(const WindowParameter& parameter) {
  const std::optional<double> standard = parameter.value({});
  return fmt::format("{} is `--{}`, {} to {}{}; {}", parameter.symbol, parameter.name,
                     parameter.min, parameter.max,
                     standard ? fmt::format(", {} by default", *standard) : "", parameter.help);
}

std::string window_section() {
  std::vector<std::vector<std::string>> rows;
  for (const WindowInfo& window : windows()) {
    std::string parameters;
    for (const WindowParameter& one : window.parameters) {
      parameters += (parameters.empty() ? "" : "<br>") + parameter_text(one);
    }
    rows.push_back({code(window.name), code(window.formula),
                    window.overshoot > 0 ? fmt::format("{:.2g} %", 100 * window.overshoot) : "none",
                    parameters, window.help});
  }
  return fmt::format(
      "## Filter windows\n\n"
      "A window is how a low-pass filter falls: `--window` of `rholm filter`, `window=` in Python, "
      "and under Degrees in the studio. The default is `{}`. Above the degree L the gain is 0, "
      "unless the table says otherwise. The overshoot is that of a filtered step of the radius (a "
      "cap of 60 degrees) at L = 64, in parts of the step.\n\n{}",
      to_string(WindowOptions{}.window),
      markdown_table({"window", "gain of degree l", "overshoot", "parameter", "use"}, rows));
}

std::string unit_text(int length_power) {
  if (length_power == 0) return "none";
  return length_power == 1 ? "length" : fmt::format("length^{}", length_power);
}

std::string descriptor_section() {
  std::vector<std::vector<std::string>> rows;
  for (const Descriptor& one : descriptors()) {
    rows.push_back({code(one.name), unit_text(one.length_power), one.definition, one.source});
  }
  return fmt::format(
      "## Descriptors\n\n"
      "A descriptor is a figure of the surface of an expansion that stays when the shape is moved "
      "or "
      "turned. `rholm info --json` has each as a key, a table of `rholm batch` as a column, and "
      "`Expansion` and `SurfaceMeasures` in Python as a property of that name. Lengths are in the "
      "unit of the expansion. A descriptor is null for what is no surface and for a signed sum. "
      "`rholm info` and `rholm batch` also leave it null above degree 512.\n\n{}",
      markdown_table({"descriptor", "unit", "definition", "source"}, rows));
}

constexpr ReferenceSection kSections[] = {window_section, descriptor_section};

}  // namespace

std::span<const ReferenceSection> reference_sections() { return kSections; }

std::string markdown_table(const std::vector<std::string>& headings,
                           const std::vector<std::vector<std::string>>& rows) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
      text += ' ';
      for (const char c : cell) text += c == '|' ? std::string("\\|") : std::string(1, c);
      text += cell.empty() ? "|" : " |";
    }
    return text + "\n";
  };
  std::string text = line(headings) + "|";
  for (std::size_t i = 0; i < headings.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : rows) text += line(row);
  return text;
}

Command reference_command() {
  return {.name = "reference",
          .summary = "Write the reference page",
          .description = "Writes docs/reference.md to standard output: the tables of the library.",
          .options = {},
          .examples = {"rholm reference"},
          .run =
              [](Session&) {
                std::string text =
                    "# Reference\n\n"
                    "`scripts/reference` makes this page from the tables that the program, the "
                    "library, Python and the studio use. Change the tables, and run it again.\n";
                for (const ReferenceSection section : reference_sections())
                  text += "\n" + section();
                print_exactly(text);
                return kDone;
              },
          .hidden = true};
}

}  // namespace rholm::cli
