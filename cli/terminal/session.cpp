#include "cli/terminal/session.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "cli/terminal/capture.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/program_name.h"

namespace rholm::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kBarDelay = 500ms;     // chosen: a shorter run needs no bar
constexpr auto kBarInterval = 100ms;  // chosen: looks smooth, costs little
constexpr int kBarLength = 30;

bool environment_has(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

bool stderr_is_terminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) && !(terminal && std::string_view(terminal) == "dumb");
}

bool colours() { return stderr_is_terminal() && !environment_has("NO_COLOR"); }

// Prints "rholm: error: text", with the second part in a colour of the terminal.
void print_message(const char* kind, const char* colour, const std::string& text) {
  const std::string label =
      colours() ? fmt::format("\x1b[{}m{}:\x1b[0m", colour, kind) : fmt::format("{}:", kind);
  std::string shown = escaped_text(text);
  if (shown.ends_with('\n')) shown.pop_back();
  for (std::size_t at = 0; (at = shown.find('\n', at)) != std::string::npos; at += 3) {
    shown.insert(at + 1, 2, ' ');
  }
  const std::string line = fmt::format("{}: {} {}\n", program_name(), label, shown);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void print_text(const std::string& text) { print_exactly(escaped_text(text)); }

void print_exactly(const std::string& text) {
  if (Capture* listener = capture()) {
    listener->report += text;
  } else {
    std::fwrite(text.data(), 1, text.size(), stdout);
  }
}

void print_error(const std::string& message) { print_message("error", "1;31", message); }

void print_note(const std::string& message) { print_message("note", "36", message); }

Session::Session(const CommonOptions& options)
    : options_(options),
      bar_wanted_(capture() == nullptr && stderr_is_terminal() && !options.quiet),
      bar_due_(std::chrono::steady_clock::now() + kBarDelay) {
  context_.threads = options.threads;
  context_.progress = [this](std::string_view stage, double fraction) {
    return on_progress(stage, fraction);
  };
}

Session::~Session() { erase_bar(); }

void Session::note(const std::string& message) {
  if (Capture* listener = capture()) return listener->notes.push_back(message);
  erase_bar();
  if (!options_.quiet) print_note(message);
}

void Session::warn(const std::string& message) {
  if (Capture* listener = capture()) return listener->warnings.push_back(message);
  erase_bar();
  if (!options_.quiet) print_message("warning", "1;33", message);
}

void Session::report(const std::string& text) {
  erase_bar();
  if (!options_.quiet) print_text(text);
}

bool Session::on_progress(std::string_view stage, double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (bar_wanted_ && !stage.empty() && now >= bar_due_) {
    bar_due_ = now + kBarInterval;
    const double part = std::clamp(fraction, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(part * kBarLength);
    const std::string bar = fmt::format("{:<14} [{:<{}}] {:3.0f} %", escaped_line(stage),
                                        std::string(filled, '#'), kBarLength, 100 * part);
    std::fprintf(stderr, "\r%-*s", static_cast<int>(bar_width_), bar.c_str());
    bar_width_ = bar.size();
  }
  return keep_going();
}

void Session::erase_bar() {
  if (bar_width_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(bar_width_), "");
  bar_width_ = 0;
}

StageTime Stopwatch::elapsed() const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
  return {wall.count(), static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC};
}

}  // namespace rholm::cli
