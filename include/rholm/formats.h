// The formats of files, as options, help, messages, pages and documents list them. Layer: io.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients_io.h"
#include "rholm/shape_io.h"

namespace rholm {

// An extension of a format's files.
struct FileExtension {
  std::string name = {};   // lower case, without dot: "ply"
  bool shared = false;     // files of other kinds have it too, so that it does not tell the format
  bool read_only = false;  // the program reads such files, and names no new file so
};
// A format of files.
struct FileFormat {
  std::string name = {};                       // of options and in reports: "ply"
  std::string title = {};                      // for people: "PLY"
  std::vector<FileExtension> extensions = {};  // a new file gets the first
  bool text = false;                           // files of text are read or written
  bool binary = false;                         // binary files are
  bool read = false;                           // files of it can be read
  bool written = false;                        // files of it can be written
  std::string help = {};                       // what it is, in one sentence
};
// The extension of the format that `path` has, in small or capital letters; null if it has none.
// Good as long as `format`.
const FileExtension* extension_of(const FileFormat& format, const std::filesystem::path& path);

// What a format of shapes is, and what of a shape its files hold when they are written.
struct ShapeFormatInfo {
  ShapeFormat format = ShapeFormat::kPly;  // which it is
  FileFormat file = {};                    // names, extensions, what can be done
  bool faces = false;                      // triangles between vertices
  bool points = false;                     // points without faces
  bool normals = false;                    // of points or vertices
  bool colors = false;                     // red, green, blue of points or vertices
  bool alpha = false;                      // the opacity of these colours
  bool texture = false;                    // texture coordinates
  bool any_attributes = false;             // attributes of any name and type
  bool single_precision = false;           // coordinates in binary files are floats, not doubles
  bool in_pieces = false;  // points can be read and written a piece at a time (point_stream.h)
};
// All formats of shapes, in the order in which they are listed.
const std::vector<ShapeFormatInfo>& shape_formats();
// The description of one format.
const ShapeFormatInfo& shape_format_info(ShapeFormat format);
// What files of the format hold, as words: "faces", "points", "normals", "colors", ...
std::vector<std::string> held_by(const ShapeFormatInfo& format);
// The format by the extension; none if it is known of no format.
std::optional<ShapeFormat> shape_format_of(const std::filesystem::path& path);
// Whether a file is of a shape (true) or of coefficients (false): by its first bytes (some
// kilobytes), or, where they do not tell, by the extension in `name`. None where neither tells.
std::optional<bool> is_shape_file(std::span<const char> beginning, const std::string& name);

// What a format of coefficients is, and what of an expansion its files hold beside the numbers.
struct CoefficientsFormatInfo {
  std::optional<CoefficientsFormat> format = {};  // none: the model file, which is in model.h
  FileFormat file = {};                           // names, extensions, what can be done
  bool meaning = false;  // convention, function, centre, unit, method, norm, gravity field
  bool errors = false;   // the measured errors of a model
};
// All formats of coefficients, in the order in which they are listed.
const std::vector<CoefficientsFormatInfo>& coefficients_formats();
// The description of one format.
const CoefficientsFormatInfo& coefficients_format_info(CoefficientsFormat format);
// What files of the format hold beside the numbers, as words: "meaning", "errors".
std::vector<std::string> held_by(const CoefficientsFormatInfo& format);
// Whether the extension is that of a model file.
bool is_model_name(const std::filesystem::path& path);

}  // namespace rholm
