#include "io/shapes/shape_formats.h"

namespace rholm {
namespace {

std::vector<ShapeFormatLine> shape_format_lines() {
  return {{.info = {.format = ShapeFormat::kPly,
                    .file = {.name = "ply",
                             .title = "PLY",
                             .extensions = {{"ply"}},
                             .text = true,
                             .binary = true,
                             .help = "Stanford's format: meshes and points with any attributes"},
                    .faces = true,
                    .points = true,
                    .normals = true,
                    .colors = true,
                    .alpha = true,
                    .texture = true,
                    .any_attributes = true,
                    .in_pieces = true},
           .mark = "ply",
           .told_by = ToldBy::kSignature,
           .looks_like = looks_like_ply,
           .read = read_ply,
           .write = format_ply},
          {.info = {.format = ShapeFormat::kObj,
                    .file = {.name = "obj",
                             .title = "OBJ",
                             .extensions = {{"obj"}},
                             .text = true,
                             .help = "Wavefront's format: a statement a line"},
                    .faces = true,
                    .points = true,
                    .normals = true,
                    .colors = true,
                    .texture = true},
           .told_by = ToldBy::kLines,
           .looks_like = looks_like_obj,
           .read = read_obj,
           .write = format_obj},
          {.info = {.format = ShapeFormat::kOff,
                    .file = {.name = "off",
                             .title = "OFF",
                             .extensions = {{"off"}},
                             .text = true,
                             .help = "Geomview's format, with its variants N, C and ST"},
                    .faces = true,
                    .points = true,
                    .normals = true,
                    .colors = true,
                    .alpha = true},
           .mark = "OFF",
           .told_by = ToldBy::kFirstWord,
           .looks_like = looks_like_off,
           .read = read_off,
           .write = format_off},
          {.info = {.format = ShapeFormat::kStl,
                    .file = {.name = "stl",
                             .title = "STL",
                             .extensions = {{"stl"}},
                             .text = true,
                             .binary = true,
                             .help = "Triangles one by one, without shared vertices"},
                    .faces = true,
                    .single_precision = true},
           .mark = "solid",
           .told_by = ToldBy::kSignature,
           .looks_like = looks_like_stl,
           .may_be = may_be_stl,
           .read = read_stl,
           .write = format_stl},
          {.info = {.format = ShapeFormat::kXyz,
                    .file = {.name = "xyz",
                             .title = "XYZ",
                             .extensions = {{"xyz"},
                                            {"pwn"},
                                            {.name = "pts", .read_only = true},
                                            {.name = "csv", .shared = true, .read_only = true},
                                            {.name = "txt", .shared = true},
                                            {.name = "asc", .shared = true, .read_only = true}},
                             .text = true,
                             .help = "A point a line; tables with other columns are read too"},
                    .points = true,
                    .normals = true,
                    .in_pieces = true},
           .may_be = may_be_xyz,
           .read = read_xyz,
           .write = format_xyz}};
}

}  // namespace

const std::vector<ShapeFormatLine>& shape_format_table() {
  static const std::vector<ShapeFormatLine> table = [] {
    std::vector<ShapeFormatLine> lines = shape_format_lines();
#ifdef RHOLM_EXTRA_SHAPE_FORMATS  // tests/cli/made_up_formats.cpp adds a line here
    lines.push_back(
#include RHOLM_EXTRA_SHAPE_FORMATS
    );
#endif
    for (ShapeFormatLine& line : lines) {
      line.info.file.read = line.read != nullptr;
      line.info.file.written = line.write != nullptr;
    }
    return lines;
  }();
  return table;
}

}  // namespace rholm
