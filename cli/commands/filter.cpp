// rholm filter: a factor for each degree.
#include <algorithm>
#include <memory>

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
  std::string window = "lanczos";
  int order = WindowOptions{}.order;
  std::optional<double> time;
  std::optional<double> sharpen;
  bool keep_mean = false;
  CoefficientsOutputOptions to;
};

// Above these degrees the figures are left out: they cost O(L^2) and O(L^3), a second each.
constexpr int kMaxOvershootDegree = 4096;
constexpr int kMaxSampledDegree = 512;

struct Filter {
  std::string name;
  std::vector<double> gains;
  bool keeps_mean = false;
};

WindowOptions window_options(const Options& o) {
  return {.window = parse_window(o.window), .order = o.order, .time = o.time};
}

void check_usage(const Options& o) {
  const bool timed = o.time.has_value();
  if (timed && o.window != "heat") throw UsageError("--time goes with --window heat");
  if (timed && (o.low_pass || o.high_pass || !o.band.empty())) {
    throw UsageError("--time says how strong the heat window is, a degree does too: give one");
  }
  const int wanted = timed + o.low_pass.has_value() + o.high_pass.has_value() + !o.band.empty() +
                     !o.gain_file.empty();
  if (wanted != 1) {
    throw UsageError(
        "one of --low-pass, --high-pass, --band, --gain, or --window heat --time, is needed");
  }
  if (o.sharpen && !(timed || o.low_pass)) {
    throw UsageError("--sharpen goes with --low-pass, which says from which degree on");
  }
}

Filter filter_of(const Options& o, int degree) {
  const WindowOptions window = window_options(o);
  if (!o.gain_file.empty()) return {"own gains", read_gains(o.gain_file, degree), false};
  if (o.high_pass) {
    return {fmt::format("high-pass {} {}", *o.high_pass, o.window),
            high_pass(*o.high_pass, degree, window), false};
  }
  if (!o.band.empty()) {
    const std::vector<int> ends = parse_band("--band", o.band);
    return {fmt::format("band {}-{} {}", ends[0], ends[1], o.window),
            band_pass(ends[0], ends[1], degree, window), false};
  }
  Filter filter = {o.time ? fmt::format("heat {}", *o.time)
                          : fmt::format("low-pass {} {}", *o.low_pass, o.window),
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
  // A step that loses its mean has no height to overshoot.
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
    session.warn(fmt::format("the {} is {} somewhere: the surface crosses its centre",
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

std::vector<Option> filter_options(Options& o) {
  return {
      {.name = "low-pass",
       .value = "L",
       .help = "keep degrees up to L",
       .target = &o.low_pass,
       .min = 0,
       .max = kMaxDegree},
      {.name = "high-pass",
       .value = "L",
       .help = "keep degrees from L on: all but what --low-pass L-1 keeps",
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
       .help = "gains from a text file: lines with a degree and a number; other degrees stay",
       .target = &o.gain_file,
       .offer = Offer::kAnyFile},
      {.name = "window",
       .value = "WINDOW",
       .help = "how it falls from 1 to 0: lanczos (the default), ideal, lanczos2, gaussian, "
               "heat, exponential, plateau",
       .target = &o.window,
       .choices = {"ideal", "lanczos", "lanczos2", "gaussian", "heat", "exponential", "plateau"}},
      {.name = "order",
       .value = "P",
       .help = "of the exponential window: exp(-36 (l/(L+1))^P), 4 by default",
       .target = &o.order,
       .min = 1,
       .max = 64},
      {.name = "time",
       .value = "T",
       .help = "of the heat window: exp(-T l(l+1)), instead of a half at degree L",
       .target = &o.time,
       .min = 1e-12,
       .max = 1e6},
      {.name = "sharpen",
       .value = "A",
       .help = "add A times what the low-pass filter would take away",
       .target = &o.sharpen,
       .min = -1,
       .max = 1000},
      {.name = "keep-mean",
       .help = "leave degree 0 as it is, so that details lie on a sphere",
       .target = &o.keep_mean}};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {model_operand(o.input)};
  append(list, filter_options(o));
  append(list, coefficients_output_options(o.to, "file of coefficients to write"));
  return list;
}

}  // namespace

Command filter_command() {
  auto options = std::make_shared<Options>();
  return {.name = "filter",
          .summary = "Smooth or sharpen coefficients, degree by degree",
          .description =
              "Multiplies all coefficients of a degree by one factor, so that the result does not "
              "depend on how the shape is turned. Detail of wavelength 2 pi/l radians belongs to "
              "degree l.\n\nA sharp edge rings after a filter, the more the steeper the filter "
              "falls. The report says by how much a step of the radius is overshot: 9 % by the "
              "ideal window, 1.4 % by lanczos, 0.5 % by lanczos2, 0.3 % by gaussian; not by heat, "
              "which also keeps a positive radius positive. What the model knew of its errors is "
              "dropped.",
          .options = option_list(*options),
          .examples = {"rholm filter bumpy.h5 --low-pass 12 --window heat -o smooth.h5",
                       "rholm filter bumpy.h5 --low-pass 8 --sharpen 0.5 --json -o sharp.h5"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
