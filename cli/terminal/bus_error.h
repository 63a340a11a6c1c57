// What to say when a mapped input is made shorter by another program. Layer: cli.
#pragma once

namespace rholm::cli {

// From then on SIGBUS for a page that is not in its file any more (see rholm/mapped_mesh.h) ends
// the program with a message, the exit code of malformed input, and without unfinished files.
void install_bus_error_handler();

}  // namespace rholm::cli
