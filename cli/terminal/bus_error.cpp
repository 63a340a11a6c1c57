#include "cli/terminal/bus_error.h"

#include <signal.h>
#include <unistd.h>

#include "cli/terminal/exit_code.h"
#include "rholm/file.h"

namespace rholm::cli {
namespace {

// Calls only functions that are safe in a signal handler.
void on_bus_error(int signal, siginfo_t* info, void*) {
  discard_unfinished_files();
  if (info->si_code != BUS_ADRERR) {  // not beyond the end of a file: a defect of the program
    ::signal(signal, SIG_DFL);
    ::raise(signal);
    return;
  }
  constexpr char kMessage[] =
      "rholm: error: the file was shortened while it was read; wait until the other program has "
      "written it, then try again\n";
  // A failure of this write cannot be reported.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1);
  _exit(kRefused);
}

}  // namespace

void install_bus_error_handler() {
  struct sigaction action = {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, nullptr);
}

}  // namespace rholm::cli
