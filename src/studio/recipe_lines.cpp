// Converts every step to lines of a shell and of Python.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rholm/align.h"
#include "rholm/coefficients.h"
#include "rholm/compress.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/repair.h"
#include "rholm/shape_io.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "studio/controls.h"
#include "studio/edits.h"
#include "studio/recipe.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

// Step that is being read: its fields, and the resulting lines.
struct Reading {
  const Json& step;
  const Recipe& before;
  StepLines lines;

  Named named(const char* field) const {
    const auto found = step.find(field);
    if (found == step.end() || !found->is_object()) {
      throw bad_request(fmt::format("the field '{}' of a step names no file and variable", field));
    }
    Named named = {string_of(*found, "file"), string_of(*found, "variable")};
    if (!is_file_name(named.file)) {
      throw bad_request(fmt::format("the field '{}' of a step has no plain name of a file", field));
    }
    return named;
  }
  // Returns the name of a result of an earlier step.
  Named used(const char* field) const {
    const Named made = named(field);
    if (!before.files.contains(made.file) || !before.has_variable(made.variable)) {
      throw bad_request(fmt::format("no step before has made the '{}' of a step", field));
    }
    return made;
  }
  Named made(const char* field = "made") {
    const Named made = named(field);
    if (!is_variable(made.variable)) {
      throw bad_request(fmt::format("the field '{}' of a step names no variable", field));
    }
    lines.made.push_back(made);
    return made;
  }
  // Adds one line of each language that makes `to`.
  void say(const Named& to, const std::string& shell, const std::string& python) {
    lines.shell.push_back(shell + " -o " + shell_word(to.file));
    lines.python.push_back(to.variable + " = " + python);
  }
};

std::vector<std::string> texts_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(digits(value));
  return texts;
}

