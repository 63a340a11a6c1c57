// Reading and writing of meshes and point clouds. Layer: io.
//
// Formats are PLY (ascii, little and big endian), OBJ, OFF (with its N, C, ST variants), STL
// (ascii, binary), and points as XYZ / PWN / TXT with or without normals. The content decides the
// format; the name decides only if the content does not. Polygons are cut into triangles.
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

// File formats of shapes.
enum class ShapeFormat {
  kPly,  // Stanford's: meshes and points with any attributes
  kObj,  // Wavefront's, text
  kOff,  // Geomview's, text
  kStl,  // separate triangles, float
  kXyz   // one point per line
};
const char* to_string(ShapeFormat format);                // "ply", "obj", "off", "stl", "xyz"
ShapeFormat parse_shape_format(const std::string& name);  // throws Unsupported

// A column of a table of points.
struct TableColumn {
  std::string name = {};       // in the table's header; empty without a header
  std::string taken_for = {};  // meaning, as in ShapeReadOptions::columns
};
// Meaning of the columns of a table of points.
struct TableColumns {
  std::vector<TableColumn> columns = {};  // empty if the file was no table of points
  std::string note = {};                  // the same as text, with the reason
  bool unsure = false;                    // another reading is possible; `note` names it
};

// A shape read from a file.
struct ShapeFile {
  std::variant<Mesh, PointCloud> shape;    // a mesh if the file has faces, otherwise points
  ShapeFormat format = ShapeFormat::kPly;  // found from the content
  std::string encoding;                    // "ascii", "binary little endian", "binary big endian"
  std::vector<std::string> warnings;       // skipped contents, with counts
  TableColumns table = {};                 // columns of a text table
  std::size_t dropped = 0;                 // number of points that are not finite
};

// Contents to read, and the meaning of columns.
struct ShapeReadOptions {
  bool attributes = true;  // false: read only positions and faces (and normals of points)
  // Meaning of the columns of a text table, separated by commas: x, y, z (or lat, lon, radius:
  // degrees north and east), nx, ny, nz, r, g, b, a. A - skips a column; any other word names an
  // attribute. Empty: the header and the values decide.
  std::string columns = {};
};
// Lists the fields of ShapeReadOptions (fields.h).
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
// Throws InvalidInput unless `columns` is valid for ShapeReadOptions.
void check_columns(const std::string& columns);

// Reads a file; "-" is standard input. Points that are not finite are dropped and counted. Throws
// Io if it cannot be read, Unsupported for an unknown format. Throws InvalidInput (with line or
// byte) if the file is malformed, truncated, empty or lacks options.columns. A mesh also must not
// have coordinates that are not finite or indices out of range. Memory stays within a small
// multiple of the file's size, whatever its header claims.
ShapeFile read_shape(const std::filesystem::path& path, const ShapeReadOptions& options = {},
                     const Context& context = {});
// Parses bytes in memory; `name` is used for messages, and its extension for the format.
ShapeFile parse_shape(std::span<const char> bytes, const std::string& name,
                      const ShapeReadOptions& options = {}, const Context& context = {});

// Returns the points in an array of n rows with `width` numbers each. Columns are interpreted as in
// a text table without a header; `table` receives their meaning. Throws InvalidInput for fewer than
// 3 columns and for columns that the array does not have.
PointCloud points_of_rows(std::span<const double> rows, std::size_t width,
                          const std::string& columns = {}, TableColumns* table = nullptr);

// Options for writing a shape.
struct ShapeWriteOptions {
  std::optional<ShapeFormat> format = {};  // empty: from the extension
  bool ascii = false;                      // PLY and STL: text instead of binary little endian
};

// Lists the fields of ShapeWriteOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ShapeWriteOptions>, const Visitor& field) {
  using O = ShapeWriteOptions;
  field(&O::format,
        {.name = "format", .help = "format of the output, instead of the one its extension names"});
  field(&O::ascii, {.name = "ascii", .help = "text instead of binary, where the format has both"});
}

// Writes to a temporary file beside `path`, which replaces `path` when complete. "-" is standard
// output and needs options.format. Coordinates are double if the format allows it (text with the
// shortest digits that read back the same); binary STL is float. Attributes are written if the
// format has room (PLY: all; OBJ: normals, texture coordinates, colours; OFF: normals, colours;
// XYZ: normals). Throws Io if writing fails, InvalidInput for an invalid mesh, Unsupported for a
// wrong format (points as STL, ...). Returns warnings on effects of single precision beyond
// rounding.
std::vector<std::string> write_shape(const Mesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});
std::vector<std::string> write_shape(const PointCloud& cloud, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});

// Returns the names of the attributes that the format has no room for.
std::vector<std::string> attributes_left_out(std::span<const Attribute> attributes,
                                             ShapeFormat format);

}  // namespace rholm
