// Destination of a command's output: the program's streams, or a listener. Layer: cli.
//
// Commands print by print_text() and Session. A Capture takes all output of its own thread, so that
// several threads can run commands at once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rholm/coefficients.h"

namespace rholm::cli {

class Capture {
 public:
  // Starts the capture, which its destructor ends. Only the latest of several on a thread counts.
  Capture();
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  std::string report;                  // text for standard output
  std::vector<std::string> notes;      // from Session::note()
  std::vector<std::string> warnings;   // from Session::warn()
  std::optional<Expansion> expansion;  // last expansion written

 private:
  Capture* outer_;
};

// Returns the capture of this thread, or null.
Capture* capture();

}  // namespace rholm::cli
