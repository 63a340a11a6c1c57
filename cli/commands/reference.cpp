// rholm reference: prints docs/reference.md from the tables of the library.
#include "cli/commands/reference.h"

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands/commands.h"
#include "cli/grammar/help.h"
#include "cli/options/field_options.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/session.h"
#include "rholm/align.h"
#include "rholm/coefficients_io.h"
#include "rholm/compare.h"
#include "rholm/compress.h"
#include "rholm/descriptors.h"
#include "rholm/error_info.h"
#include "rholm/fields.h"
#include "rholm/filter.h"
#include "rholm/formats.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"
#include "rholm/patch_atlas.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/render.h"
#include "rholm/repair.h"
#include "rholm/report.h"
#include "rholm/shape_io.h"
#include "rholm/simplify.h"
#include "rholm/smooth.h"
#include "rholm/star.h"
#include "rholm/studio.h"
#include "rholm/transfer.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"

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
      "A window gives the gain of each degree in a low-pass filter of degree L. Choose it with "
      "`--window` of `rholm filter`, with `window=` in Python, or under Degrees in the studio. The "
      "default is `{}`. Degrees above L have the gain 0, unless the table says otherwise. The "
      "overshoot is measured on a filtered step of the radius, a cap of 60 degrees, at L = 64. It "
      "is relative to the height of the step.\n\n{}",
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
      "A descriptor is a number that describes the surface of an expansion and does not change "
      "when "
      "the shape is moved or rotated. Each descriptor is a key of `rholm info --json` and a column "
      "of the tables of `rholm batch`. In Python it is a property of `Expansion` and "
      "`SurfaceMeasures`. Lengths are in the unit of the expansion. A descriptor is null for "
      "coefficients that are no surface and for signed sums. `rholm info` and `rholm batch` also "
      "leave it null above degree 512.\n\n{}",
      markdown_table({"descriptor", "unit", "definition", "source"}, rows));
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

// Returns a table with name, extensions, read and write support, contents, description.
template <typename Info>
std::string format_table(const std::vector<Info>& formats) {
  std::vector<std::vector<std::string>> rows;
  for (const Info& info : formats) {
    std::vector<std::string> extensions;
    extensions.reserve(info.file.extensions.size());
    for (const FileExtension& one : info.file.extensions) {
      extensions.push_back(code("." + one.name) + (one.read_only ? " (read)" : ""));
    }
    std::vector<std::string> ways;
    if (info.file.read) ways.emplace_back("read");
    if (info.file.written) ways.emplace_back("written");
    if (info.file.text) ways.emplace_back("text");
    if (info.file.binary) ways.emplace_back("binary");
    rows.push_back({code(info.file.name), joined(extensions), joined(ways), joined(held_by(info)),
                    info.file.help});
  }
  return markdown_table({"format", "extensions", "is", "holds", "description"}, rows);
}

std::string shape_format_section() {
  return "## Formats of shapes\n\n`--format` of the program and `format=` in Python take these "
         "names. Without a name, the extension decides the format of a written file. The format of "
         "a file that is read is found from its content.\n\n" +
         format_table(shape_formats());
}

std::string coefficients_format_section() {
  return "## Formats of coefficients\n\n`--format` of the program and `format=` in Python take "
         "these "
         "names for files of coefficients. Without a name, the extension or the content "
         "decides.\n\n" +
         format_table(coefficients_formats());
}

std::string error_section() {
  std::vector<std::vector<std::string>> rows;
  for (const ErrorInfo& one : error_infos()) {
    rows.push_back({code(one.name), std::to_string(one.exit_code), code(one.python_class),
                    one.python_base[0] == '\0' ? "" : code(one.python_base), one.meaning});
  }
  return "## Errors\n\nThe table lists the name of each error in C++ (`ErrorCode`) and in JSON, "
         "the "
         "exit code of the program, and the exception in Python. The exit code of a wrong command "
         "line is 2.\n\n" +
         markdown_table({"error", "exit code", "in Python", "is a", "meaning"}, rows);
}

template <typename V>
std::string choices_text() {
  if constexpr (NamedEnum<V>) {
    const auto names = names_of(V{}).names;
    return fmt::format("{}", fmt::join(names, ", "));
  } else {
    return "";
  }
}

template <typename V>
std::string default_of(const V& value) {
  if constexpr (NamedEnum<V>) {
    return code(to_string(value));
  } else if constexpr (std::is_same_v<V, bool>) {
    return value ? "yes" : "no";
  } else if constexpr (std::is_arithmetic_v<V>) {
    return fmt::format("{}", value);
  } else {
    return "";
  }
}

