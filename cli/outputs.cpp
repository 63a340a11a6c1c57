#include "cli/outputs.h"

#include <errno.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/parse.h"
#include "rholm/error.h"
#include "rholm/model.h"

namespace rholm::cli {
namespace {

constexpr const char* kModelFormat = "h5";

[[noreturn]] void throw_unknown_format(const std::string& path, const std::string& known) {
  if (path == "-") throw UsageError("standard output has no extension: say --format");
  throw UsageError(fmt::format(
      "'{}' has no extension that names a format; known are {}, or say --format", path, known));
}

}  // namespace

Option output_option(std::string& path, const std::string& help, bool required) {
  return {.name = "output",
          .letter = 'o',
          .value = "OUT",
          .help = help,
          .target = &path,
          .required = required,
          .offer = Offer::kAnyFile};
}

Option format_option(std::string& format, std::vector<std::string> choices) {
  return {.name = "format",
          .help = "format of the output, instead of the one its extension names",
          .target = &format,
          .choices = std::move(choices)};
}

std::vector<std::string> shape_formats() { return {"ply", "obj", "off", "stl", "xyz"}; }

std::vector<std::string> coefficients_formats() {
  return {kModelFormat, "shtools", "icgem", "json", "npy"};
}

void check_not_shared(const std::string& path, bool json) {
  if (path == "-" && json) {
    throw UsageError("-o - and --json both want standard output: give one of them a file");
  }
}

ShapeFormat shape_output(const std::string& path, const std::string& format, bool json) {
  check_not_shared(path, json);
  std::string name = format;
  if (name.empty() && path != "-") {
    const std::string extension = extension_of(path);
    name =
        extension == ".pwn" || extension == ".txt" ? "xyz" : extension.substr(!extension.empty());
  }
  for (const std::string& known : shape_formats()) {
    if (name == known) return parse_shape_format(name);
  }
  throw_unknown_format(path, ".ply, .obj, .off, .stl, .xyz");
}

CoefficientsOutput coefficients_output(const std::string& path, const std::string& format,
                                       bool json) {
  check_not_shared(path, json);
  const bool by_name = format.empty() && path != "-";
  if (format == kModelFormat || (by_name && extension_of(path) == ".h5")) {
    if (path == "-") throw UsageError("a model file (HDF5) cannot go to standard output");
    return {path, std::nullopt};
  }
  if (!format.empty()) return {path, parse_coefficients_format(format)};
  const auto known = by_name ? coefficients_format_of(path) : std::nullopt;
  if (!known) throw_unknown_format(path, ".h5, .sh, .gfc, .json, .npy");
  return {path, known};
}

void check_writable(const std::string& path) {
  if (path == "-" || path.empty()) return;
  if (std::filesystem::is_directory(path)) {
    throw Error(ErrorCode::kIo, fmt::format("{} cannot be written: it is a folder", path));
  }
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::kIo, fmt::format("{} cannot be written: folder {}: {}", path,
                                            folder.string(), std::strerror(errno)));
  }
}

void write_coefficients_output(const Expansion& expansion, const CoefficientsOutput& output,
                               const Convention& convention) {
  stop_if_interrupted();
  if (output.format) {
    write_coefficients(expansion, output.path, {output.format, convention});
  } else {
    write_model(expansion, output.path);
  }
}

std::optional<std::uintmax_t> file_size_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? std::nullopt : std::optional(size);
}

}  // namespace rholm::cli
