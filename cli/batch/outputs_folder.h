// Names and folder of the files that a command writes for each shape. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "io/file/temporary_folder.h"
#include "rholm/batch.h"

namespace rholm::cli {

// Returns file names without extension, one per shape: its id, with _ in place of characters other
// than ASCII letters, digits, dot, - and _. The row number is added to names that are too long or
// not unique (upper and lower case count as equal).
std::vector<std::string> file_names(const Manifest& manifest);

// Returns a folder for files that are not kept, in the system's folder for temporary files.
TemporaryFolder scratch_folder();

}  // namespace rholm::cli
