#include "cli/terminal/descriptors.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace rholm::cli {

void fill_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The opposite direction makes reads of input and writes of output fail. The system returns the
    // lowest free number, which is this one.
    const int direction = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", direction) != descriptor) _exit(1);  // nowhere to report it
  }
}

}  // namespace rholm::cli
