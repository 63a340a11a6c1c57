#include "io/spill/spill_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "rholm/error.h"

namespace rholm {
namespace {

[[noreturn]] void fail(const char* what, const std::string& name) {
  const int error = errno;
  throw Error(ErrorCode::kIo,
              std::string("cannot ") + what + " " + name + ": " + std::strerror(error));
}

int flags_of(SpillFile::Mode mode) {
  switch (mode) {
    case SpillFile::Mode::kNew:
      return O_WRONLY | O_CREAT | O_TRUNC;
    case SpillFile::Mode::kAppend:
      return O_WRONLY | O_APPEND;
    case SpillFile::Mode::kLock:
      return O_RDWR | O_CREAT;
    case SpillFile::Mode::kInPlace:
      return O_WRONLY;
    case SpillFile::Mode::kRead:
      break;
  }
  return O_RDONLY;
}

}  // namespace

SpillFile::SpillFile(const std::filesystem::path& path, Mode mode) : name_(path.string()) {
  do {
    descriptor_ = ::open(path.c_str(), flags_of(mode) | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) fail(mode == Mode::kRead ? "read" : "write", name_);
}

SpillFile::~SpillFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t SpillFile::size() const {
  struct stat status = {};
  if (::fstat(descriptor_, &status) != 0) fail("read", name_);
  return static_cast<std::uint64_t>(status.st_size);
}

void SpillFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", name_);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void SpillFile::write_at(std::uint64_t at, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("write", name_);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    at += static_cast<std::uint64_t>(n);
  }
}

void SpillFile::make_room(std::uint64_t size) {
  int result = 0;
  do {
    result = ::fallocate(descriptor_, 0, 0, static_cast<off_t>(size));
  } while (result != 0 && errno == EINTR);
  if (result == 0) return;
  if (errno != EOPNOTSUPP && errno != ENOSYS) fail("write", name_);
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail("write", name_);
}

bool SpillFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", name_);
    if (n == 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    at += static_cast<std::uint64_t>(n);
  }
  return true;
}

void SpillFile::sync() {
  // EINVAL: the file does not support fsync.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EINTR) fail("write", name_);
}

void SpillFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0 && ::close(descriptor) != 0 && errno != EINTR) fail("write", name_);
}

}  // namespace rholm