std::string range_text(const FieldInfo& info) {
  std::string text = info.unit == FieldUnit::kLength  ? "length"
                     : info.unit == FieldUnit::kBytes ? "bytes"
                                                      : "";
  const bool has_least = std::isfinite(info.least), has_most = std::isfinite(info.most);
  if (!has_least && !has_most) return text;
  if (!text.empty()) text += ", ";
  if (!has_most) return text + fmt::format("{} {}", info.above ? "above" : "from", info.least);
  return text + fmt::format("{} ... {}", info.least, info.most);
}

// Returns the fields of a struct of options, with their options in the program.
template <HasFields Options>
std::string field_section(const std::string& title, const std::string& text,
                          bool in_program = true) {
  std::vector<std::vector<std::string>> rows;
  const Options standard;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    using V = std::remove_cvref_t<decltype(standard.*member)>;
    const std::string choices = choices_text<V>();
    rows.push_back(
        {code(info.name), in_program && info.in_program ? code("--" + option_name(info)) : "",
         default_of(standard.*member), choices.empty() ? range_text(info) : choices, info.help});
  });
  return fmt::format("## {}\n\n{}\n\n{}", title, text,
                     markdown_table({"field", "option", "default", "values", "meaning"}, rows));
}

std::string reconstruct_section() {
  return field_section<ReconstructOptions>(
      "Options of reconstruct",
      "`ReconstructOptions` in C++ and arguments of `rholm.reconstruct` in Python. Lengths are in "
      "the unit of the points. The program takes lengths as fractions of the diagonal of the "
      "points' bounding box.");
}

std::string simplify_section() {
  return field_section<SimplifyOptions>(
      "Options of simplify",
      "`SimplifyOptions` in C++ and arguments of `rholm.simplify` in Python; `rholm simplify` has "
      "`--faces` for `triangles` and `share`, and `--max-error`.",
      false);
}

std::string compress_section() {
  return field_section<CompressOptions>(
      "Options of compress",
      "`CompressOptions` in C++ and arguments of `rholm.compress` in Python; they "
      "are options of `rholm compress`, together with `--tolerance`.");
}

std::string patch_atlas_section() {
  return field_section<PatchAtlasOptions>(
      "Options of patch_atlas",
      "`PatchAtlasOptions` in C++ and arguments of `rholm.harmonics.patch_atlas` in Python; they "
      "are "
      "options of `rholm compress --fit integral` and `rholm partition`.");
}

std::string atlas_mesh_section() {
  return field_section<AtlasSynthesisOptions>(
      "Options of the surface of an atlas",
      "`AtlasSynthesisOptions` in C++ and arguments of `rholm.Atlas.mesh` in Python; the "
      "options of `rholm synthesize` are `--resolution`, `--degree-limit` and `--simplify`.");
}

std::string patch_section() {
  return field_section<PatchOptions>(
      "Options of smooth",
      "`PatchOptions` in C++ and arguments of `rholm.smooth` in Python; options of `rholm "
      "smooth`.");
}

std::string patch_update_section() {
  return field_section<PatchUpdate>("Strength of smoothing",
                                    "`PatchUpdate` in C++; `strength` of `rholm.smooth` in Python; "
                                    "`--strength` of `rholm smooth`.");
}

std::string truncation_section() {
  return field_section<TruncationOptions>(
      "Options of truncation errors",
      "`TruncationOptions` in C++ and arguments of `rholm.harmonics.truncation_errors` in Python.");
}

std::string transfer_update_section() {
  return field_section<TransferUpdate>(
      "Placement of transferred detail",
      "`TransferUpdate` in C++ and arguments of `rholm.transfer` in Python; options of `rholm "
      "transfer`, where `--rotate DEG` gives the angle in degrees.");
}

std::string monte_carlo_section() {
  return field_section<MonteCarloOptions>(
      "Options of monte_carlo",
      "`MonteCarloOptions` in C++ and arguments of `rholm.harmonics.monte_carlo` in Python; they "
      "are "
      "options of `rholm expand`, where `--method monte-carlo-edge` and `monte-carlo-triangle` "
      "choose the places.");
}

std::string report_section() {
  return field_section<ReportOptions>(
      "Options of report_html",
      "`ReportOptions` in C++ and arguments of `rholm.report_html` in Python; `rholm report` has "
      "`--size` for `picture_size` and derives the other fields from its input.",
      false);
}

