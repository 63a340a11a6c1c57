// rholm spectrum: energy per degree.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/spectrum_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
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

constexpr const char* kNotKnown = "not known";

std::string table(const Spectrum& s) {
  std::string text;
  for (std::size_t l = 0; l < s.energy.size(); ++l) {
    const std::optional<double>& rms = s.rms[l];
    text += fmt::format("{:>6} {:>14.7g} {:>14.7g} {:>14}\n", l, s.energy[l], s.cumulative[l],
                        rms ? fmt::format("{:.7g}", *rms) : kNotKnown);
  }
  return text;
}

// Returns a CSV table; unknown values are empty cells.
std::string csv(const Spectrum& s) {
  std::string text = "degree,energy,cumulative,rms_beyond\n";
  for (std::size_t l = 0; l < s.energy.size(); ++l) {
    const std::optional<double>& rms = s.rms[l];
    text += fmt::format("{},{},{},{}\n", l, s.energy[l], s.cumulative[l],
                        rms ? fmt::format("{}", *rms) : "");
  }
  return text;
}

// Returns the truncation error of the file's own degree, measured at points of the shape.
std::optional<double> measured_rms(const Expansion& expansion) {
  const bool radius = expansion.function == RadialFunction::kRadius;
  return radius && expansion.errors ? expansion.errors->rms : std::nullopt;
}

// Returns why some values are unknown, and what is known instead.
std::string unknown_text(const Spectrum& s, const Expansion& expansion) {
  if (s.rms.back()) return "";
  const int degree = expansion.coefficients.degree();
  const std::optional<double> bound = s.beyond.bound();
  if (!bound) {
    return fmt::format("# not known: the file has no norm, which tells what lies above degree {}\n",
                       degree);
  }
  std::string text =
      fmt::format("# not known: at most {}, as the coefficients have a precision of {}{}",
                  text_of(*bound), text_of(s.beyond.precision),
                  s.beyond.precision_is_assumed ? ", which the file does not say" : "");
  if (const std::optional<double> measured = measured_rms(expansion)) {
    text += fmt::format("; {} at degree {}, measured at points", text_of(*measured), degree);
  }
  return text + "\n";
}

// Without a norm only the file's own degrees count, so that the last degree has no error.
std::optional<int> degree_within(const Spectrum& s, double tolerance) {
  if (s.beyond.includes_tail()) return s.beyond.degree_within(tolerance);
  const std::vector<double>& within = s.beyond.rms_within;
  const auto first =
      std::find_if(within.begin(), within.end(), [&](double rms) { return rms <= tolerance; });
  return static_cast<int>(first - within.begin());
}

std::string tolerance_text(const Spectrum& s, const Expansion& expansion, double tolerance) {
  const std::string wanted = text_of(tolerance);
  const int last = expansion.coefficients.degree();
  if (const std::optional<int> degree = degree_within(s, tolerance)) {
    return fmt::format("# within {}{} from degree {} on\n", wanted,
                       s.beyond.includes_tail() ? "" : " of the file's own degrees", *degree);
  }
  if (s.rms.back()) return fmt::format("# never within {}\n", wanted);
  const std::optional<double> measured = measured_rms(expansion);
  if (!measured) return fmt::format("# whether any degree is within {} is not known\n", wanted);
  return *measured > tolerance
             ? fmt::format("# never within {}, as measured at degree {}\n", wanted, last)
             : fmt::format("# within {} at degree {}, as measured; for lower degrees not known\n",
                           wanted, last);
}

Json report_json(const Options& options, const Expansion& expansion, const Spectrum& s) {
  Json json;
  json["file"] = options.input;
  json.update(spectrum_json(expansion, s));
  json["tolerance"] = json_of(options.tolerance);
  if (options.tolerance) {
    json["tolerance_degree"] = json_of(degree_within(s, *options.tolerance));
  }
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
        spectrum.beyond.includes_tail() ? "" : ", within the file's own degrees", "degree",
        "energy", "cumulative", "rms beyond");
    print_text(heading + table(spectrum) + unknown_text(spectrum, expansion));
    if (options.tolerance) print_text(tolerance_text(spectrum, expansion, *options.tolerance));
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
      output_option(o.output, "plot (.svg) or table (.csv) to write; - for standard output", false),
      format_option(o.format, {"svg", "csv"}),
      {.name = "tolerance",
       .value = "E",
       .help = "rms over solid angle, in the unit of the shape: drawn in the plot, and the degree "
               "that reaches it is printed",
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
          .summary = "Print or plot the energy of each degree",
          .description =
              "Prints the energy of each degree as a table, or writes a plot with -o. The energy "
              "of a degree is the sum of its squared orthonormal coefficients.\n\n'rms beyond' is "
              "the root mean square, over all directions, of the higher degrees. For the model "
              "file of a star-shaped mesh it includes exactly the degrees above the last one of "
              "the file. Where it is below the precision of the coefficients it is unknown: the "
              "table says so, and the JSON has null.",
          .options = in_groups(option_list(*options), {{Group::kAccuracy, {"tolerance"}}}),
          .examples = {"rholm spectrum bumpy.h5",
                       "rholm spectrum bumpy.h5 --tolerance 1e-3 -o spectrum.svg"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "svg", .writes_always = false}};
}

}  // namespace rholm::cli
