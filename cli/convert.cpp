// rholm convert: the same data in another format or convention.
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
#include "cli/convention.h"
#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/parse.h"
#include "cli/session.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::string format;
  ConventionOptions to;
  ConventionOptions from;
  bool override_file = false;
  bool ascii = false;
};

std::vector<std::string> all_formats() {
  std::vector<std::string> formats = shape_formats();
  for (const std::string& format : coefficients_formats()) formats.push_back(format);
  return formats;
}

void convert_shape(const Options& options, const ShapeFile& file, Session& session) {
  const ShapeFormat format = shape_output(options.output, options.format);
  for (const std::string& warning : file.warnings) {
    session.warn(fmt::format("{}: {}", display_name(options.input), warning));
  }
  std::visit(
      [&](const auto& shape) {
        write_shape(shape, options.output, {format, options.ascii}, session.context());
      },
      file.shape);
}

void convert_coefficients(const Options& options, const CoefficientsFile& file,
                          const Convention& convention, Session& session) {
  const CoefficientsOutput output = coefficients_output(options.output, options.format);
  if (!file.assumed.empty()) {
    session.note(fmt::format("{} does not say it, assumed: {}", display_name(options.input),
                             fmt::join(file.assumed, ", ")));
  }
  write_coefficients_output(file.expansion, output, convention);
  // A NumPy file has no room to say it.
  if (output.format == CoefficientsFormat::kNpy) {
    session.note(fmt::format("{} is written with {}, which the file cannot say",
                             options.output == "-" ? "standard output" : options.output,
                             text_of(convention)));
  }
}

int run(const Options& options, Session& session) {
  const Convention convention = options.to.output_convention();
  const CoefficientsReadOptions reading{options.from.output_convention(), options.override_file};
  if (options.output == "-" && options.format.empty()) {
    throw UsageError("standard output has no extension: say --format");
  }
  check_writable(options.output);
  const Input input = read_input(options.input, session, reading);
  stop_if_interrupted();
  if (const auto* shape = std::get_if<ShapeFile>(&input)) {
    convert_shape(options, *shape, session);
  } else {
    convert_coefficients(options, std::get<CoefficientsFile>(input), convention, session);
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  return {{.name = "IN",
           .help = "file of coefficients or of a shape, or - for standard input",
           .target = &o.input,
           .required = true,
           .offer = Offer::kShapesAndCoefficients},
          {.name = "OUT",
           .help = "file to write; - for standard output, with --format",
           .target = &o.output,
           .required = true,
           .offer = Offer::kAnyFile},
          normalization_option(o.to.normalization, ""),
          csphase_option(o.to.csphase, ""),
          normalization_option(o.from.normalization, "input-"),
          csphase_option(o.from.csphase, "input-"),
          {.name = "override",
           .help = "believe --input-normalization and --input-csphase even where the file says "
                   "otherwise",
           .target = &o.override_file},
          format_option(o.format, all_formats()),
          {.name = "ascii", .help = "PLY and STL as text", .target = &o.ascii}};
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
              "room for.\n\nConventions are those of the text, JSON and NumPy files; a model "
              "file is always orthonormal without Condon-Shortley phase. Where an input does not "
              "say its convention, it is taken to be that of --input-normalization and "
              "--input-csphase (4pi and 1 by default), and what was assumed is said.",
          .options = option_list(*options),
          .examples = {"rholm convert bumpy.h5 bumpy.sh --normalization schmidt",
                       "rholm convert bumpy.ply bumpy.obj"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
