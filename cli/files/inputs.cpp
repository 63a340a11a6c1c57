#include "cli/files/inputs.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/plain_text.h"
#include "cli/files/input_descriptor.h"
#include "cli/files/paths.h"
#include "cli/files/spooled_input.h"
#include "cli/grammar/values.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/model.h"

namespace rholm::cli {
namespace {

using Bytes = std::vector<char>;

constexpr std::size_t kChunk = std::size_t{1} << 20;  // chosen: system calls cost little
constexpr std::size_t kHead = 4096;                   // enough for every signature and header

enum class Guess { kShape, kCoefficients, kModel, kUnknown };

// Returns at most `limit` bytes from the start of a file or stream.
Bytes read_bytes(const std::string& path, std::size_t limit) {
  InputDescriptor file(path);
  Bytes bytes;
  while (bytes.size() < limit) {
    const std::size_t old_size = bytes.size();
    bytes.resize(old_size + std::min(kChunk, limit - old_size));
    const std::size_t n = file.read(std::span(bytes).subspan(old_size));
    bytes.resize(old_size + n);
    if (n == 0) break;
  }
  return bytes;
}

// Guesses by the first bytes, or by the name if they do not tell.
Guess guess(std::span<const char> head, const std::string& path) {
  if (std::string_view(head.data(), head.size()).starts_with("\x89HDF\r\n\x1a\n")) {
    return Guess::kModel;
  }
  const std::optional<bool> shape = is_shape_file(head, path);
  if (!shape) return Guess::kUnknown;
  if (*shape) return Guess::kShape;
  // An extension alone makes neither coefficients of an empty file nor a model of other bytes.
  return head.empty() || is_model_name(path) ? Guess::kUnknown : Guess::kCoefficients;
}

// Returns "a gravity_field, no shape".
std::string not_a_shape(const CoefficientsFile& file) {
  const std::string product = file.expansion.gravity ? "gravity_field" : file.product;
  return product.empty() ? "no shape (its function is 'other')"
                         : fmt::format("a {}, no shape", product);
}

// A file that may be inspected several times: its bytes for a stream, otherwise its beginning.
struct Source {
  std::string path;
  std::optional<Bytes> stream;
  Guess guess = Guess::kUnknown;
  ShapeReadOptions reading = {};
};

// Inspects a file; with named columns it is a table of points.
Source look_at(const std::string& path, const std::string& columns = {}) {
  Source source{.path = path, .stream = {}, .reading = {.columns = columns}};
  Bytes head;
  if (is_stream(path)) {
    source.stream = read_bytes(path, std::numeric_limits<std::size_t>::max());
  } else {
    head = read_bytes(path, kHead);
  }
  source.guess =
      columns.empty() ? guess(source.stream ? *source.stream : head, path) : Guess::kShape;
  return source;
}

ShapeFile read_shape_of(const Source& source, Session& session) {
  if (source.stream) {
    return parse_shape(*source.stream, display_name(source.path), source.reading,
                       session.context());
  }
  return read_shape(source.path, source.reading, session.context());
}

// Notes the meaning of the numbers, once for each file.
void say_what_it_means(const CoefficientsFile& file, const std::string& path, Session& session,
                       const InputConvention& convention) {
  const std::vector<std::string> open = convention.left_open(file.assumed);
  if (!open.empty()) {
    session.note(fmt::format("{} does not state its convention; assumed: {}", display_name(path),
                             fmt::join(open, ", ")));
  }
  if (file.expansion.function == RadialFunction::kOther) {
    const std::string relative =
        file.expansion.gravity ? ", " + text_of(*file.expansion.gravity) : "";
    session.note(fmt::format("{} is {}; its coefficients are used unchanged{}{}{}",
                             display_name(path), not_a_shape(file), relative,
                             file.passed_over.empty() ? "" : ", without ",
                             fmt::join(file.passed_over, ", ")));
  }
}

CoefficientsFile read_coefficients_of(const Source& source, Session& session,
                                      const CoefficientsReadOptions& options) {
  if (source.stream && source.guess == Guess::kModel) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{} is a model file (HDF5), which cannot be read from a stream; give "
                            "the name of the file",
                            display_name(source.path)));
  }
  if (source.stream) {
    return parse_coefficients(*source.stream, display_name(source.path), options);
  }
  return read_any_coefficients(source.path, options, session.context());
}

void check_surface(const CoefficientsFile& file, const std::string& path) {
  if (file.expansion.function != RadialFunction::kOther) return;
  throw Error(ErrorCode::kUnsupported,
              fmt::format("{} is {}; its coefficients are not the radius of a surface, and only "
                          "'spectrum', 'filter', 'rotate' and 'convert' accept them{}",
                          display_name(path), not_a_shape(file),
                          file.product.empty()
                              ? ""
                              : "; if they are radii, write 'product_type shape' into its header"));
}

bool is_coefficients(Guess guess) {
  return guess == Guess::kCoefficients || guess == Guess::kModel;
}

void check_shape(Guess guess, const std::string& path) {
  if (!is_coefficients(guess)) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("{} contains coefficients, and a shape is needed; make one with 'rholm "
                          "synthesize {} -o OUT.ply'",
                          display_name(path), shell_word(path)));
}

CoefficientsFile read_file(const std::string& path, Session& session,
                           const InputConvention& convention) {
  const Source source = look_at(path);
  if (source.guess == Guess::kShape) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is a shape, and coefficients are needed; compute them with 'rholm "
                            "expand {} --degree L -o OUT.h5'",
                            display_name(path), shell_word(path)));
  }
  return read_coefficients_of(source, session, convention.reading());
}

