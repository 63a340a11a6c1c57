#include "cli/studio/browser.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string_view>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm::cli {
namespace {

// Starts a program as a child of a child, which the system adopts, so that nobody waits for it.
// Returns false if the program does not exist.
bool start(const char* program, const std::string& argument) {
  int report[2] = {};
  if (::pipe2(report, O_CLOEXEC) != 0) return false;
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    if (::fork() != 0) ::_exit(0);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int stream = 0; stream < 3; ++stream) ::dup2(nothing, stream);
    ::signal(SIGPIPE, SIG_DFL);
    ::execlp(program, program, argument.c_str(), nullptr);
    const char failed = 1;
    [[maybe_unused]] const ssize_t n = ::write(report[1], &failed, 1);
    ::_exit(127);
  }
  ::close(report[1]);
  char failed = 0;
  // The pipe ends without a byte if the program has started.
  const bool begun = child > 0 && ::read(report[0], &failed, 1) == 0;
  ::close(report[0]);
  if (child > 0) ::waitpid(child, nullptr, 0);
  return begun;
}

}  // namespace

Browser::Browser(const std::string& address, const std::filesystem::path& temporary) {
  const std::string text = fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0;url={0}\">"
      "<title>rholm studio</title><a href=\"{0}\">rholm studio</a>",
      address);
  try {
    folder_.emplace(temporary, "rholm-studio-");
    const std::filesystem::path file = folder_->path() / "studio.html";
    write_file(file, text);
    opened_ = start("xdg-open", file.string());
  } catch (const Error&) {
    opened_ = false;
  }
}

}  // namespace rholm::cli
