#include "cli/files/input_descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstring>

#include <fmt/format.h>

#include "cli/files/paths.h"
#include "cli/terminal/interrupt.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

// Chosen: a delay that a person who ends a program hardly notices.
constexpr int kMillisecondsBetweenQuestions = 100;

}  // namespace

// With O_NONBLOCK a named pipe without a writer opens at once, and read(), which can be
// interrupted, waits.
InputDescriptor::InputDescriptor(const std::string& path)
    : path_(path),
      number_(path == "-" ? STDIN_FILENO
                          : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  const int error = errno;
  stop_if_interrupted();
  if (number_ >= 0) return;
  throw Error(ErrorCode::kIo, fmt::format("{} cannot be opened: {}", path, std::strerror(error)));
}

InputDescriptor::~InputDescriptor() {
  if (number_ > STDERR_FILENO) ::close(number_);
}

std::size_t InputDescriptor::read(std::span<char> room) {
  for (;;) {
    pollfd wait = {.fd = number_, .events = POLLIN, .revents = 0};
    const bool is_ready = ::poll(&wait, 1, kMillisecondsBetweenQuestions) > 0;
    const ssize_t n = is_ready ? ::read(number_, room.data(), room.size()) : -1;
    const int error = is_ready ? errno : EAGAIN;
    keep_going();  // counts as work: a program that waits for a writer does not hang
    stop_if_interrupted();
    if (n >= 0) return static_cast<std::size_t>(n);
    if (error != EINTR && error != EAGAIN) {
      throw Error(ErrorCode::kIo,
                  fmt::format("{} cannot be read: {}", display_name(path_), std::strerror(error)));
    }
  }
}

}  // namespace rholm::cli