Input read_either(const Source& source, Session& session, const InputConvention& convention) {
  if (source.guess == Guess::kShape) return read_shape_of(source, session);
  if (is_coefficients(source.guess)) {
    return read_coefficients_of(source, session, convention.reading());
  }
  // Bare text: lines `l m C S` are coefficients, any other lines are points.
  try {
    return read_coefficients_of(source, session, convention.reading());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kIo || error.code() == ErrorCode::kCancelled) throw;
    return read_shape_of(source, session);
  }
}

Input told(Input input, const std::string& path, Session& session,
           const InputConvention& convention) {
  if (const auto* file = std::get_if<CoefficientsFile>(&input)) {
    say_what_it_means(*file, path, session, convention);
  }
  return input;
}

}  // namespace

Option model_operand(std::string& path) {
  return {.name = "MODEL",
          .help = "file of coefficients, or - for standard input",
          .target = &path,
          .required = true,
          .offer = Offer::kCoefficients};
}

Option columns_option(std::string& columns) {
  return {.name = "columns",
          .value = "LIST",
          .help =
              "meaning of the columns of a text table, for example x,y,z,r,g,b,nx,ny,nz,-. Also a "
              "for opacity, and lat,lon,radius in degrees for x,y,z; - skips a column, and another "
              "word names an attribute; by default from the header and the values, with a note",
          .target = &columns,
          .check =
              [](const std::string& option, const std::string& text) {
                check_by(option, text, [&] { check_columns(text.empty() ? "," : text); });
              },
          .group = Group::kAdvanced};
}

Option mesh_operand(std::string& path) {
  return {.name = "MESH",
          .help = "file of a mesh, or - for standard input",
          .target = &path,
          .required = true,
          .offer = Offer::kShapes};
}

std::vector<char> read_all_bytes(const std::string& path) {
  return read_bytes(path, std::numeric_limits<std::size_t>::max());
}

ShapeFile read_shape_input(const std::string& path, Session& session, const std::string& columns) {
  const Source source = look_at(path, columns);
  check_shape(source.guess, path);
  return read_shape_of(source, session);
}

CoefficientsFile read_coefficients_input(const std::string& path, Session& session,
                                         const InputConvention& convention) {
  CoefficientsFile file = read_file(path, session, convention);
  say_what_it_means(file, path, session, convention);
  return file;
}

Expansion read_expansion(const std::string& path, Session& session,
                         const InputConvention& convention) {
  CoefficientsFile file = read_file(path, session, convention);
  check_surface(file, path);
  say_what_it_means(file, path, session, convention);
  return std::move(file.expansion);
}

Input read_input(const std::string& path, Session& session, const InputConvention& convention,
                 const std::string& columns) {
  return told(read_either(look_at(path, columns), session, convention), path, session, convention);
}

Input read_input_of(std::vector<char> bytes, const std::string& path, Session& session,
                    const InputConvention& convention, const std::string& columns) {
  Source source{.path = path, .stream = std::move(bytes), .reading = {.columns = columns}};
  source.guess = columns.empty() ? guess(*source.stream, path) : Guess::kShape;
  return told(read_either(source, session, convention), path, session, convention);
}

std::optional<bool> is_shape(const std::string& path) {
  const Guess what = guess(read_bytes(path, kHead), path);
  if (what == Guess::kUnknown) return {};
  return what == Guess::kShape;
}

Input read_surface_input(const std::string& path, Session& session,
                         const InputConvention& convention, const std::string& columns) {
  Input input = read_either(look_at(path, columns), session, convention);
  if (const auto* file = std::get_if<CoefficientsFile>(&input)) {
    check_surface(*file, path);
    say_what_it_means(*file, path, session, convention);
  }
  return input;
}

bool holds_atlas(const std::string& path) {
  std::error_code ignored;
  if (path == "-" || !std::filesystem::is_regular_file(path, ignored)) return false;
  try {
    return is_atlas_file(path);
  } catch (const Error&) {
    return false;  // the reader reports the error
  }
}

void say_what_was_read(const TableColumns& table, const std::vector<std::string>& warnings,
                       const std::string& path, Session& session) {
  if (!table.note.empty()) {
    const std::string text = fmt::format("{}: {}", display_name(path), table.note);
    table.unsure ? session.warn(text) : session.note(text);
  }
  for (const std::string& warning : warnings) {
    session.warn(fmt::format("{}: {}", display_name(path), warning));
  }
}

void say_what_was_read(const ShapeFile& file, const std::string& path, Session& session) {
  say_what_was_read(file.table, file.warnings, path, session);
}

Mesh mesh_of(ShapeFile file, const std::string& path, Session& session) {
  say_what_was_read(file, path, session);
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} contains {} points without faces, and a mesh is needed; make one "
                            "with 'rholm reconstruct'",
                            display_name(path), cloud->points.size()));
  }
  return std::get<Mesh>(std::move(file.shape));
}

Mesh read_mesh(const std::string& path, Session& session) {
  return mesh_of(read_shape_input(path, session), path, session);
}

ShapeFile read_shape_of(std::span<const char> bytes, const std::string& path, Session& session,
                        const std::string& columns) {
  if (columns.empty()) check_shape(guess(bytes.first(std::min(kHead, bytes.size())), path), path);
  return parse_shape(bytes, display_name(path), {.columns = columns}, session.context());
}

Mesh read_mesh_of(std::span<const char> bytes, const std::string& path, Session& session) {
  return mesh_of(read_shape_of(bytes, path, session), path, session);
}

}  // namespace rholm::cli
