#include "rholm/shape_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/plain_text.h"
#include "io/file/atomic_file.h"
#include "io/file/bytes.h"
#include "io/shapes/shape_formats.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Returns the name of a common format that is not read, recognised by its first bytes, or null.
const char* foreign_format(std::span<const char> bytes) {
  struct Magic {
    std::string_view bytes;
    const char* name;
  };
  constexpr std::array<Magic, 6> kMagic = {
      {{"\x1f\x8b", "a gzip archive: unpack it first"},
       {"PK\x03\x04", "a zip archive (or 3MF): unpack it first"},
       {"glTF", "a binary glTF file"},
       {"\x89HDF", "an HDF5 file: coefficients or caps, no shape"},
       {"\xff\xfe", "UTF-16 text: convert it to UTF-8 first"},
       {"\xfe\xff", "UTF-16 text: convert it to UTF-8 first"}}};
  const std::string_view text(bytes.data(), bytes.size());
  for (const Magic& magic : kMagic) {
    if (text.starts_with(magic.bytes)) return magic.name;
  }
  return nullptr;
}

// Returns the first format of the table that the property `by` of the content identifies, or null.
const ShapeFormatLine* told(const ShapeSource& source, ToldBy by) {
  for (const ShapeFormatLine& line : shape_format_table()) {
    if (line.told_by == by && line.looks_like != nullptr && line.looks_like(source.bytes)) {
      return &line;
    }
  }
  return nullptr;
}

// Returns the formats for messages: "of shapes PLY and OBJ, and points as .xyz, can be read; ...".
std::string what_can_be_read() {
  std::vector<std::string> meshes, points, coefficients;
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (!format.file.read) continue;
    if (format.faces) {
      meshes.push_back(format.file.title);
      continue;
    }
    for (const FileExtension& extension : format.file.extensions) {
      points.push_back("." + extension.name);
    }
  }
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    coefficients.push_back(format.file.title);
  }
  return "of shapes " + listed(meshes, "and") + ", and points as " + listed(points, "or") +
         ", can be read; of coefficients " + listed(coefficients, "and");
}

// Returns the written formats for which this is true: "PLY, OBJ or OFF".
std::string titles_of(bool ShapeFormatInfo::*holds) {
  std::vector<std::string> titles;
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (format.file.written && format.*holds) titles.push_back(format.file.title);
  }
  return listed(titles, "or");
}

// Unmistakable content decides first, then the name, then rows of numbers, which many formats have.
const ShapeFormatLine& detect(const ShapeSource& source) {
  for (const ToldBy by : {ToldBy::kSignature, ToldBy::kFirstWord}) {
    if (const ShapeFormatLine* line = told(source, by)) return *line;
  }
  if (const char* foreign = foreign_format(source.bytes)) {
    throw Error(ErrorCode::kUnsupported, source.name + " is " + foreign);
  }
  if (const ShapeFormatLine* line = told(source, ToldBy::kLines)) return *line;
  if (const auto format = shape_format_of(source.name)) return line_of(*format);
  for (const ShapeFormatLine& line : shape_format_table()) {
    if (line.may_be != nullptr && line.may_be(source.bytes)) return line;
  }
  throw Error(ErrorCode::kUnsupported,
              source.name + " is in no known format: " + what_can_be_read());
}

void note_values_not_finite(ShapeFile& file) {
  const auto& attributes = std::holds_alternative<Mesh>(file.shape)
                               ? std::get<Mesh>(file.shape).attributes
                               : std::get<PointCloud>(file.shape).attributes;
  for (const Attribute& attribute : attributes) {
    const auto n = std::count_if(attribute.values.begin(), attribute.values.end(),
                                 [](double value) { return !std::isfinite(value); });
    if (n > 0) {
      file.warnings.push_back(not_finite_warning(attribute.name, static_cast<std::size_t>(n)));
    }
  }
}

void drop_points(const ShapeSource& source, PointCloud& cloud, ShapeFile& file) {
  file.dropped = drop_not_finite(cloud);
  if (file.dropped == 0) return;
  if (cloud.points.empty()) source.fail("has no point with finite coordinates");
  file.warnings.push_back(dropped_warning(file.dropped));
}

ShapeFile parse(std::span<const char> bytes, const std::string& name,
                const ShapeReadOptions& options, const Context& context, double progress_from) {
  const ShapeSource source(bytes, name, options, context, progress_from);
  if (source.bytes.empty()) source.fail("the file is empty");
  check_columns(options.columns);
  const ShapeFormatLine& format = detect(source);
  if (format.read == nullptr) {
    throw Error(ErrorCode::kUnsupported,
                name + ": " + format.info.file.title + " can be written, not read");
  }
  ShapeFile file = format.read(source);
  if (!options.columns.empty() && file.table.columns.empty()) {
    source.fail("is no table of points, and its columns cannot be said");
  }
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) drop_points(source, *cloud, file);
  note_values_not_finite(file);
  return file;
}

template <class Shape>
std::vector<std::string> write(const Shape& shape, const std::filesystem::path& path,
                               const ShapeWriteOptions& options, const Context& context) {
  validate(shape);
  return write_view(shape_view_of(shape), path, options, context);
}

}  // namespace