std::string studio_section() {
  return field_section<StudioOptions>("Options of studio",
                                      "`StudioOptions` in C++ and options of `rholm studio`.");
}

// Returns the section of the Python function with the command's name.
template <HasFields Options, const char* kName>
std::string command_section() {
  std::string struct_name = kName;
  struct_name[0] = static_cast<char>(struct_name[0] - 'a' + 'A');
  return field_section<Options>(
      fmt::format("Options of {}", kName),
      fmt::format("`{}Options` in C++ and arguments of `rholm.{}` in Python.", struct_name, kName));
}
constexpr char kCompareName[] = "compare", kOrientName[] = "orient", kAlignName[] = "align",
               kRepairName[] = "repair", kRenderName[] = "render", kTransferName[] = "transfer";

std::string sample_section() {
  return field_section<SampleOptions>(
      "Options of samples",
      "`SampleOptions` in C++ and arguments of `rholm.sample_surface` in Python; they are "
      "options of `rholm make sample`. Lengths are fractions of the bounding box's diagonal.");
}

std::string transform_section() {
  return field_section<TransformOptions>(
      "Options of a transform",
      "`TransformOptions` in C++ and arguments of `rholm.expand` in Python; options of `rholm "
      "expand`, where `--method` also has the Monte Carlo methods.");
}

std::string tolerance_section() {
  return field_section<Tolerance>(
      "Tolerances",
      "`Tolerance` in C++ and arguments of `rholm.expand` in Python, where `error` is "
      "called `tolerance`; options of `rholm expand` and `rholm report`, where `error` is "
      "`--tolerance`.");
}

std::string expand_section() {
  return field_section<ExpandOptions>(
      "Options of the expansion of a mesh",
      "`ExpandOptions` in C++; arguments of `rholm.expand` in Python; options of `rholm expand`, "
      "where `--no-errors` switches `errors` off. The parts `tolerance` and `chart` have tables of "
      "their own.");
}

std::string center_section() {
  return field_section<CenterOptions>("Options of the centre",
                                      "`CenterOptions` in C++; `center` and `rays` of "
                                      "`rholm.harmonics.find_center` in Python, "
                                      "`--center` and `--rays` of `rholm center`.") +
         "\n" +
         field_section<ChartOptions>(
             "Options of a chart",
             "`ChartOptions` in C++, arguments of `rholm.harmonics.make_star_chart` in Python.");
}

std::string file_section() {
  return field_section<ShapeReadOptions>(
             "Options of reading shapes",
             "`ShapeReadOptions` in C++, arguments of `rholm.files.read_shape` in Python.") +
         "\n" +
         field_section<ShapeWriteOptions>(
             "Options of writing shapes",
             "`ShapeWriteOptions` in C++, arguments of `rholm.files.write_shape` in Python.") +
         "\n" +
         field_section<Convention>(
             "Conventions of coefficients",
             "`Convention` in C++; arguments of the functions that read and write coefficients in "
             "Python. The program also has `--input-normalization` and `--input-csphase`.") +
         "\n" +
         field_section<CoefficientsReadOptions>("Options of reading coefficients",
                                                "`CoefficientsReadOptions` in C++.") +
         "\n" +
         field_section<CoefficientsWriteOptions>("Options of writing coefficients",
                                                 "`CoefficientsWriteOptions` in C++.");
}

// Adds the fields of a result, as rows with its name.
template <HasFields Result>
void add_result(const char* name, std::vector<std::vector<std::string>>& rows) {
  for_each_field<Result>([&](auto, const FieldInfo& info) {
    rows.push_back({code(name), code(info.name), info.help});
  });
}

