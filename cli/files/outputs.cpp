#include "cli/files/outputs.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/capture.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "rholm/error.h"
#include "rholm/model.h"

namespace rholm::cli {
namespace {

[[noreturn]] void throw_unknown_format(const std::string& path, const std::string& known) {
  if (path == "-") throw UsageError("standard output has no extension; give --format");
  throw UsageError(
      fmt::format("'{}' has no known extension; use one of {}, or --format", path, known));
}

// Returns the metadata of the numbers as words.
std::string meaning_of(const Expansion& expansion, const Convention& convention) {
  const Vec3& c = expansion.center;
  std::string text = fmt::format("{}; function {}; centre ({}, {}, {})", text_of(convention),
                                 to_string(expansion.function), c.x, c.y, c.z);
  if (!expansion.unit.empty()) text += "; unit " + expansion.unit;
  if (!expansion.method.empty()) text += "; method " + expansion.method;
  if (expansion.gravity) text += "; " + text_of(*expansion.gravity);
  if (expansion.norm_squared || expansion.errors) text += "; their norm and errors are lost too";
  return text;
}

// Returns "-" for all names of standard output.
std::string output_named(const std::string& path) {
  const bool is_standard =
      path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
  return is_standard ? "-" : path;
}

// Returns true if the path names a pipe, a device or another special file.
bool is_special(const std::string& path) {
  struct stat status = {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

}  // namespace

Option output_option(std::string& path, const std::string& help, bool required) {
  return {.name = "output",
          .letter = 'o',
          .value = "OUT",
          .help = help,
          .target = &path,
          .required = required,
          .offer = Offer::kAnyFile,
          .meaning = output_named,
          .group = Group::kOutput};
}

Option format_option(std::string& format, std::vector<std::string> choices) {
  return {.name = "format",
          .help = "format of the output; by default the extension of the file decides",
          .target = &format,
          .choices = std::move(choices),
          .group = Group::kAdvanced};
}

Option ascii_option(bool& ascii, Holding holding) {
  return {
      .name = "ascii", .help = ascii_help(holding), .target = &ascii, .group = Group::kAdvanced};
}

std::vector<Option> mesh_output_options(std::string& path, std::string& format, bool& ascii) {
  return {output_option(path, fmt::format("mesh to write: {}; - for standard output",
                                          shape_extensions(Holding::kFaces))),
          format_option(format, shape_format_names(Holding::kFaces)), ascii_option(ascii)};
}

std::vector<Option> coefficients_output_options(CoefficientsOutputOptions& target,
                                                const std::string& what, bool required) {
  std::vector<Option> list = {
      output_option(target.output,
                    fmt::format("{}: {}; - for standard output", what, coefficients_extensions()),
                    required),
      format_option(target.format, coefficients_format_names())};
  append(list, convention_options(target.convention));
  append(list, input_convention_options(target.input_convention));
  list.push_back(json_option(target.json));
  return list;
}

void check_not_shared(const std::string& path, bool json) {
  if (path == "-" && json) {
    throw UsageError("-o - and --json both write to standard output; give -o a file name");
  }
}

ShapeFormat shape_output(const std::string& path, const std::string& format, bool json) {
  check_not_shared(path, json);
  for (const ShapeFormatInfo& known : shape_formats()) {
    if (!known.file.written) continue;
    if (!format.empty()) {
      if (format == known.file.name) return known.format;
    } else if (const FileExtension* extension = extension_of(known.file, path)) {
      if (path != "-" && !extension->read_only) return known.format;
    }
  }
  throw_unknown_format(path, shape_extensions());
}

ShapeFormat mesh_output(const std::string& path, const std::string& format, bool json) {
  const ShapeFormat found = shape_output(path, format, json);
  if (shape_format_info(found).faces) return found;
  throw UsageError(fmt::format(
      "{} has no faces, and a mesh has faces; use {}",
      format.empty() ? fmt::format("'{}' is a file of points, which", path) : "--format " + format,
      shape_extensions(Holding::kFaces, "or")));
}

ShapeFormat points_output(const std::string& path, const std::string& format, bool json) {
  const ShapeFormat found = shape_output(path, format, json);
  const ShapeFormatInfo& info = shape_format_info(found);
  if (info.points) return found;
  throw UsageError(fmt::format("{} has only faces and no points; use {}", info.file.title,
                               shape_extensions(Holding::kPoints, "or")));
}

CoefficientsOutput coefficients_output(const std::string& path, const std::string& format,
                                       bool json) {
  check_not_shared(path, json);
  for (const CoefficientsFormatInfo& known : coefficients_formats()) {
    const bool is_meant = format.empty() ? path != "-" && extension_of(known.file, path) != nullptr
                                         : format == known.file.name;
    if (!is_meant) continue;
    if (!known.format) check_rewindable(path);
    return {path, known.format};
  }
  if (!format.empty()) parse_coefficients_format(format);  // throws
  throw_unknown_format(path, coefficients_extensions());
}

void check_rewindable(const std::string& path) {
  if (path != "-" && !is_special(path)) return;
  throw UsageError(fmt::format(
      "a model file (HDF5) cannot be written to {}; give the name of a regular file",
      path == "-" ? "standard output" : fmt::format("'{}', which is a pipe or a device", path)));
}

void check_writable(const std::string& path) {
  if (path == "-" || path.empty()) return;
  if (is_special(path)) {
    if (::access(path.c_str(), W_OK) == 0) return;
    throw Error(ErrorCode::kIo,
                fmt::format("{} cannot be written: {}", path, std::strerror(errno)));
  }
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    // A missing file is fine; a missing folder is reported below. Only the writer would notice a
    // name that is too long, or a cycle of links.
    if (errno != ENOENT && errno != ENOTDIR && errno != EACCES) {
      throw Error(ErrorCode::kIo,
                  fmt::format("{} cannot be written: {}", path, std::strerror(errno)));
    }
  } else if (S_ISDIR(status.st_mode)) {
    throw Error(ErrorCode::kIo, fmt::format("{} cannot be written: it is a folder", path));
  }
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::kIo, fmt::format("{} cannot be written in folder {}: {}", path,
                                            folder.string(), std::strerror(errno)));
  }
}

