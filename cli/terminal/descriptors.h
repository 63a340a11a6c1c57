// Standard input, output and error that the parent process has closed. Layer: cli.
#pragma once

namespace rholm::cli {

// Opens /dev/null on closed descriptors among 0 to 2, so that no file of the program gets their
// number. Reads and writes on them fail, as on a closed descriptor. The program calls it before it
// opens any file.
void fill_standard_descriptors();

}  // namespace rholm::cli
