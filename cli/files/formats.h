// Formats by name and by extension, for options, help and messages: from the library's tables of
// formats. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "rholm/formats.h"

namespace rholm::cli {

// What a shape that is written has.
enum class Holding { kAnything, kFaces, kPoints };

// Names for --format, of formats that can be written.
std::vector<std::string> shape_format_names(Holding holding = Holding::kAnything);
std::vector<std::string> coefficients_format_names();

// Extensions of new files, one a format: ".ply, .obj, .stl"; with last = "or": ".ply, .obj or
// .stl".
std::string shape_extensions(Holding holding = Holding::kAnything, const std::string& last = "");
std::string coefficients_extensions();
// The same of the formats that hold what the numbers mean: ".h5, .sh or .json".
std::string meaningful_extensions(const std::string& last);
// ".ply, .obj, meshes as .stl, points as .xyz".
std::string extensions_by_holding();
// "PLY and STL as text", the help of --ascii.
std::string ascii_help(Holding holding);
// "model file (.h5), SHTOOLS (.sh, .txt)".
std::string coefficients_list();

// Whether a format of coefficients holds what the numbers mean.
bool holds_meaning(const std::string& name);
// The extension of new files of a format of shapes or of coefficients: "ply", "sh".
std::string extension_of_format(const std::string& name);

}  // namespace rholm::cli
