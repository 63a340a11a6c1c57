#include "io/file/input_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "rholm/error.h"

namespace rholm {

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path == "-" ? "standard input" : path.string()) {
  while (path != "-") {
    descriptor_.value = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_.value >= 0) break;
    if (errno != EINTR) fail(errno);
  }
  struct stat status = {};
  if (::fstat(descriptor_.value, &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  if (S_ISREG(status.st_mode)) size_ = static_cast<std::size_t>(status.st_size);
}

InputFile::Piece InputFile::read(std::span<char> room) {
  const ssize_t n = ::read(descriptor_.value, room.data(), room.size());
  if (n >= 0) return {static_cast<std::size_t>(n), n == 0};
  if (errno == EAGAIN) {
    pollfd wait = {.fd = descriptor_.value, .events = POLLIN, .revents = 0};
    (void)::poll(&wait, 1, -1);
  } else if (errno != EINTR) {
    fail(errno);
  }
  return {};
}

void InputFile::fail(int error) const {
  throw Error(ErrorCode::kIo, "cannot read " + name_ + ": " + std::strerror(error));
}

}  // namespace rholm
