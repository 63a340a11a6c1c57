// rholm filter: a factor for each degree.
#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/gain_file.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/align.h"
#include "rholm/filter.h"
#include "rholm/grid.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::optional<int> low_pass, high_pass;
  std::string band;
  std::string gain_file;
  WindowOptions window;  // its parameters
  std::string window_name = to_string(WindowOptions{}.window);
  std::optional<double> sharpen;
  bool keep_mean = false;
  CoefficientsOutputOptions to;
};

// Above these degrees the results are left out: they cost O(L^2) and O(L^3), a second each.
constexpr int kMaxOvershootDegree = 4096;
constexpr int kMaxSampledDegree = 512;

struct Filter {
  std::string name;
  std::vector<double> gains;
  bool keeps_mean = false;
};

WindowOptions window_options(const Options& o) {
  WindowOptions window = o.window;
  window.window = parse_window(o.window_name);
  return window;
}

struct NamedParameter {
  const WindowInfo& window;
  const WindowParameter& parameter;
};

// Returns the parameters that can replace the degree.
std::vector<NamedParameter> parameters_for_cutoff() {
  std::vector<NamedParameter> list;
  for (const WindowInfo& window : windows()) {
    for (const WindowParameter& one : window.parameters) {
      if (one.replaces_cutoff) list.push_back({window, one});
    }
  }
  return list;
}

// Returns the given parameter of this kind, if any.
std::optional<NamedParameter> given_for_cutoff(const Options& o) {
  for (const NamedParameter& one : parameters_for_cutoff()) {
    if (one.parameter.value(o.window)) return one;
  }
  return std::nullopt;
}

void check_usage(const Options& o) {
  const std::optional<NamedParameter> given = given_for_cutoff(o);
  if (given && o.window_name != given->window.name) {
    throw UsageError(
        fmt::format("--{} needs --window {}", given->parameter.name, given->window.name));
  }
  if (given && (o.low_pass || o.high_pass || !o.band.empty())) {
    throw UsageError(
        fmt::format("--{} and a degree both set the strength of the {} window; give one",
                    given->parameter.name, given->window.name));
  }
  const int wanted = given.has_value() + o.low_pass.has_value() + o.high_pass.has_value() +
                     !o.band.empty() + !o.gain_file.empty();
  if (wanted != 1) {
    std::string ways;
    for (const auto& [window, parameter] : parameters_for_cutoff()) {
      ways += fmt::format(", or --window {} --{}", window.name, parameter.name);
    }
    throw UsageError(fmt::format("give one of --low-pass, --high-pass, --band, --gain{}", ways));
  }
  if (o.sharpen && !(given || o.low_pass)) {
    throw UsageError("--sharpen needs --low-pass, the first degree to sharpen");
  }
}

Filter filter_of(const Options& o, int degree) {
  const WindowOptions window = window_options(o);
  if (!o.gain_file.empty()) return {"own gains", read_gains(o.gain_file, degree), false};
  if (o.high_pass) {
    return {fmt::format("high-pass {} {}", *o.high_pass, o.window_name),
            high_pass(*o.high_pass, degree, window), false};
  }
  if (!o.band.empty()) {
    const std::vector<int> ends = parse_band("--band", o.band);
    return {fmt::format("band {}-{} {}", ends[0], ends[1], o.window_name),
            band_pass(ends[0], ends[1], degree, window), false};
  }
  const std::optional<NamedParameter> given = given_for_cutoff(o);
  Filter filter = {given
                       ? fmt::format("{} {}", given->window.name, *given->parameter.value(o.window))
                       : fmt::format("low-pass {} {}", *o.low_pass, o.window_name),
                   low_pass(o.low_pass.value_or(0), degree, window), false};
  if (!o.sharpen) return filter;
  return {fmt::format("sharpened {} {}", *o.sharpen, filter.name),
          sharpened(filter.gains, *o.sharpen), false};
}

struct Figures {
  std::optional<Overshoot> overshoot;
  double change = 0;  // root mean square
  std::optional<double> smallest;
};

