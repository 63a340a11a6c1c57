// File formats, as listed in options, help, messages, pages and documents. Layer: io.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients_io.h"
#include "rholm/shape_io.h"

namespace rholm {

// A filename extension of a format.
struct FileExtension {
  std::string name = {};   // lower case, without dot: "ply"
  bool shared = false;     // other kinds of files use it too, so it does not identify the format
  bool read_only = false;  // accepted for reading, not for new files
};
// A file format.
struct FileFormat {
  std::string name = {};                       // name in options and reports: "ply"
  std::string title = {};                      // name for people: "PLY"
  std::vector<FileExtension> extensions = {};  // new files get the first one
  bool text = false;                           // text files are supported
  bool binary = false;                         // binary files are supported
  bool read = false;                           // the format can be read
  bool written = false;                        // the format can be written
  std::string help = {};                       // description, one sentence
};
// Returns the extension of the format that `path` has, in small or capital letters; null if none.
// Valid as long as `format`.
const FileExtension* extension_of(const FileFormat& format, const std::filesystem::path& path);

// A format of shapes, and the contents of its files when written.
struct ShapeFormatInfo {
  ShapeFormat format = ShapeFormat::kPly;  // the enum value
  FileFormat file = {};                    // names, extensions, read and write support
  bool faces = false;                      // faces between vertices
  bool points = false;                     // points without faces
  bool normals = false;                    // normals of points or vertices
  bool colors = false;                     // red, green, blue of points or vertices
  bool alpha = false;                      // opacity of these colours
  bool texture = false;                    // texture coordinates
  bool any_attributes = false;             // attributes of any name and type
  bool single_precision = false;           // coordinates in binary files are floats, not doubles
  bool in_pieces = false;  // points can be read and written in portions (point_stream.h)
};
// Returns all formats of shapes, in the order of listings.
const std::vector<ShapeFormatInfo>& shape_formats();
// Returns the description of one format.
const ShapeFormatInfo& shape_format_info(ShapeFormat format);
// Returns the contents of files of the format: "faces", "points", "normals", "colors", ...
std::vector<std::string> held_by(const ShapeFormatInfo& format);
// Returns the format that has the extension; nothing if no format has it.
std::optional<ShapeFormat> shape_format_of(const std::filesystem::path& path);
// Returns true for a shape, false for coefficients. The first bytes (some kilobytes) decide,
// otherwise the extension in `name`; nothing if neither decides.
std::optional<bool> is_shape_file(std::span<const char> beginning, const std::string& name);

// A format of coefficients, and the metadata that its files hold.
struct CoefficientsFormatInfo {
  std::optional<CoefficientsFormat> format = {};  // none: the model file (model.h)
  FileFormat file = {};                           // names, extensions, read and write support
  bool meaning = false;  // convention, function, centre, unit, method, norm, gravity field
  bool errors = false;   // the measured errors of a model
};
// Returns all formats of coefficients, in the order of listings.
const std::vector<CoefficientsFormatInfo>& coefficients_formats();
// Returns the description of one format.
const CoefficientsFormatInfo& coefficients_format_info(CoefficientsFormat format);
// Returns the metadata that files of the format hold: "meaning", "errors".
std::vector<std::string> held_by(const CoefficientsFormatInfo& format);
// Returns true if the file name has the extension of a model file.
bool is_model_name(const std::filesystem::path& path);

}  // namespace rholm
