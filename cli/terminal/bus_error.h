// Message for a mapped input that another program truncates. Layer: cli.
#pragma once

namespace rholm::cli {

// Handles SIGBUS for a page beyond the end of its file (see rholm/mapped_mesh.h). The program then
// ends with a message and the exit code of malformed input, and removes unfinished files.
void install_bus_error_handler();

}  // namespace rholm::cli
