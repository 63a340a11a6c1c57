// rholm convert: the same data in another format or convention.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/plain_text.h"
#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/memory_needed.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/spooled_input.h"
#include "cli/grammar/parse.h"
#include "cli/options/convention.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/large_mesh.h"
#include "rholm/point_stream.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string output;
  std::string format;
  ConventionOptions to;
  InputConvention from;
  MemoryOptions memory;
  std::string columns;
  std::optional<double> gravity_constant, reference_radius;
  bool ascii = false;
};

// Reading points takes the file and the points. The worst case is 15 bytes, three floats and a
// colour, which become six doubles: together 4.2 times the file (scripts/memory-figures).
constexpr double kMemoryPerByte = 5;

std::vector<std::string> all_formats() {
  std::vector<std::string> formats = shape_format_names();
  for (const std::string& format : coefficients_format_names()) formats.push_back(format);
  return formats;
}

// Returns the format of --format or of the output's extension.
std::string named_format(const Options& options) {
  if (!options.format.empty()) return options.format;
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (extension_of(format.file, options.output) != nullptr) return format.file.name;
  }
  for (const ShapeFormatInfo& format : shape_formats()) {
    const FileExtension* extension = extension_of(format.file, options.output);
    if (extension != nullptr && !extension->read_only) return format.file.name;
  }
  return "";
}

bool is_one_of(const std::string& name, const std::vector<std::string>& formats) {
  return std::find(formats.begin(), formats.end(), name) != formats.end();
}

void convert_shape(const Options& options, const ShapeFile& file, Session& session) {
  const std::string wanted = named_format(options);
  if (is_one_of(wanted, coefficients_format_names()) &&
      (!options.format.empty() || !shape_format_of(options.output))) {
    throw UsageError(
        fmt::format("{} is a shape, and {} is a format of coefficients; compute them with 'rholm "
                    "expand {} --degree L -o {}'",
                    display_name(options.input), wanted, shell_word(options.input),
                    shell_word(options.output)));
  }
  const ShapeFormat format = shape_output(options.output, options.format);
  say_what_was_read(file, options.input, session);
  std::visit(
      [&](const auto& shape) {
        write_shape_output(shape, options.output, {format, options.ascii}, session);
        note_attributes_left_out(shape.attributes, format, options.output, session);
      },
      file.shape);
}

// Converts a mesh in a mapped binary PLY, with little memory. Returns false for any other input, or
// if the output is no shape.
bool convert_mapped(const Options& options, const std::string& path, Session& session) {
  if (!options.columns.empty() || !is_one_of(named_format(options), shape_format_names()))
    return false;
  const ShapeFormat format = shape_output(options.output, options.format);
  const std::optional<ConvertedMesh> mesh =
      convert_mesh(path, options.output, {format, options.ascii}, session.context());
  if (!mesh) return false;
  say_what_was_read({}, mesh->warnings, options.input, session);
  warn_of_output(mesh->written, options.output, session);
  note_attributes_left_out(mesh->attributes, format, options.output, session);
  return true;
}

// Returns the expansion with the gravity field of the options. Numbers without a stated meaning are
// taken as coefficients of that field.
Expansion expansion_of(const Options& options, const CoefficientsFile& file) {
  Expansion expansion = file.expansion;
  if (!options.gravity_constant) return expansion;
  const bool unsaid =
      std::find(file.assumed.begin(), file.assumed.end(), "function radius") != file.assumed.end();
  if (unsaid) expansion.function = RadialFunction::kOther;
  expansion.gravity = {*options.gravity_constant, *options.reference_radius};
  return expansion;
}

void convert_coefficients(const Options& options, const CoefficientsFile& file,
                          const Convention& convention, Session& session) {
  const std::string wanted = named_format(options);
  if (is_one_of(wanted, shape_format_names())) {
    throw UsageError(
        fmt::format("{} contains coefficients, and {} is a format of shapes; make a mesh with "
                    "'rholm synthesize {} -o {}'",
                    display_name(options.input), wanted, shell_word(options.input),
                    shell_word(options.output)));
  }
  const CoefficientsOutput output = coefficients_output(options.output, options.format);
  write_coefficients_output(expansion_of(options, file), output, convention, session);
}

// Returns true for points that are converted in portions. Binary points always are, because it
// takes no more time. Text is read twice, which takes half as long again.
bool are_read_in_pieces(const Options& options, const std::string& path, bool large) {
  const std::string wanted = named_format(options);
  if (!is_one_of(wanted, shape_format_names()) ||
      !shape_format_info(parse_shape_format(wanted)).in_pieces) {
    return false;
  }
  const bool spooled = path != options.input;
  const bool is_table = shape_format_of(path) && !coefficients_format_of(path);
  if (!is_shape(path).value_or(spooled || !options.columns.empty() || is_table)) return false;
  try {
    const PointStream stream(path, {.columns = options.columns});
    return !stream.has_faces() && (large || stream.is_all());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return false;  // the reader of the whole file reports the error
  }
}

