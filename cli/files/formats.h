// Lists of formats by name and extension, for options, help and messages, from the library's
// tables. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "rholm/formats.h"

namespace rholm::cli {

// Contents that a format must be able to hold.
enum class Holding { kAnything, kFaces, kPoints };

// Return names for --format, of formats that can be written.
std::vector<std::string> shape_format_names(Holding holding = Holding::kAnything);
std::vector<std::string> coefficients_format_names();

// Return extensions of new files, one per format: ".ply, .obj, .stl"; with last = "or": ".ply, .obj
// or .stl".
std::string shape_extensions(Holding holding = Holding::kAnything, const std::string& last = "");
std::string coefficients_extensions();
// Returns extensions of formats that store metadata: ".h5, .sh or .json".
std::string meaningful_extensions(const std::string& last);
// Returns ".ply, .obj, meshes as .stl, points as .xyz".
std::string extensions_by_holding();
// Returns "PLY and STL as text", the help of --ascii.
std::string ascii_help(Holding holding);
// Returns "model file (.h5), SHTOOLS (.sh, .txt)".
std::string coefficients_list();

// Returns true if a format of coefficients stores metadata.
bool holds_meaning(const std::string& name);
// Returns the extension of new files of a format of shapes or coefficients: "ply", "sh".
std::string extension_of_format(const std::string& name);

}  // namespace rholm::cli
