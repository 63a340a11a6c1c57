// Meshes and point clouds from and to files. Layer: io.
//
// Formats: PLY (ascii, little and big endian), OBJ, OFF (with its N, C, ST variants), STL (ascii,
// binary), and points as XYZ / PWN / TXT with or without normals. The content decides what
// a file is, the name only where the content does not. Polygons are cut into triangles.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Files of shapes.
enum class ShapeFormat {
  kPly,  // Stanford's: meshes and points with any attributes
  kObj,  // Wavefront's, text
  kOff,  // Geomview's, text
  kStl,  // triangles one by one, float
  kXyz   // a point a line
};
const char* to_string(ShapeFormat format);                // "ply", "obj", "off", "stl", "xyz"
ShapeFormat parse_shape_format(const std::string& name);  // throws Unsupported

// What was read.
struct ShapeFile {
  std::variant<Mesh, PointCloud> shape;    // a mesh if the file has faces, else points
  ShapeFormat format = ShapeFormat::kPly;  // as its content showed
  std::string encoding;                    // "ascii", "binary little endian", "binary big endian"
  std::vector<std::string> warnings;       // what was passed over, with counts
};

// How much is read.
struct ShapeReadOptions {
  bool attributes = true;  // false: positions and faces (and normals of points) only
};

// Reads a file; "-" is standard input. Throws Io if it cannot be read, InvalidInput (with line or
// byte) if it is malformed, truncated, empty, or has coordinates that are not finite or indices
// out of range, Unsupported if its format is not known. Memory stays within a small multiple of
// the file's size whatever its header claims.
ShapeFile read_shape(const std::filesystem::path& path, const ShapeReadOptions& options = {},
                     const Context& context = {});
// The same for bytes in memory; `name` serves messages and the extension.
ShapeFile parse_shape(std::span<const char> bytes, const std::string& name,
                      const ShapeReadOptions& options = {}, const Context& context = {});

// How a shape is written.
struct ShapeWriteOptions {
  std::optional<ShapeFormat> format = {};  // by default from the extension
  bool ascii = false;                      // PLY and STL: text instead of binary little endian
};

// Writes to a temporary file beside `path` that replaces it when complete; "-" is standard
// output and needs options.format. Coordinates are double where the format allows it (text with
// the shortest digits that read back the same); STL is float. Attributes are written where the
// format has room for them (PLY: all; OBJ: normals, texture coordinates, colours; OFF: normals,
// colours; XYZ: normals). Throws Io if it cannot be written, InvalidInput if `mesh` is not valid,
// Unsupported for a format that cannot hold it (points as STL, ...).
void write_shape(const Mesh& mesh, const std::filesystem::path& path,
                 const ShapeWriteOptions& options = {}, const Context& context = {});
void write_shape(const PointCloud& cloud, const std::filesystem::path& path,
                 const ShapeWriteOptions& options = {}, const Context& context = {});

// Names of the attributes that the format has no room for.
std::vector<std::string> attributes_left_out(std::span<const Attribute> attributes,
                                             ShapeFormat format);

}  // namespace rholm