std::string python_list(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  quoted.reserve(texts.size());
  for (const std::string& text : texts) quoted.push_back(python_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string python_point(const Vec3& point) {
  return fmt::format("({}, {}, {})", point.x, point.y, point.z);
}

std::string unit_option(const Json& step) {
  const std::string unit = string_or(step, "unit", "");
  if (unit.empty()) return "";
  return (unit.starts_with('-') ? " --length-unit=" : " --length-unit ") +
         shell_text(plain_text(unit));
}

std::string python_unit(const Json& step) {
  const std::string unit = string_or(step, "unit", "");
  return unit.empty() ? "" : ", length_unit=" + python_text(plain_text(unit));
}

void read_file(Reading& r) {
  const Named made = r.made();
  const std::string file = python_text(made.file);
  const std::string call = flag_of(r.step, "series")
                               ? fmt::format("rholm.load({})", file)
                               : fmt::format("rholm.read_shape({}).shape", file);
  r.lines.python.push_back(made.variable + " = " + call);
}

// Reads a table of points with given columns.
void read_columns(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const std::string columns = string_of(r.step, "columns");
  if (columns.empty()) throw bad_request("a step says no columns");
  check_columns(columns);
  const std::string plain = plain_text(columns);
  r.lines.shell.push_back(fmt::format("rholm convert {} {} --columns={}", shell_word(from.file),
                                      shell_word(made.file), shell_text(plain)));
  r.lines.python.push_back(fmt::format("{} = rholm.read_shape({}, columns={}).shape", made.variable,
                                       python_text(from.file), python_text(plain)));
}

// Makes shapes with the defaults of `rholm make`.
void make(Reading& r) {
  struct Words {
    const char *kind, *shell, *python;
  };
  static constexpr Words kKinds[] = {{"bumpy", "bumpy", "rholm.bumpy_sphere(5"},
                                     {"points", "bumpy", "rholm.bumpy_sphere(5"},
                                     {"sphere", "sphere", "rholm.icosphere(5"},
                                     {"ellipsoid", "ellipsoid", "rholm.ellipsoid((3, 2, 1), 5"},
                                     {"torus", "torus", "rholm.torus(1, 0.4, 96, 48"},
                                     {"box", "box --cells 24", "rholm.box((1, 1, 1), 24"}};
  const std::string kind = string_of(r.step, "shape");
  const auto* const words = std::find_if(std::begin(kKinds), std::end(kKinds),
                                         [&](const Words& one) { return kind == one.kind; });
  if (words == std::end(kKinds)) throw bad_request("a step makes a shape that is not known");
  const Named made = r.made();
  std::string shell = words->shell, python = words->python;
  if (const auto amplitude = maybe_number(r.step, "amplitude")) {
    shell += " --amplitude " + digits(*amplitude);
    python += ", amplitude=" + digits(*amplitude);
  }
  if (const int seed = integer_or(r.step, "seed", -1); seed >= 0) {
    shell += fmt::format(" --seed {}", seed);
    python += fmt::format(", seed={}", seed);
  }
  r.say(made, "rholm make " + shell, python + ")");
  if (kind != "points") return;
  const int n = integer_of(r.step, "points");
  r.say(r.made("cloud"), fmt::format("rholm make sample {} --points {}", shell_word(made.file), n),
        fmt::format("rholm.sample_surface({}, {})", made.variable, n));
}

void filter(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  std::vector<double> gains = numbers_of(r.step, "gains");
  if (gains.empty()) {
    const int degree = integer_of(r.step, "degree");
    return r.say(
        made,
        fmt::format("rholm filter {} --low-pass {} --window ideal", shell_word(from.file), degree),
        fmt::format("{}.low_pass({}, window=\"ideal\")", from.variable, degree));
  }
  const std::string python =
      fmt::format("{}.filter([{}])", from.variable, fmt::join(texts_of(gains), ", "));
  // File with a degree and its gain per line, for all degrees.
  const std::string file = string_of(r.step, "gain_file");
  const int degrees = integer_of(r.step, "degrees");
  if (!is_file_name(file) || degrees < 1 || degrees > kMaxDegree + 1) {
    throw bad_request("a step has gains without a file or degrees for them");
  }
  gains.resize(static_cast<std::size_t>(degrees));
  std::string pairs;
  for (std::size_t l = 0; l < gains.size(); ++l) pairs += fmt::format(" {} {}", l, gains[l]);
  r.lines.shell.push_back(fmt::format("printf '%d %s\\n'{} > {}", pairs, shell_word(file)));
  r.lines.made.push_back({file, {}});
  r.say(made, fmt::format("rholm filter {} --gain {}", shell_word(from.file), shell_word(file)),
        python);
}

void synthesize_series(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  std::string shell = "rholm synthesize " + shell_word(from.file);
  std::vector<std::string> python;
  if (r.step.contains("degree")) {
    const int degree = integer_of(r.step, "degree");
    shell += fmt::format(" --degree {}", degree);
    python.push_back(fmt::format("degree={}", degree));
  }
  if (r.step.contains("like")) {
    const Named like = r.used("like");
    shell += " --like " + shell_word(like.file);
    python.push_back("like=" + like.variable);
  }
  r.say(made, shell, fmt::format("{}.mesh({})", from.variable, fmt::join(python, ", ")));
}

// Returns the options of a struct that the step has under their names.
template <HasFields Options>
Options options_in(const Json& step) {
  Options options;
  take_fields(step, options);
  return options;
}

void expand(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const auto options = options_in<TransformOptions>(r.step);
  Arguments words;
  if (const std::optional<double> tolerance = maybe_number(r.step, "tolerance")) {
    words.number("tolerance", *tolerance);
  } else {
    words.number("degree", integer_of(r.step, "degree"));
  }
  const std::string center = string_or(r.step, "center", "auto");
  if (center != "auto") {
    const CenterOptions wanted = parse_center(center);
    words.shell += " --center=" + shell_text(center);
    words.python += ", center=" + (wanted.kind == CenterKind::kGiven ? python_point(wanted.point)
                                                                     : python_text(center));
  }
  words.fields(TransformOptions{
      .method = options.method, .engine = options.engine, .precision = options.precision});
  r.say(made,
        fmt::format("rholm expand {}{}{}", shell_word(from.file), words.shell, unit_option(r.step)),
        fmt::format("rholm.expand({}{}{})", from.variable, words.python, python_unit(r.step)));
}

void align_lines(Reading& r) {
  const Named a = r.used("a"), b = r.used("b"), made = r.made();
  Arguments words;
  words.fields(options_in<AlignOptions>(r.step));
  r.say(made,
        fmt::format("rholm align {} {}{}", shell_word(a.file), shell_word(b.file), words.shell),
        fmt::format("rholm.placed({0}, rholm.align({0}, {1}{2}))", a.variable, b.variable,
                    words.python));
}

// The program has no command for a blend, so the shell calls Python.
void blend(Reading& r) {
  const Named from = r.used("a"), to = r.used("b"), made = r.made();
  const double t = number_of(r.step, "t");
  const int degree = integer_of(r.step, "degree");
  const std::vector<double> center = numbers_of(r.step, "center");
  const std::string function = string_of(r.step, "function");
  if (center.size() != 3) throw bad_request("a step blends about no centre");
  parse_name<RadialFunction>(function);
  const auto call = [&](const std::string& a, const std::string& b) {
    return fmt::format(
        "rholm.Expansion({} * {}.truncate({degree}).coeffs + {} * {}.truncate({degree}).coeffs, "
        "center={}, function={})",
        digits(1 - t), a, digits(t), b, python_point({center[0], center[1], center[2]}),
        python_text(function), fmt::arg("degree", degree));
  };
  const auto loaded = [](const std::string& file) {
    return "rholm.load(" + python_text(file) + ")";
  };
  r.lines.shell.push_back("python3 -c " +
                          shell_text("import rholm; " + call(loaded(from.file), loaded(to.file)) +
                                     ".save(" + python_text(made.file) + ")"));
  r.lines.python.push_back(made.variable + " = " + call(from.variable, to.variable));
}

// The program has no command for a unit, so the shell calls Python.
void set_unit(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const std::string unit = string_or(r.step, "unit", "");
  const std::string call = ".with_unit(" + python_text(plain_text(unit)) + ")";
  r.lines.shell.push_back("python3 -c " +
                          shell_text("import rholm; rholm.load(" + python_text(from.file) + ")" +
                                     call + ".save(" + python_text(made.file) + ")"));
  r.lines.python.push_back(made.variable + " = " + from.variable + call);
}

std::string region_options(const char* name, const std::vector<std::string>& regions) {
  std::string text;
  for (const std::string& region : regions)
    text += fmt::format(" --{} {}", name, shell_text(region));
  return text;
}

void smooth(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  SmoothWish wish = smooth_in(r.step);
  const std::string wavelength = digits(wish.options.wavelength);
  wish.options.wavelength = 0;  // Python takes it without a name
  Arguments words;
  if (wish.strength != 1) words.number("strength", wish.strength);
  words.fields(wish.options);
  r.say(made,
        fmt::format("rholm smooth {}{} --wavelength {}{}", shell_word(from.file),
                    region_options("region", wish.regions), wavelength, words.shell),
        fmt::format("rholm.smooth({}, {}, {}{})", from.variable, python_list(wish.regions),
                    wavelength, words.python));
}

void transfer(Reading& r) {
  const Named from = r.used("source"), to = r.used("target"), made = r.made();
  const TransferWish wish = transfer_in(r.step);
  Arguments words;
  words.fields(wish.options);
  words.fields(wish.update);
  if (wish.update.angle) {
    words.shell += " --rotate=" + digits(*wish.degrees);
    words.python += ", angle=" + digits(*wish.update.angle);
  }
  r.say(made,
        fmt::format("rholm transfer --from {}{} --to {}{}{}", shell_word(from.file),
                    region_options("from-region", wish.from), shell_word(to.file),
                    region_options("to-region", wish.to), words.shell),
        fmt::format("rholm.transfer({}, {}, {}, {}{})", from.variable, python_list(wish.from),
                    to.variable, python_list(wish.to), words.python));
}

void simplify(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  std::string shell = "rholm simplify " + shell_word(from.file);
  std::vector<std::string> python = {from.variable};
  if (const int faces = integer_or(r.step, "faces", 0); faces > 0) {
    shell += fmt::format(" --faces {}", faces);
    python.push_back(fmt::format("faces={}", faces));
  }
  if (const std::optional<double> error = maybe_number(r.step, "error")) {
    shell += " --max-error " + digits(*error);
    python.push_back("max_error=" + digits(*error));
  }
  r.say(made, shell, fmt::format("rholm.simplify({}).mesh", fmt::join(python, ", ")));
}

void repair_lines(Reading& r) {
  const Named from = r.used("from");
  Arguments words;
  words.fields(options_in<RepairOptions>(r.step));
  r.say(r.made(), "rholm repair " + shell_word(from.file) + words.shell,
        fmt::format("rholm.repair({}{}).mesh", from.variable, words.python));
}

void orient_lines(Reading& r) {
  const Named from = r.used("from");
  Arguments words;
  words.fields(options_in<OrientOptions>(r.step));
  r.say(r.made(), "rholm orient " + shell_word(from.file) + words.shell,
        fmt::format("rholm.orient({}{}).cloud", from.variable, words.python));
}

void reconstruct_lines(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const ReconstructOptions options = reconstruct_in(r.step);
  Arguments words;
  words.fields(options);
  if (options.noise) words.number("noise", *options.noise);
  if (options.simplify) {
    words.shell += fmt::format(" --simplify {}%", 100 * options.simplify->share);
    words.python += fmt::format(", simplify={{\"share\": {}}}", options.simplify->share);
  }
  r.say(made, "rholm reconstruct " + shell_word(from.file) + words.shell,
        fmt::format("rholm.reconstruct({}{}).mesh", from.variable, words.python));
}

void compress(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const std::string tolerance = digits(number_of(r.step, "tolerance"));
  Arguments words;
  words.fields(options_in<CompressOptions>(r.step));
  r.say(made,
        fmt::format("rholm compress {} --tolerance {}{}{}", shell_word(from.file), tolerance,
                    words.shell, unit_option(r.step)),
        fmt::format("rholm.compress({}, {}{}{})", from.variable, tolerance, words.python,
                    python_unit(r.step)));
}

void limit(Reading& r) {
  const Named from = r.used("from"), made = r.made();
  const int degree = integer_of(r.step, "limit");
  r.say(made, fmt::format("rholm synthesize {} --degree-limit {}", shell_word(from.file), degree),
        fmt::format("{}.mesh(degree={})", from.variable, degree));
}

}  // namespace

StepLines step_lines(const Json& step, const Recipe& before) {
  static const std::map<std::string, void (*)(Reading&)> kSteps = {
      {"read", read_file},
      {"make", make},
      {"columns", read_columns},
      {"filter", filter},
      {"synthesize", synthesize_series},
      {"expand", expand},
      {"align", align_lines},
      {"blend", blend},
      {"unit", set_unit},
      {"smooth", smooth},
      {"transfer", transfer},
      {"simplify", simplify},
      {"repair", repair_lines},
      {"orient", orient_lines},
      {"reconstruct", reconstruct_lines},
      {"compress", compress},
      {"atlas_look", limit}};
  if (!step.is_object()) throw bad_request("a step is no object");
  const auto found = kSteps.find(string_of(step, "op"));
  if (found == kSteps.end()) throw bad_request("a step does what is not known");
  Reading reading = {.step = step, .before = before, .lines = {}};
  found->second(reading);
  return std::move(reading.lines);
}

}  // namespace rholm::studio
