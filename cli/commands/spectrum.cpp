// rholm spectrum: energy per degree.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/spectrum_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/file.h"
#include "rholm/render.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::string format;
  std::optional<double> tolerance;
  InputConvention convention;
  bool json = false;
};

std::string table(const Spectrum& s, const std::string& format, const std::string& heading) {
  std::string text = heading;
  for (std::size_t l = 0; l < s.energy.size(); ++l) {
    text += fmt::format(fmt::runtime(format), l, s.energy[l], s.cumulative[l], s.rms_beyond[l]);
  }
  return text;
}

std::string csv(const Spectrum& s) {
  return table(s, "{},{},{},{}\n", "degree,energy,cumulative,rms_beyond\n");
}

// The smallest degree beyond which no more than the tolerance is left.
std::optional<int> degree_within(const Spectrum& s, double tolerance) {
  for (std::size_t l = 0; l < s.rms_beyond.size(); ++l) {
    if (s.rms_beyond[l] <= tolerance) return static_cast<int>(l);
  }
  return std::nullopt;
}

Json report_json(const Options& options, const Expansion& expansion, const Spectrum& s) {
  Json json;
  json["file"] = options.input;
  json.update(spectrum_json(expansion, s));
  json["tolerance"] = json_of(options.tolerance);
  if (options.tolerance) json["tolerance_degree"] = json_of(degree_within(s, *options.tolerance));
  json["norm_squared"] = json_of(expansion.norm_squared);
  json["tail_strength"] = json_of(expansion.tail_strength);
  return json;
}

std::string plot_format(const Options& options) {
  if (options.output.empty()) return "";
  check_not_shared(options.output, options.json);
  std::string format = options.format;
  if (format.empty() && options.output != "-") format = extension_of(options.output);
  if (format.starts_with('.')) format.erase(0, 1);
  if (format == "svg" || format == "csv") return format;
  throw UsageError(fmt::format(
      "'{}' does not say what the plot is to be: .svg or .csv, or --format", options.output));
}

int run(const Options& options, Session& session) {
  const std::string format = plot_format(options);
  check_writable(options.output);
  const Expansion expansion =
      read_coefficients_input(options.input, session, options.convention).expansion;
  const Spectrum spectrum = spectrum_of(expansion);
  if (!format.empty()) {
    const std::string title = std::filesystem::path(options.input).filename().string();
    const std::string text =
        format == "svg" ? spectrum_svg(expansion, title, options.tolerance) : csv(spectrum);
    stop_if_interrupted();
    write_file(options.output, text);
  }
  if (options.json) {
    print_json(report_json(options, expansion, spectrum));
  } else if (options.output.empty()) {
    const std::string heading = fmt::format(
        "# {}, per degree of the {}; rms beyond over solid angle{}\n"
        "{:>6} {:>14} {:>14} {:>14}\n",
        display_name(options.input),
        expansion.function == RadialFunction::kOther ? "function" : to_string(expansion.function),
        spectrum.includes_tail ? "" : ", within the file's own degrees", "degree", "energy",
        "cumulative", "rms beyond");
    print_text(table(spectrum, "{:>6} {:>14.7g} {:>14.7g} {:>14.7g}\n", heading));
    if (options.tolerance) {
      const std::optional<int> degree = degree_within(spectrum, *options.tolerance);
      print_text(degree ? fmt::format("# within {} from degree {} on\n",
                                      text_of(*options.tolerance), *degree)
                        : fmt::format("# never within {}\n", text_of(*options.tolerance)));
    }
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {
      {.name = "MODEL",
       .help = "file of coefficients",
       .target = &o.input,
       .required = true,
       .offer = Offer::kCoefficients},
      output_option(o.output, "plot to write: .svg, or a table as .csv; - for standard output",
                    false),
      format_option(o.format, {"svg", "csv"}),
      {.name = "tolerance",
       .value = "E",
       .help = "rms over solid angle to draw and to find the degree of, in the shape's unit",
       .target = &o.tolerance,
       .above = 0}};
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command spectrum_command() {
  auto options = std::make_shared<Options>();
  return {.name = "spectrum",
          .summary = "Energy per degree, as a table or a plot",
          .description =
              "Energy of a degree is the sum of its squared orthonormal coefficients; rms beyond "
              "is the root mean square, over all directions, of what the degrees above hold. "
              "For a model file of a star-shaped mesh this includes what lies above the file's "
              "last degree, exactly.\n\nWith -o the plot is written and the table is not; --json "
              "reports in either case.",
          .options = option_list(*options),
          .examples = {"rholm spectrum bumpy.h5",
                       "rholm spectrum bumpy.h5 --tolerance 1e-3 -o spectrum.svg"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "svg", .writes_always = false}};
}

}  // namespace rholm::cli