void warn_of_output(const std::vector<std::string>& warnings, const std::string& path,
                    Session& session) {
  const std::string name = path == "-" ? "standard output" : path;
  for (const std::string& warning : warnings) session.warn(fmt::format("{}: {}", name, warning));
}

void write_shape_output(const Mesh& mesh, const std::string& path, const ShapeWriteOptions& options,
                        Session& session) {
  warn_of_output(write_shape(mesh, path, options, session.context()), path, session);
}

void write_shape_output(const PointCloud& cloud, const std::string& path,
                        const ShapeWriteOptions& options, Session& session) {
  warn_of_output(write_shape(cloud, path, options, session.context()), path, session);
}

void note_attributes_left_out(std::span<const Attribute> attributes, ShapeFormat format,
                              const std::string& path, Session& session) {
  const std::vector<std::string> lost = attributes_left_out(attributes, format);
  if (lost.empty()) return;
  session.note(fmt::format("{}: {} has no room for {}", display_name(path), to_string(format),
                           fmt::join(lost, ", ")));
}

void write_coefficients_output(const Expansion& expansion, const CoefficientsOutput& output,
                               const Convention& convention, Session& session) {
  stop_if_interrupted();
  if (Capture* listener = capture()) listener->expansion = expansion;
  if (!output.format) return write_model(expansion, output.path);
  write_coefficients(expansion, output.path, {output.format, convention});
  const std::string name = output.path == "-" ? "standard output" : output.path;
  const CoefficientsFormatInfo& info = coefficients_format_info(*output.format);
  if (!info.meaning) {
    session.note(fmt::format("{} has only numbers and does not state their meaning: {}", name,
                             meaning_of(expansion, convention)));
  } else if (expansion.errors && !info.errors) {
    session.note(fmt::format(
        "{} has no room for the errors of the model; a model file (.h5) stores them", name));
  }
}

std::optional<std::uintmax_t> file_size_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? std::nullopt : std::optional(size);
}

}  // namespace rholm::cli