Figures figures_of(const Filter& filter, const Expansion& before, const Expansion& after,
                   Session& session) {
  Figures figures;
  // A filtered step without mean has no height to compare an overshoot with.
  if (filter.keeps_mean && filter.gains.size() <= kMaxOvershootDegree + 1) {
    figures.overshoot = overshoot(filter.gains);
  }
  figures.change = distance(before.coefficients, after.coefficients);
  const int degree = after.coefficients.degree();
  if (degree <= kMaxSampledDegree && after.function != RadialFunction::kOther) {
    const auto values = synthesize_grid(
        after.coefficients, smallest_grid(GridKind::kGaussLegendre, 2 * degree), session.context());
    figures.smallest = *std::min_element(values.begin(), values.end());
  }
  return figures;
}

Json report_json(const Options& o, const Filter& filter, const Figures& figures,
                 const Expansion& before, const Expansion& after) {
  Json json;
  json["file"] = o.input;
  json["filter"] = filter.name;
  json["function"] = to_string(after.function);
  json["degree_before"] = before.coefficients.degree();
  json["degree"] = after.coefficients.degree();
  json["overshoot"] = figures.overshoot ? Json(figures.overshoot->above) : Json(nullptr);
  json["undershoot"] = figures.overshoot ? Json(figures.overshoot->below) : Json(nullptr);
  json["rms_change"] = figures.change;
  json["smallest"] = json_of(figures.smallest);
  return json;
}

std::string report_text(const Options& o, const Filter& filter, const Figures& figures,
                        const Expansion& before, const Expansion& after) {
  std::string text = fmt::format("{}: {}\n", display_name(o.input), filter.name);
  text += line("degree",
               fmt::format("{} of {}", after.coefficients.degree(), before.coefficients.degree()));
  if (figures.overshoot) {
    text += line("overshoot",
                 fmt::format("{:.2f} % above, {:.2f} % below a step",
                             100 * figures.overshoot->above, 100 * figures.overshoot->below));
  }
  text += line("change", text_of(figures.change) + " rms over solid angle");
  if (figures.smallest) text += line("smallest", text_of(*figures.smallest));
  text.pop_back();  // the note ends the line
  return text;
}

int run(const Options& options, Session& session) {
  check_usage(options);
  const CoefficientsOutput output =
      coefficients_output(options.to.output, options.to.format, options.to.json);
  const Convention convention = options.to.convention.output_convention();
  check_writable(options.to.output);
  const Expansion before =
      read_coefficients_input(options.input, session, options.to.input_convention).expansion;
  Filter wanted = filter_of(options, before.coefficients.degree());
  wanted.keeps_mean = wanted.gains[0] == 1;
  if (options.keep_mean) wanted.gains[0] = 1;
  const Expansion after = filter(before, wanted.gains, wanted.name);
  const Figures figures = figures_of(wanted, before, after, session);
  if (figures.smallest.value_or(1) <= 0) {
    session.warn(fmt::format(
        "the {} is {} in some direction, where the surface crosses its centre; try --window heat",
        to_string(after.function), text_of(*figures.smallest)));
  }
  write_coefficients_output(after, output, convention, session);
  if (options.to.json) {
    print_json(report_json(options, wanted, figures, before, after));
  } else {
    session.note(report_text(options, wanted, figures, before, after));
  }
  return 0;
}

// Returns the option of a parameter, for all windows that have it.
Option parameter_option(const WindowParameter& parameter, Options& o) {
  std::string names, formulas;
  for (const WindowInfo& info : windows()) {
    for (const WindowParameter& one : info.parameters) {
      if (one.name != std::string(parameter.name)) continue;
      names += (names.empty() ? "" : " and ") + std::string(info.name);
      formulas += (formulas.empty() ? "" : " and ") + std::string(info.formula);
    }
  }
  const bool shared = names.find(" and ") != std::string::npos;
  const std::optional<double> standard = parameter.value({});
  std::string value = parameter.symbol;
  for (char& c : value) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return {.name = parameter.name,
          .value = value,
          .help = fmt::format("of the {} window{}: {} in {}; {}{}", names, shared ? "s" : "",
                              parameter.symbol, formulas, parameter.help,
                              standard ? fmt::format("; {} by default", *standard) : ""),
          .target =
              std::visit([&](auto field) -> Target { return &(o.window.*field); }, parameter.field),
          .min = parameter.min,
          .max = parameter.max,
          .group = Group::kAdvanced};
}

