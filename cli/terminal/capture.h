// Where what a command says goes: to the streams of the program, or to who listens. Layer: cli.
//
// Commands print by print_text() and Session. A Capture takes all of it, on its own thread only, so
// that several threads can run commands at once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rholm/coefficients.h"

namespace rholm::cli {

class Capture {
 public:
  // From here on, until it ends. Of several on one thread the last counts.
  Capture();
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  std::string report;                  // for standard output
  std::vector<std::string> notes;      // of Session::note()
  std::vector<std::string> warnings;   // of Session::warn()
  std::optional<Expansion> expansion;  // the last one that was written

 private:
  Capture* outer_;
};

// That of this thread, or null.
Capture* capture();

}  // namespace rholm::cli
