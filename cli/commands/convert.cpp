// rholm convert: the same data in another format or convention.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/grammar/parse.h"
#include "cli/options/convention.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::string format;
  ConventionOptions to;
  InputConvention from;
  bool ascii = false;
};

std::vector<std::string> all_formats() {
  std::vector<std::string> formats = shape_formats();
  for (const std::string& format : coefficients_formats()) formats.push_back(format);
  return formats;
}

// What --format or the extension of the output names.
std::string named_format(const Options& options) {
  if (!options.format.empty()) return options.format;
  const std::string extension = extension_of(options.output);
  if (extension == ".h5") return "h5";
  if (const auto format = coefficients_format_of("x" + extension)) return to_string(*format);
  return extension.empty() ? extension : extension.substr(1);
}

bool is_one_of(const std::string& name, const std::vector<std::string>& formats) {
  return std::find(formats.begin(), formats.end(), name) != formats.end();
}

void convert_shape(const Options& options, const ShapeFile& file, Session& session) {
  const std::string wanted = named_format(options);
  if (is_one_of(wanted, coefficients_formats()) && extension_of(options.output) != ".txt") {
    throw UsageError(
        fmt::format("{} is a shape and {} a format of coefficients: 'rholm analyze {} "
                    "--degree L -o {}' finds them",
                    display_name(options.input), wanted, options.input, options.output));
  }
  const ShapeFormat format = shape_output(options.output, options.format);
  for (const std::string& warning : file.warnings) {
    session.warn(fmt::format("{}: {}", display_name(options.input), warning));
  }
  std::visit(
      [&](const auto& shape) {
        write_shape(shape, options.output, {format, options.ascii}, session.context());
        note_attributes_left_out(shape.attributes, format, options.output, session);
      },
      file.shape);
}

void convert_coefficients(const Options& options, const CoefficientsFile& file,
                          const Convention& convention, Session& session) {
  const std::string wanted = named_format(options);
  if (is_one_of(wanted, shape_formats())) {
    throw UsageError(
        fmt::format("{} holds coefficients and {} is a format of shapes: 'rholm "
                    "synthesize {} -o {}' makes their surface",
                    display_name(options.input), wanted, options.input, options.output));
  }
  const CoefficientsOutput output = coefficients_output(options.output, options.format);
  write_coefficients_output(file.expansion, output, convention, session);
}

int run(const Options& options, Session& session) {
  const Convention convention = options.to.output_convention();
  if (options.output == "-" && options.format.empty()) {
    throw UsageError("standard output has no extension: say --format");
  }
  check_writable(options.output);
  const Input input = read_input(options.input, session, options.from);
  stop_if_interrupted();
  if (const auto* shape = std::get_if<ShapeFile>(&input)) {
    convert_shape(options, *shape, session);
  } else {
    convert_coefficients(options, std::get<CoefficientsFile>(input), convention, session);
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {
      {.name = "IN",
       .help = "file of coefficients or of a shape, or - for standard input",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      {.name = "OUT",
       .help = "file to write; - for standard output, with --format",
       .target = &o.output,
       .required = true,
       .offer = Offer::kAnyFile}};
  append(list, convention_options(o.to));
  append(list, input_convention_options(o.from));
  append(list, {{.name = "override",
                 .help = "believe --input-normalization and --input-csphase even where the file "
                         "says otherwise",
                 .target = &o.from.override_file},
                format_option(o.format, all_formats()),
                {.name = "ascii", .help = "PLY and STL as text", .target = &o.ascii}});
  return list;
}

}  // namespace

Command convert_command() {
  auto options = std::make_shared<Options>();
  return {.name = "convert",
          .summary = "The same data in another format or convention",
          .description =
              "Coefficients become coefficients: model file (.h5), SHTOOLS text (.sh, .txt, "
              ".shtools), ICGEM-like text (.gfc, .icgem), JSON (.json), NumPy (.npy). Shapes "
              "become shapes: .ply, .obj, .off, .stl, .xyz, with the attributes the format has "
              "room for; what is left out is said.\n\nConventions are those of the text, JSON and "
              "NumPy files; a model "
              "file is always orthonormal without Condon-Shortley phase. Where an input does not "
              "say its convention, it is taken to be that of --input-normalization and "
              "--input-csphase (4pi and 1 by default), and what was assumed is said.",
          .options = option_list(*options),
          .examples = {"rholm convert bumpy.h5 bumpy.sh --normalization schmidt",
                       "rholm convert bumpy.ply bumpy.obj"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