const ShapeFormatLine& line_of(ShapeFormat format) {
  const std::vector<ShapeFormatLine>& table = shape_format_table();
  const auto found = std::find_if(table.begin(), table.end(), [&](const ShapeFormatLine& line) {
    return line.info.format == format;
  });
  if (found != table.end()) return *found;
  throw Error(ErrorCode::kUnsupported,
              "no format of shapes has the number " + std::to_string(static_cast<int>(format)));
}

const std::vector<ShapeFormatInfo>& shape_formats() {
  static const std::vector<ShapeFormatInfo> formats = [] {
    std::vector<ShapeFormatInfo> all;
    for (const ShapeFormatLine& line : shape_format_table()) all.push_back(line.info);
    return all;
  }();
  return formats;
}

const ShapeFormatInfo& shape_format_info(ShapeFormat format) { return line_of(format).info; }

std::vector<std::string> held_by(const ShapeFormatInfo& format) {
  return words_of({{"faces", format.faces},
                   {"points", format.points},
                   {"normals", format.normals},
                   {"colors", format.colors},
                   {"alpha", format.alpha},
                   {"texture", format.texture},
                   {"any attributes", format.any_attributes},
                   {"double precision", !format.single_precision}});
}

const char* to_string(ShapeFormat format) { return line_of(format).info.file.name.c_str(); }

ShapeFormat parse_shape_format(const std::string& name) {
  std::vector<std::string> names;
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (name == format.file.name) return format.format;
    names.push_back(format.file.name);
  }
  throw Error(ErrorCode::kUnsupported,
              in_quotes(name) + " is not a format of shapes: " + listed(names, "or"));
}

std::optional<ShapeFormat> shape_format_of(const std::filesystem::path& path) {
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (extension_of(format.file, path) != nullptr) return format.format;
  }
  return std::nullopt;
}

std::optional<bool> is_shape_file(std::span<const char> beginning, const std::string& name) {
  const std::string_view head(beginning.data(), beginning.size());
  for (const ShapeFormatLine& line : shape_format_table()) {
    if (!line.mark.empty() && head.starts_with(line.mark)) return true;
  }
  if (looks_like_coefficients(beginning)) return false;
  const auto is_own = [&](const FileFormat& format) {
    const FileExtension* extension = extension_of(format, name);
    return extension != nullptr && !extension->shared;
  };
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (is_own(format.file)) return true;
  }
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (is_own(format.file)) return false;
  }
  return std::nullopt;
}

ShapeFile read_shape(const std::filesystem::path& path, const ShapeReadOptions& options,
                     const Context& context) {
  constexpr double kReadingPart = 0.3;  // part of the time, for text; less for binary files: chosen
  const Bytes bytes = read_bytes(path, context, kReadingPart);
  const std::string name = path == "-" ? "standard input" : path.string();
  return parse(bytes.view(), name, options, context, kReadingPart);
}

ShapeFile parse_shape(std::span<const char> bytes, const std::string& name,
                      const ShapeReadOptions& options, const Context& context) {
  return parse(bytes, name, options, context, 0);
}

ShapeFormat written_format(const std::filesystem::path& path, const ShapeWriteOptions& options) {
  const std::optional<ShapeFormat> format = options.format ? options.format : shape_format_of(path);
  if (!format && path == "-") {
    throw Error(ErrorCode::kInvalidInput, "standard output has no extension: name the format");
  }
  if (!format) {
    std::vector<std::string> names;
    for (const ShapeFormatInfo& known : shape_formats()) {
      if (known.file.written) names.push_back(known.file.name);
    }
    throw Error(ErrorCode::kUnsupported, path.string() + ": the extension names no format; " +
                                             listed(names, "and") + " can be written");
  }
  return *format;
}

std::vector<std::string> format_shape(const ShapeView& shape, ShapeFormat format,
                                      const ShapeWriting& how, OutputBuffer& out) {
  const ShapeFormatLine& line = line_of(format);
  const std::string& title = line.info.file.title;
  if (line.write == nullptr) {
    throw Error(ErrorCode::kUnsupported, how.name + ": " + title + " can be read, not written");
  }
  if (!line.info.points && !shape.is_mesh) {
    throw Error(ErrorCode::kUnsupported, how.name + ": " + title +
                                             " holds faces, not points; write " +
                                             titles_of(&ShapeFormatInfo::points));
  }
  if (!line.info.faces && shape.faces.size() > 0) {
    throw Error(ErrorCode::kUnsupported, how.name + ": " + title +
                                             " holds points, not faces; write " +
                                             titles_of(&ShapeFormatInfo::faces));
  }
  return line.write(shape, how, out);
}

std::vector<std::string> write_view(const ShapeView& shape, const std::filesystem::path& path,
                                    const ShapeWriteOptions& options, const Context& context) {
  const ShapeFormat format = written_format(path, options);
  AtomicFile file(path, context);
  OutputBuffer out(&file, shape.points.size() + shape.faces.size(), context);
  std::vector<std::string> warnings =
      format_shape(shape, format, {options.ascii, path.string()}, out);
  out.flush();
  file.commit();
  return warnings;
}

std::vector<std::string> write_shape(const Mesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options, const Context& context) {
  return write(mesh, path, options, context);
}

std::vector<std::string> write_shape(const PointCloud& cloud, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options, const Context& context) {
  return write(cloud, path, options, context);
}

}  // namespace rholm
