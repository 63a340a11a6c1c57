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
#include "rholm/fields.h"
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

// A column of a table of points.
struct TableColumn {
  std::string name = {};       // in the table's header; empty without one
  std::string taken_for = {};  // as in ShapeReadOptions::columns
};
// What the columns of a table of points were taken for.
struct TableColumns {
  std::vector<TableColumn> columns = {};  // none: it was no table of points
  std::string note = {};                  // the same as a line for people, and how it was decided
  bool unsure = false;                    // another reading is possible; `note` says which
};

// What was read.
struct ShapeFile {
  std::variant<Mesh, PointCloud> shape;    // a mesh if the file has faces, else points
  ShapeFormat format = ShapeFormat::kPly;  // as its content showed
  std::string encoding;                    // "ascii", "binary little endian", "binary big endian"
  std::vector<std::string> warnings;       // what was passed over, with counts
  TableColumns table = {};                 // of a text table
  std::size_t dropped = 0;                 // points with a coordinate that is not finite
};

// How much is read, and as what.
struct ShapeReadOptions {
  bool attributes = true;  // false: positions and faces (and normals of points) only
  // What the columns of a text table are, with commas between them: x, y, z (or lat, lon, radius:
  // degrees to the north and to the east), nx, ny, nz, r, g, b, a; - for a column to pass over;
  // any other word is the name of an attribute. Empty: the header and the values decide.
  std::string columns = {};
};
// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ShapeReadOptions>, const Visitor& field) {
  using O = ShapeReadOptions;
  field(&O::attributes, {.name = "attributes",
                         .help = "whether attributes of vertices or points are read",
                         .in_program = false});
  field(&O::columns,
        {.name = "columns",
         .help = "what the columns of a text table of points are, as in x,y,z,r,g,b,nx,ny,nz,-: "
                 "also a (alpha), or lat,lon,radius (degrees north and east); - passes over a "
                 "column, any other word names an attribute",
         .value = "LIST"});
}
// Throws InvalidInput unless `columns` can stand in ShapeReadOptions.
void check_columns(const std::string& columns);

// Reads a file; "-" is standard input. Points with a coordinate that is not finite are dropped and
// counted. Throws Io if it cannot be read, InvalidInput (with line or byte) if it is malformed,
// truncated, empty, is a mesh with coordinates that are not finite or indices out of range, or does
// not have options.columns; Unsupported if its format is not known. Memory stays within a small
// multiple of the file's size whatever its header claims.
ShapeFile read_shape(const std::filesystem::path& path, const ShapeReadOptions& options = {},
                     const Context& context = {});
// The same for bytes in memory; `name` serves messages and the extension.
ShapeFile parse_shape(std::span<const char> bytes, const std::string& name,
                      const ShapeReadOptions& options = {}, const Context& context = {});

// The points that an array of n rows with `width` numbers each holds: its columns are taken as
// those of a text table without a header. `table` tells what they were taken for. Throws
// InvalidInput for fewer than 3 columns and for columns that the array does not have.
PointCloud points_of_rows(std::span<const double> rows, std::size_t width,
                          const std::string& columns = {}, TableColumns* table = nullptr);

// How a shape is written.
struct ShapeWriteOptions {
  std::optional<ShapeFormat> format = {};  // by default from the extension
  bool ascii = false;                      // PLY and STL: text instead of binary little endian
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ShapeWriteOptions>, const Visitor& field) {
  using O = ShapeWriteOptions;
  field(&O::format,
        {.name = "format", .help = "format of the output, instead of the one its extension names"});
  field(&O::ascii, {.name = "ascii", .help = "text instead of binary, where the format has both"});
}

// Writes to a temporary file beside `path` that replaces it when complete; "-" is standard
// output and needs options.format. Coordinates are double where the format allows it (text with
// the shortest digits that read back the same); binary STL is float. Attributes are written where
// the format has room for them (PLY: all; OBJ: normals, texture coordinates, colours; OFF: normals,
// colours; XYZ: normals). Throws Io if it cannot be written, InvalidInput if `mesh` is not valid,
// Unsupported for a format that cannot hold it (points as STL, ...). Returns warnings: what single
// precision does to the shape, if that is more than to round it.
std::vector<std::string> write_shape(const Mesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});
std::vector<std::string> write_shape(const PointCloud& cloud, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});

// Names of the attributes that the format has no room for.
std::vector<std::string> attributes_left_out(std::span<const Attribute> attributes,
                                             ShapeFormat format);

}  // namespace rholm