// Converts points in portions; returns false if the input holds other data.
bool convert_in_pieces(const Options& options, const std::string& path, Session& session) {
  std::error_code none;
  const auto size = static_cast<double>(std::filesystem::file_size(path, none));
  const auto limit = static_cast<double>(options.memory.limit());
  if (none || !are_read_in_pieces(options, path, kMemoryPerByte * size > limit)) return false;
  const ShapeFormat format = shape_output(options.output, options.format);
  const ConvertedPoints converted = convert_points(path, options.output, {format, options.ascii},
                                                   session.context(), options.columns);
  say_what_was_read(converted.table, converted.warnings, options.input, session);
  note_attributes_left_out(converted.attributes, format, options.output, session);
  return true;
}

// Returns true if a shape was converted without reading it whole.
bool convert_in_place(const Options& options, const std::string& path, Session& session) {
  return convert_mapped(options, path, session) || convert_in_pieces(options, path, session);
}

// Reads the input, unless it was converted already. A stream that does not fit in a quarter of the
// memory is kept in a file.
std::optional<Input> rest_of_input(const Options& options, Session& session) {
  if (!is_stream(options.input)) {
    if (convert_in_place(options, options.input, session)) return {};
    require_to_read(options.input, options.memory);
    return read_input(options.input, session, options.from, options.columns);
  }
  SpooledInput spooled(options.input, options.memory.limit() / 4, options.memory.folder());
  if (!spooled.is_in_file()) {
    return read_input_of(spooled.take_bytes(), options.input, session, options.from,
                         options.columns);
  }
  const std::string path = spooled.path_of_file();
  try {
    if (convert_in_place(options, path, session)) return {};
  } catch (const Error& error) {
    std::string what = error.what();
    if (const std::size_t at = what.find(path); at != std::string::npos) {
      what.replace(at, path.size(), display_name(options.input));
    }
    throw Error(error.code(), what);
  }
  const std::span<const char> bytes = spooled.bytes();
  return read_input_of({bytes.begin(), bytes.end()}, options.input, session, options.from,
                       options.columns);
}

int run(const Options& options, Session& session) {
  const Convention convention = options.to.output_convention();
  if (options.output == "-" && options.format.empty()) {
    throw UsageError("standard output has no extension; give --format");
  }
  if (options.gravity_constant.has_value() != options.reference_radius.has_value()) {
    throw UsageError("--gravity-constant and --reference-radius must be given together");
  }
  const std::string wanted = named_format(options);
  const bool has_room = is_one_of(wanted, coefficients_format_names()) && holds_meaning(wanted);
  if (options.gravity_constant && !wanted.empty() && !has_room) {
    throw UsageError(
        fmt::format("--gravity-constant and --reference-radius apply to coefficients, and '{}' has "
                    "no room for them; write {}",
                    wanted, meaningful_extensions("or")));
  }
  check_writable(options.output);
  options.memory.keep(session);
  const std::optional<Input> input = rest_of_input(options, session);
  if (!input) return 0;
  stop_if_interrupted();
  if (const auto* shape = std::get_if<ShapeFile>(&*input)) {
    convert_shape(options, *shape, session);
  } else {
    convert_coefficients(options, std::get<CoefficientsFile>(*input), convention, session);
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
       .help = "file to write, or - for standard output with --format",
       .target = &o.output,
       .required = true,
       .offer = Offer::kAnyFile,
       .meaning = output_option(o.output, "").meaning}};
  append(list, convention_options(o.to));
  append(list, input_convention_options(o.from));
  append(list, {{.name = "override",
                 .help = "use --input-normalization and --input-csphase even if the file states "
                         "another convention",
                 .target = &o.from.override_file},
                format_option(o.format, all_formats()),
                {.name = "gravity-constant",
                 .value = "GM",
                 .help = fmt::format(
                     "gravity constant of the field of these coefficients, in m^3/s^2; by default "
                     "the constant of the input. {} store it, and other programs read it from .gfc",
                     meaningful_extensions("and")),
                 .target = &o.gravity_constant,
                 .above = 0},
                {.name = "reference-radius",
                 .value = "R",
                 .help = "reference radius of the same field, in m; with --gravity-constant",
                 .target = &o.reference_radius,
                 .above = 0},
                ascii_option(o.ascii),
                columns_option(o.columns)});
  append(list, memory_options(o.memory));
  return list;
}

}  // namespace

Command convert_command() {
  auto options = std::make_shared<Options>();
  return {.name = "convert",
          .summary = "Convert a file to another format or convention",
          .description = fmt::format(
              "Converts a file of coefficients, or a file of a shape, to another format. Formats "
              "of coefficients: {}. Formats of shapes: {}. A note names attributes that the format "
              "has no room "
              "for.\n\nConventions apply to text, JSON and NumPy files. A model file is always "
              "orthonormal without Condon-Shortley phase. If an input does not state its "
              "convention, --input-normalization and --input-csphase give it (4pi and 1 by "
              "default), and a note states the assumption.\n\nA mesh in a binary PLY file is not "
              "copied to memory. Points of a binary PLY file, and points that need more memory "
              "than --max-memory, are written while they are read, to PLY and XYZ.",
              coefficients_list(), shape_extensions()),
          .options =
              in_groups(option_list(*options),
                        {{Group::kOutput, {"normalization", "csphase"}},
                         {Group::kAdvanced, {"override", "gravity-constant", "reference-radius"}}}),
          .examples = {"rholm convert bumpy.h5 bumpy.sh --normalization schmidt",
                       "rholm convert bumpy.ply bumpy.obj"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
