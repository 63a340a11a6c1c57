// Where the files go that a command writes for each shape. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "io/file/temporary_folder.h"
#include "rholm/batch.h"

namespace rholm::cli {

// Names of files without extension, one for each shape: its id, with _ for what is not a letter of
// ASCII, a digit, a dot, - or _. Where that is too long or not unique (the case of letters does not
// count), the number of the row is added.
std::vector<std::string> file_names(const Manifest& manifest);

// A folder for files that are not kept, where the system has temporary files.
TemporaryFolder scratch_folder();

}  // namespace rholm::cli
