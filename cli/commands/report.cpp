// rholm report: a report of a model on one page.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/page_folder.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/options/tolerance_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/file.h"
#include "rholm/model.h"
#include "rholm/report.h"

namespace rholm::cli {
namespace {

constexpr int kDefaultDegree = 64;

struct Options {
  std::string input;
  std::string shape;
  std::optional<int> degree;
  ToleranceOptions tolerance;
  std::string center;
  double weld = 0;
  std::string length_unit;
  ReportOptions page;  // only the size of its pictures
  bool interactive = false;
  std::string output;
  std::string format;
  InputConvention convention;
};

// Contents of the page.
struct Subject {
  Expansion expansion;
  std::optional<Mesh> shape;
  ReportOptions page;
  std::string complaint;  // unmet tolerance, for the page and the final error
};

void check_options(const Options& options) {
  const std::string extension = extension_of(options.output);
  if (options.output == "-" && options.format.empty()) {
    throw UsageError("standard output has no extension; give --format html");
  }
  if (options.output != "-" && options.format.empty() && extension != ".html" &&
      extension != ".htm") {
    throw UsageError(fmt::format("'{}' must end in .html or .htm", options.output));
  }
  if (options.degree && options.tolerance.tolerance) {
    throw UsageError("--degree and --tolerance exclude each other; give only one of the two");
  }
  if (options.shape == "-" && options.input == "-") {
    throw UsageError("standard input can be only one of the model and --shape");
  }
}

// Quotes a word for a shell.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("_-./:,+=@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// Returns " --name VALUE".
std::string option_text(const std::string& name, const std::string& value) {
  return fmt::format(" --{} {}", name, quoted(value));
}

std::string tolerance_text(const ToleranceOptions& options) {
  return option_text("tolerance", fmt::format("{}", *options.tolerance)) + given_text(options.rest);
}

// Returns the options that turn a shape into coefficients, as in expand.
std::string analysis_text(const Options& options) {
  std::string text =
      options.tolerance.tolerance
          ? tolerance_text(options.tolerance)
          : option_text("degree", std::to_string(options.degree.value_or(kDefaultDegree)));
  if (!options.center.empty()) text += option_text("center", options.center);
  if (options.weld > 0) text += option_text("weld", fmt::format("{}", options.weld));
  if (!options.length_unit.empty()) text += option_text("length-unit", options.length_unit);
  return text;
}

std::string page_command(const Options& options, const std::string& choices) {
  std::string text = "rholm report " + quoted(options.input) + choices;
  const int size = options.page.picture_size;
  if (size != ReportOptions{}.picture_size) {
    text += option_text("size", std::to_string(size));
  }
  if (options.interactive) text += " --interactive";
  if (!options.format.empty()) text += option_text("format", options.format);
  return text + " -o " + quoted(options.output);
}

std::string name_of(const std::string& path) {
  return path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
}

ExpandOptions expand_options(const Options& options) {
  ExpandOptions wanted;
  wanted.degree = options.degree.value_or(kDefaultDegree);
  wanted.tolerance = options.tolerance.parsed();
  wanted.chart.center = parse_center_option(options.center.empty() ? "auto" : options.center);
  wanted.weld_tolerance = options.weld;
  return wanted;
}

// Records an unmet tolerance: on the page and, after it is written, as an error.
void not_kept(const std::string& what, Subject& subject) {
  subject.page.notes.push_back("Note: " + what + ".");
  subject.complaint += (subject.complaint.empty() ? "" : "; ") + what;
}

void add_verdicts(const Expanded& expanded, const ExpandOptions& wanted, Subject& subject) {
  const std::optional<FastReport>& fast = expanded.transform.fast;
  if (fast && !fast->reached) {
    not_kept(fmt::format("the error of the coefficients is {}, and the wanted error is {}; 'rholm "
                         "expand --engine direct' makes an exact model",
                         text_of(fast->error), text_of(wanted.precision)),
             subject);
  }
  if (!expanded.tolerance) return;
  const ToleranceReport& tolerance = *expanded.tolerance;
  const int degree = expanded.transform.expansion.coefficients.degree();
  const std::string error = fmt::format("{} error ({})", to_string(wanted.tolerance->norm),
                                        to_string(wanted.tolerance->measure));
  if (!tolerance.met) {
    not_kept(fmt::format("the tolerance of {} was not reached by degree {}: the {} is {}",
                         text_of(tolerance.allowed), degree, error, text_of(tolerance.reached)),
             subject);
  } else {
    subject.page.notes.push_back(
        fmt::format("Degree {} is the smallest whose {} is within the tolerance of {}: it is {}.",
                    degree, error, text_of(tolerance.allowed), text_of(tolerance.reached)));
  }
  // The plots show the radius over solid angle.
  if (wanted.tolerance->norm == ErrorNorm::kRms &&
      wanted.tolerance->measure == ErrorMeasure::kRadius && tolerance.allowed > 0) {
    subject.page.tolerance = tolerance.allowed;
  }
}

Subject subject_of_shape(const Options& options, Mesh mesh, Session& session) {
  if (!options.shape.empty()) {
    throw UsageError(fmt::format("{} is a shape; --shape needs coefficients as input",
                                 display_name(options.input)));
  }
  Expanded expanded = expand(mesh, expand_options(options), session.context());
  if (expanded.flipped) session.note(kFlipped);
  Subject subject;
  add_verdicts(expanded, expand_options(options), subject);
  subject.expansion = std::move(expanded.transform.expansion);
  subject.expansion.unit = options.length_unit;
  subject.shape = std::move(mesh);
  subject.page.shape_name = name_of(options.input);
  const std::string choices = analysis_text(options);
  const std::string model = options.input == "-"
                                ? "model.h5"
                                : std::filesystem::path(options.input).stem().string() + ".h5";
  subject.page.commands = {
      {"The model", "rholm expand " + quoted(options.input) + choices + " -o " + quoted(model)},
      {"This page", page_command(options, choices)}};
  return subject;
}

// Returns the command that makes such a model from the shape. The model file does not store the
// precision.
std::optional<ReportCommand> model_command(const Options& options, const Expansion& expansion) {
  const std::vector<std::string> known = {"edge", "gauge", "curl", "area"};
  if (options.shape.empty() || std::count(known.begin(), known.end(), expansion.method) == 0) {
    return std::nullopt;
  }
  const Vec3& c = expansion.center;
  std::string text = "rholm expand " + quoted(options.shape) +
                     option_text("degree", std::to_string(expansion.coefficients.degree()));
  if (expansion.method != "edge") text += option_text("method", expansion.method);
  text += " --center=" + quoted(fmt::format("{},{},{}", c.x, c.y, c.z));
  if (options.weld > 0) text += option_text("weld", fmt::format("{}", options.weld));
  if (!expansion.unit.empty()) text += option_text("length-unit", expansion.unit);
  return ReportCommand{"A model of the same degree, method and centre",
                       text + " -o " + quoted(options.input)};
}

Subject subject_of_model(const Options& options, CoefficientsFile file, Session& session) {
  if (options.degree || options.tolerance.tolerance || !options.center.empty() ||
      !options.length_unit.empty()) {
    throw UsageError(
        fmt::format("{} contains coefficients; --degree, --tolerance, --center and --length-unit "
                    "apply to shapes, which are expanded first",
                    display_name(options.input)));
  }
  Subject subject;
  for (const std::string& assumed : file.assumed) {
    subject.page.notes.push_back(
        fmt::format("The file of coefficients does not state everything; assumed: {}.", assumed));
  }
  subject.expansion = std::move(file.expansion);
  std::string choices;
  if (!options.shape.empty()) {
    subject.shape = read_mesh(options.shape, session);
    subject.page.shape_name = name_of(options.shape);
    choices = option_text("shape", options.shape);
    if (options.weld > 0) choices += option_text("weld", fmt::format("{}", options.weld));
  }
  if (const auto command = model_command(options, subject.expansion)) {
    subject.page.commands.push_back(*command);
  }
  subject.page.commands.push_back({"This page", page_command(options, choices)});
  return subject;
}

Subject subject_of(const Options& options, Session& session) {
  Input input = read_surface_input(options.input, session, options.convention);
  if (auto* file = std::get_if<ShapeFile>(&input)) {
    return subject_of_shape(options, mesh_of(std::move(*file), options.input, session), session);
  }
  return subject_of_model(options, std::move(std::get<CoefficientsFile>(input)), session);
}

// Returns the command that makes a model within the same tolerance of the shape.
std::optional<ReportCommand> atlas_command(const Options& options, const AtlasModel& model) {
  if (options.shape.empty() || !(model.tolerance > 0)) return std::nullopt;
  std::string text = "rholm compress " + quoted(options.shape) +
                     option_text("tolerance", fmt::format("{}", model.tolerance));
  if (!model.unit.empty()) text += option_text("length-unit", model.unit);
  return ReportCommand{"A model within the same tolerance", text + " -o " + quoted(options.input)};
}

std::string page_of_atlas(const Options& options, Session& session) {
  if (options.interactive) {
    throw UsageError(
        fmt::format("{} contains an atlas of caps; --interactive applies to expansions",
                    display_name(options.input)));
  }
  if (options.degree || options.tolerance.tolerance || !options.center.empty() ||
      options.weld > 0 || !options.length_unit.empty()) {
    throw UsageError(
        fmt::format("{} contains an atlas of caps; --degree, --tolerance, --center, --weld and "
                    "--length-unit apply to shapes, which are expanded first",
                    display_name(options.input)));
  }
  const AtlasModel model = read_atlas(options.input);
  std::optional<Mesh> shape;
  ReportOptions page{.title = name_of(options.input), .shape_name = {}};
  page.picture_size = options.page.picture_size;
  page.file_bytes = file_size_of(options.input);
  std::string choices;
  if (!options.shape.empty()) {
    shape = read_mesh(options.shape, session);
    page.shape_name = name_of(options.shape);
    choices = option_text("shape", options.shape);
  }
  if (const auto command = atlas_command(options, model)) page.commands.push_back(*command);
  page.commands.push_back({"This page", page_command(options, choices)});
  return report_html(model, shape ? &*shape : nullptr, page, session.context());
}

int run(const Options& options, Session& session) {
  check_options(options);
  expand_options(options);  // refuses wrong values before anything is read
  check_writable(options.output);
  const std::string viewer = options.interactive ? viewer_script() : "";
  if (holds_atlas(options.input)) {
    const std::string page = page_of_atlas(options, session);
    stop_if_interrupted();
    write_file(options.output, page);
    return 0;
  }
  Subject subject = subject_of(options, session);
  subject.page.title = name_of(options.input);
  subject.page.weld_tolerance = options.weld;
  subject.page.picture_size = options.page.picture_size;
  subject.page.viewer = viewer;
  const std::string page = report_html(subject.expansion, subject.shape ? &*subject.shape : nullptr,
                                       subject.page, session.context());
  stop_if_interrupted();
  write_file(options.output, page);
  if (!subject.complaint.empty()) throw Error(ErrorCode::kNotConverged, subject.complaint);
  return 0;
}

std::vector<Option> input_options(Options& o) {
  return {
      {.name = "INPUT",
       .help = "file of coefficients, of an atlas, or of a closed mesh, or - for standard input",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      {.name = "shape",
       .value = "SHAPE",
       .help = "mesh of which the input is a model, for its picture, a map of the differences and "
               "the largest errors",
       .target = &o.shape,
       .offer = Offer::kShapes},
      {.name = "degree",
       .value = "L",
       .help = "degree to which a mesh is expanded; 64 by default",
       .target = &o.degree,
       .min = 0,
       .max = kMaxDegree}};
}

std::vector<Option> shape_and_page_options(Options& o) {
  Option size = field_option_of(o.page, "picture_size");
  size.name = "size";
  return {
      center_option(o.center),
      weld_option(o.weld),
      length_unit_option(o.length_unit),
      size,
      {.name = "interactive",
       .help =
           "add the surface of an expansion, which the reader can turn and cut off at any degree",
       .target = &o.interactive},
      output_option(o.output, "page to write: .html; - for standard output"),
      format_option(o.format, {"html"})};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = input_options(o);
  append(list, tolerance_options(o.tolerance));
  append(list, shape_and_page_options(o));
  append(list, input_convention_options(o.convention));
  return list;
}

}  // namespace

Command report_command() {
  auto options = std::make_shared<Options>();
  return {.name = "report",
          .summary = "Write a web page about a model, with pictures",
          .description =
              "Writes an HTML page about a model that needs no other file and no network. It shows "
              "pictures, a map of the errors, the spectrum, a table of degrees and errors, and the "
              "commands that make the model again.\n\nA mesh is first expanded by the method edge. "
              "Coefficients and atlases are taken unchanged; --shape adds a comparison with their "
              "mesh. With --interactive the reader can turn the surface and choose its degree. The "
              "page contains no date: the same input gives the same bytes. It fits screens of any "
              "width, and paper.",
          .options =
              in_groups(option_list(*options), {{Group::kAccuracy, {"degree", "tolerance", "unit"}},
                                                {Group::kOutput, {"interactive", "size"}},
                                                {Group::kAdvanced, {"length-unit"}}}),
          .examples = {"rholm report bumpy.ply --degree 32 -o report.html",
                       "rholm report bumpy.h5 --shape bumpy.ply -o report.html"},
          .run = [options](Session& session) { return run(*options, session); },
          .if_not_star = "Make a model with 'rholm compress' and report on it with --shape"};
}

}  // namespace rholm::cli
