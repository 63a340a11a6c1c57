// One run of a command: its output to the user and its Context for the library. Layer: cli.
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <string_view>

#include "rholm/context.h"
#include "rholm/model.h"

namespace rholm::cli {

// Options of every command.
struct CommonOptions {
  int threads = 0;  // 0: one per processor
  bool quiet = false;
};

// Text may contain names and words from files. All functions except print_exactly() escape control
// sequences of terminals (escaped_text() in base/plain_text.h).

// Writes a report to standard output, or to the Capture of this thread (capture.h).
void print_text(const std::string& text);
// Writes text for programs, unchanged.
void print_exactly(const std::string& text);

// Print on standard error, in colours only on a terminal without NO_COLOR. Lines after the first
// are indented, so that no name in a message can imitate another message.
void print_error(const std::string& message);
void print_note(const std::string& message);

class Session {
 public:
  explicit Session(const CommonOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Returns threads, progress bar and cancellation.
  const Context& context() const { return context_; }

  // Print on standard error, unless --quiet: useful information, and warnings.
  void note(const std::string& message);
  void warn(const std::string& message);
  // Prints on standard output, unless --quiet: the report of a command that writes a file.
  void report(const std::string& text);

 private:
  bool on_progress(std::string_view stage, double fraction);
  void erase_bar();

  CommonOptions options_;
  Context context_;
  bool bar_wanted_ = false;
  std::size_t bar_width_ = 0;  // characters of the visible bar
  std::chrono::steady_clock::time_point bar_due_;
};

// Wall and processor time since construction.
class Stopwatch {
 public:
  StageTime elapsed() const;

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

}  // namespace rholm::cli