// Returns --window, and the parameters of windows, each once.
std::vector<Option> window_options_of(Options& o) {
  Option window = {
      .name = "window",
      .value = "WINDOW",
      .help = fmt::format("decay of the gain from 1 to 0: {} (the default)", o.window_name),
      .target = &o.window_name};
  std::vector<Option> list;
  for (const WindowInfo& info : windows()) {
    window.choices.emplace_back(info.name);
    if (o.window_name != info.name) window.help += fmt::format(", {}", info.name);
    for (const WindowParameter& one : info.parameters) {
      const bool is_there = std::any_of(
          list.begin(), list.end(), [&](const Option& known) { return known.name == one.name; });
      if (!is_there) list.push_back(parameter_option(one, o));
    }
  }
  list.insert(list.begin(), std::move(window));
  return list;
}

std::vector<Option> filter_options(Options& o) {
  std::vector<Option> list = {
      {.name = "low-pass",
       .value = "L",
       .help = "keep degrees up to L",
       .target = &o.low_pass,
       .min = 0,
       .max = kMaxDegree},
      {.name = "high-pass",
       .value = "L",
       .help = "keep degrees from L on, and remove what --low-pass L-1 keeps",
       .target = &o.high_pass,
       .min = 1,
       .max = kMaxDegree},
      {.name = "band",
       .value = "L0,L1",
       .help = "keep degrees from L0 to L1",
       .target = &o.band,
       .check = parse_band},
      {.name = "gain",
       .value = "FILE",
       .help =
           "text file of gains: lines with a degree and a factor; other degrees keep the factor 1",
       .target = &o.gain_file,
       .offer = Offer::kAnyFile}};
  append(list, window_options_of(o));
  append(list, {{.name = "sharpen",
                 .value = "A",
                 .help = "add A times the part that the low-pass filter removes",
                 .target = &o.sharpen,
                 .min = -1,
                 .max = 1000},
                {.name = "keep-mean",
                 .help = "keep degree 0 unchanged, so that details lie on a sphere",
                 .target = &o.keep_mean}});
  return list;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {model_operand(o.input)};
  append(list, filter_options(o));
  append(list, coefficients_output_options(o.to, "file of coefficients to write"));
  return list;
}

// Returns "ideal 8.8 %, ..., heat none".
std::string overshoots() {
  std::string text;
  for (const WindowInfo& info : windows()) {
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", info.name,
                    info.overshoot > 0 ? fmt::format("{:.2g} %", 100 * info.overshoot) : "none");
  }
  return text;
}

}  // namespace

Command filter_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "filter",
      .summary = "Smooth or sharpen coefficients, degree by degree",
      .description =
          "Multiplies the coefficients of each degree by one factor. The result does not depend on "
          "the orientation of the shape. Degree l has detail of wavelength 2 pi/l radians. Stored "
          "errors of the model are dropped.\n\nA steep filter causes ringing at sharp edges. The "
          "report gives the overshoot at a step of the radius. At L = 64 it is: " +
          overshoots() + ". The heat window keeps a positive radius positive.",
      .options = in_groups(option_list(*options), {{Group::kAccuracy, {"window"}},
                                                   {Group::kAdvanced, {"gain", "keep-mean"}}}),
      .examples = {"rholm filter bumpy.h5 --low-pass 12 --window heat -o smooth.h5",
                   "rholm filter bumpy.h5 --low-pass 8 --sharpen 0.5 --json -o sharp.h5"},
      .run = [options](Session& session) { return run(*options, session); },
      .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
