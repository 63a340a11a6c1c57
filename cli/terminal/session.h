// One run of a command: how it talks to the user and to the library. Layer: cli.
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <string_view>

#include "rholm/context.h"
#include "rholm/model.h"

namespace rholm::cli {

// What every command can be told.
struct CommonOptions {
  int threads = 0;  // 0: one per processor
  bool quiet = false;
};

// Text may hold names and words of files. All functions but print_exactly() escape what a terminal
// would take for a command (escaped_text() in base/plain_text.h).

// Writes a report to standard output, or to the Capture of this thread (capture.h).
void print_text(const std::string& text);
// Writes what programs read, as it is.
void print_exactly(const std::string& text);

// Text on standard error. Colours only on a terminal and without NO_COLOR. Lines behind the first
// are set in, so that no name in a message can look like another message.
void print_error(const std::string& message);
void print_note(const std::string& message);

class Session {
 public:
  explicit Session(const CommonOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Threads, the progress bar, and the question whether to stop.
  const Context& context() const { return context_; }

  // Standard error, unless --quiet: what the user may want to know, and what they should know.
  void note(const std::string& message);
  void warn(const std::string& message);
  // Standard output, unless --quiet: what a command that writes a file tells beside it.
  void report(const std::string& text);

 private:
  bool on_progress(std::string_view stage, double fraction);
  void erase_bar();

  CommonOptions options_;
  Context context_;
  bool bar_wanted_ = false;
  std::size_t bar_width_ = 0;  // letters of the bar on the screen now
  std::chrono::steady_clock::time_point bar_due_;
};

// Wall and processor time since it was made.
class Stopwatch {
 public:
  StageTime elapsed() const;

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

}  // namespace rholm::cli
