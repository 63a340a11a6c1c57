#include "rholm/shape_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/file/bytes.h"
#include "io/shapes/plate_table.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/error.h"

namespace rholm {
namespace {

struct FormatEntry {
  ShapeFormat format;
  const char* name;
  ShapeFile (*read)(const ShapeSource&);
};
constexpr std::array<FormatEntry, 5> kFormats = {{{ShapeFormat::kPly, "ply", read_ply},
                                                  {ShapeFormat::kObj, "obj", read_obj},
                                                  {ShapeFormat::kOff, "off", read_off},
                                                  {ShapeFormat::kStl, "stl", read_stl},
                                                  {ShapeFormat::kXyz, "xyz", read_xyz}}};

const FormatEntry& entry(ShapeFormat format) {
  return *std::find_if(kFormats.begin(), kFormats.end(),
                       [format](const FormatEntry& e) { return e.format == format; });
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension.empty() ? extension : extension.substr(1);
}

std::optional<ShapeFormat> format_of_extension(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  for (const FormatEntry& e : kFormats) {
    if (extension == e.name) return e.format;
  }
  for (const char* points : {"pwn", "txt", "csv", "asc", "pts"}) {
    if (extension == points) return ShapeFormat::kXyz;
  }
  return std::nullopt;
}

// Names of formats that are often met and not read, by their first bytes.
const char* foreign_format(std::span<const char> bytes) {
  struct Magic {
    std::string_view bytes;
    const char* name;
  };
  constexpr std::array<Magic, 6> kMagic = {
      {{"\x1f\x8b", "a gzip archive: unpack it first"},
       {"PK\x03\x04", "a zip archive (or 3MF): unpack it first"},
       {"glTF", "a binary glTF file"},
       {"\x89HDF", "an HDF5 file"},
       {"\xff\xfe", "UTF-16 text: convert it to UTF-8 first"},
       {"\xfe\xff", "UTF-16 text: convert it to UTF-8 first"}}};
  const std::string_view text(bytes.data(), bytes.size());
  for (const Magic& magic : kMagic) {
    if (text.starts_with(magic.bytes)) return magic.name;
  }
  return nullptr;
}

// What cannot be mistaken comes first, then the name, then rows of numbers, which may be much else.
ShapeFormat detect(const ShapeSource& source) {
  if (looks_like_ply(source.bytes)) return ShapeFormat::kPly;
  if (looks_like_stl(source.bytes)) return ShapeFormat::kStl;
  if (looks_like_off(source.bytes)) return ShapeFormat::kOff;
  if (const char* foreign = foreign_format(source.bytes)) {
    throw Error(ErrorCode::kUnsupported, source.name + " is " + foreign);
  }
  if (looks_like_obj(source.bytes)) return ShapeFormat::kObj;
  if (const auto format = format_of_extension(source.name)) return *format;
  if (may_be_stl(source.bytes)) return ShapeFormat::kStl;
  if (looks_like_plate_table(source.bytes) || looks_like_xyz(source.bytes))
    return ShapeFormat::kXyz;
  throw Error(
      ErrorCode::kUnsupported,
      source.name +
          " is in no known format: of shapes PLY, OBJ, OFF, STL and points as XYZ, PWN, PTS, "
          "TXT or CSV can be read; of coefficients models (.h5), SHTOOLS, ICGEM, JSON and "
          "NumPy");
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
  if (source.bytes.empty()) source.fail("is empty");
  check_columns(options.columns);
  ShapeFile file = entry(detect(source)).read(source);
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

const char* to_string(ShapeFormat format) { return entry(format).name; }

ShapeFormat parse_shape_format(const std::string& name) {
  for (const FormatEntry& e : kFormats) {
    if (name == e.name) return e.format;
  }
  throw Error(ErrorCode::kUnsupported,
              in_quotes(name) + " is not a format of shapes: ply, obj, off, stl or xyz");
}

ShapeFile read_shape(const std::filesystem::path& path, const ShapeReadOptions& options,
                     const Context& context) {
  constexpr double kReadingPart = 0.3;  // of the time, for text; less for binary files: chosen
  const Bytes bytes = read_bytes(path, context, kReadingPart);
  const std::string name = path == "-" ? "standard input" : path.string();
  return parse(bytes.view(), name, options, context, kReadingPart);
}

ShapeFile parse_shape(std::span<const char> bytes, const std::string& name,
                      const ShapeReadOptions& options, const Context& context) {
  return parse(bytes, name, options, context, 0);
}

ShapeFormat written_format(const std::filesystem::path& path, const ShapeWriteOptions& options) {
  const std::optional<ShapeFormat> format =
      options.format ? options.format : format_of_extension(path);
  if (!format && path == "-") {
    throw Error(ErrorCode::kInvalidInput, "standard output has no extension: name the format");
  }
  if (!format) {
    throw Error(ErrorCode::kUnsupported,
                path.string() +
                    ": the extension names no format; ply, obj, off, stl and xyz can be "
                    "written");
  }
  return *format;
}

std::vector<std::string> write_view(const ShapeView& shape, const std::filesystem::path& path,
                                    const ShapeWriteOptions& options, const Context& context) {
  const ShapeFormat format = written_format(path, options);
  AtomicFile file(path, context);
  OutputBuffer out(&file, shape.points.size() + shape.triangles.size(), context);
  std::vector<std::string> warnings =
      format_shape(shape, format, options.ascii, path.string(), out);
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