std::string result_section() {
  std::vector<std::vector<std::string>> rows;
  add_result<StarReport>("StarReport", rows);
  add_result<FastReport>("FastReport", rows);
  add_result<TruncationErrors>("TruncationErrors", rows);
  add_result<ToleranceReport>("ToleranceReport", rows);
  add_result<Transform>("Transform", rows);
  add_result<Expanded>("Expanded", rows);
  add_result<ReconstructReport>("ReconstructReport", rows);
  add_result<TileForecast>("TileForecast", rows);
  add_result<Comparison>("Comparison", rows);
  add_result<Distances>("Distances", rows);
  add_result<Alignment>("Alignment", rows);
  add_result<AlignedRotation>("AlignedRotation", rows);
  add_result<OrientReport>("OrientReport", rows);
  add_result<CleanReport>("CleanReport", rows);
  add_result<ScanAlignment>("ScanAlignment", rows);
  add_result<Inspection>("Inspection", rows);
  add_result<RepairReport>("RepairReport", rows);
  add_result<CompressReport>("CompressReport", rows);
  add_result<AtlasErrors>("AtlasErrors", rows);
  add_result<AtlasSize>("AtlasSize", rows);
  add_result<TransferReport>("TransferReport", rows);
  add_result<MonteCarlo>("MonteCarlo", rows);
  add_result<Overshoot>("Overshoot", rows);
  add_result<GravityField>("GravityField", rows);
  return "## Results\n\nResults are structs in C++ and classes of the same names in Python. "
         "Lengths "
         "are in the unit of the shape.\n\n" +
         markdown_table({"result", "field", "meaning"}, rows);
}

// Returns "L, 0 ... 16384" or "edge, gauge"; empty for a switch.
std::string values_text(const Option& option) {
  if (!option.choices.empty()) return joined(option.choices);
  std::string text = value_name(option);
  if (text.empty()) return text;
  const auto number = [](double value) { return fmt::format("{}", value); };
  if (option.above) text += ", above " + number(*option.above);
  if (option.min && option.max)
    return text + ", " + number(*option.min) + " ... " + number(*option.max);
  if (option.min) text += ", from " + number(*option.min);
  if (option.max) text += ", at most " + number(*option.max);
  return text;
}

// Returns "`-o, --output`", or an operand.
std::string option_cell(const Option& option) {
  if (option.letter == 0) return code(option.typed());
  return code(fmt::format("-{}, {}", option.letter, option.typed()));
}

// Returns the operands and all options of a command, group by group.
std::string option_table(const Command& command) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const char* group, const std::vector<Option>& options) {
    for (const Option& option : options) {
      rows.push_back({group, option_cell(option), values_text(option), option.help});
    }
  };
  add("Operand", operands_of(command));
  for (const GroupInfo& info : kGroups) add(info.title, described_options(command, info.group));
  return markdown_table({"group", "option", "values", "meaning"}, rows);
}

std::string commands_section() {
  std::string text =
      "## Commands\n\nThe first screen of `rholm COMMAND --help` has the options of the groups "
      "Data, Accuracy and Output, and `rholm COMMAND --help all` has all options.\n";
  for (const Command& command : all_commands()) {
    if (command.hidden) continue;
    text += fmt::format("\n### {}\n\n{}.\n\n```text\n{}\n```\n\n{}\n\n{}", typed_name(command),
                        command.summary, usage_line(command, 100), command.description,
                        option_table(command));
  }
  return text;
}

constexpr ReferenceSection kSections[] = {commands_section,
                                          window_section,
                                          descriptor_section,
                                          shape_format_section,
                                          coefficients_format_section,
                                          error_section,
                                          reconstruct_section,
                                          simplify_section,
                                          command_section<CompareOptions, kCompareName>,
                                          command_section<OrientOptions, kOrientName>,
                                          command_section<AlignOptions, kAlignName>,
                                          sample_section,
                                          transform_section,
                                          expand_section,
                                          center_section,
                                          file_section,
                                          tolerance_section,
                                          truncation_section,
                                          command_section<RepairOptions, kRepairName>,
                                          compress_section,
                                          patch_atlas_section,
                                          atlas_mesh_section,
                                          patch_section,
                                          patch_update_section,
                                          command_section<TransferOptions, kTransferName>,
                                          transfer_update_section,
                                          monte_carlo_section,
                                          command_section<RenderOptions, kRenderName>,
                                          report_section,
                                          studio_section,
                                          result_section};

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
  text += '\n';
  for (const auto& row : rows) text += line(row);
  return text;
}

Command reference_command() {
  return {.name = "reference",
          .summary = "Print the reference page",
          .description =
              "Prints docs/reference.md, made from the tables of the library and the commands of "
              "the program.",
          .options = {},
          .examples = {"rholm reference"},
          .run =
              [](Session&) {
                std::string text =
                    "# Reference\n\n"
                    "This page lists all filters, descriptors, file formats, errors, options and "
                    "results. `scripts/reference` writes it from the tables of the library, which "
                    "the program, Python and the studio use too. To change the page, change the "
                    "tables and run the script again.\n";
                for (const ReferenceSection section : reference_sections())
                  text += "\n" + section();
                print_exactly(text);
                return kDone;
              },
          .hidden = true};
}

}  // namespace rholm::cli
