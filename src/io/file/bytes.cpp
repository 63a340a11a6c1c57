#include "io/file/bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::size_t kChunk = std::size_t{32} << 20;     // bytes between two looks at the callback
constexpr std::size_t kFirstRoom = std::size_t{1} << 16;  // what a pipe holds by default

struct Descriptor {
  int value = -1;
  ~Descriptor() {
    if (value > STDIN_FILENO) ::close(value);
  }
};

[[noreturn]] void fail(const std::string& name, int error) {
  throw Error(ErrorCode::kIo, "cannot read " + name + ": " + std::strerror(error));
}

int open_to_read(const std::filesystem::path& path, const std::string& name) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0) return descriptor;
    if (errno != EINTR) fail(name, errno);
  }
}

// The size the file has now; 0 for pipes and devices, whose size is not known.
std::size_t size_of(int descriptor, const std::string& name) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) fail(name, errno);
  if (S_ISDIR(status.st_mode)) fail(name, EISDIR);
  return S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
}

class GrowingBuffer {
 public:
  explicit GrowingBuffer(std::size_t room) { grow_to(room); }
  ~GrowingBuffer() { std::free(data_); }
  GrowingBuffer(const GrowingBuffer&) = delete;
  GrowingBuffer& operator=(const GrowingBuffer&) = delete;

  std::span<char> room() {
    if (size_ == room_) grow_to(2 * room_);
    return {data_ + size_, room_ - size_};
  }
  void advance(std::size_t n) { size_ += n; }
  std::size_t size() const { return size_; }
  Bytes take() {
    // realloc to a smaller size does not move large blocks; it gives the unused part back.
    if (room_ - size_ > kFirstRoom) grow_to(std::max<std::size_t>(size_, 1));
    return Bytes(std::exchange(data_, nullptr), size_);
  }

 private:
  void grow_to(std::size_t room) {
    char* data = static_cast<char*>(std::realloc(data_, room));
    if (data == nullptr) throw std::bad_alloc();
    data_ = data;
    room_ = room;
  }
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t room_ = 0;
};

}  // namespace

Bytes read_bytes(const std::filesystem::path& path, const Context& context, double to) {
  const std::string name = path == "-" ? "standard input" : path.string();
  const Descriptor file{path == "-" ? STDIN_FILENO : open_to_read(path, name)};
  const std::size_t expected = size_of(file.value, name);
  // One byte more than the size, so that the end of the file is seen without growing.
  GrowingBuffer buffer(std::max(expected + 1, kFirstRoom));
  for (;;) {
    const std::span<char> room = buffer.room();
    const ssize_t n = ::read(file.value, room.data(), std::min(room.size(), kChunk));
    if (n == 0) return buffer.take();
    if (n > 0) {
      buffer.advance(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      pollfd wait = {.fd = file.value, .events = POLLIN, .revents = 0};
      (void)::poll(&wait, 1, -1);
    } else if (errno != EINTR) {
      fail(name, errno);
    }
    const double part =
        expected == 0
            ? 0
            : std::min(1.0, static_cast<double>(buffer.size()) / static_cast<double>(expected));
    report_progress(context, "read", part * to);
  }
}

}  // namespace rholm
