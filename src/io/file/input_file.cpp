#include "io/file/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "rholm/error.h"

namespace rholm {

namespace {

// Chosen: people who wait for the end of a program hardly notice this delay.
constexpr int kMillisecondsBetweenQuestions = 100;

}  // namespace

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path == "-" ? "standard input" : path.string()) {
  while (path != "-") {
    // O_NONBLOCK: read() waits for the writer of a named pipe, and returns to its caller
    // meanwhile.
    descriptor_.value = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_.value >= 0) break;
    if (errno != EINTR) fail(errno);
  }
  struct stat status = {};
  if (::fstat(descriptor_.value, &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  if (S_ISREG(status.st_mode)) size_ = static_cast<std::size_t>(status.st_size);
}

InputFile::Piece InputFile::read(std::span<char> room) {
  pollfd wait = {.fd = descriptor_.value, .events = POLLIN, .revents = 0};
  if (::poll(&wait, 1, kMillisecondsBetweenQuestions) <= 0) return {};
  const ssize_t n = ::read(descriptor_.value, room.data(), room.size());
  if (n >= 0) return {static_cast<std::size_t>(n), n == 0};
  if (errno != EINTR && errno != EAGAIN) fail(errno);
  return {};
}

void InputFile::fail(int error) const {
  throw Error(ErrorCode::kIo, "cannot read " + name_ + ": " + std::strerror(error));
}

}  // namespace rholm
