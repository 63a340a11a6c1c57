#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

// Names of the temporary files that exist now. A signal handler may only touch lock-free atomics:
// whoever exchanges a slot for nullptr owns the string. 64 is more than a process writes at once;
// a file that finds no slot is written all the same, only a signal leaves it behind.
constexpr std::size_t kSlots = 64;
std::array<std::atomic<char*>, kSlots> g_unfinished;
static_assert(std::atomic<char*>::is_always_lock_free);

std::atomic<char*>* enter(const std::string& name) {
  char* copy = strdup(name.c_str());
  if (copy == nullptr) return nullptr;
  for (std::atomic<char*>& slot : g_unfinished) {
    char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, copy)) return &slot;
  }
  free(copy);
  return nullptr;
}

void leave(std::atomic<char*>* slot) {
  // nullptr here means that the handler took the string; the process is ending.
  if (slot != nullptr) free(slot->exchange(nullptr));
}

[[noreturn]] void fail(const std::string& name, int error) {
  throw Error(ErrorCode::kIo, "cannot write " + name + ": " + std::strerror(error));
}

// The file a chain of symbolic links ends at, which need not exist.
std::filesystem::path follow_links(std::filesystem::path path) {
  constexpr int kMaxLinks = 40;  // as Linux
  for (int i = 0; i < kMaxLinks; ++i) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) break;
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path, const Context& context)
    : name_(path == "-" ? "standard output" : path.string()), context_(context) {
  if (path.empty()) fail("a file without a name", ENOENT);
  if (path == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  const std::filesystem::path target = follow_links(path);
  struct stat status = {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  // A name that is too long, a circle of links: noticed now, not when all is written.
  if (!exists && errno != ENOENT) fail(name_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(name_, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(name_, errno);
    return;
  }
  // A file that may not be written is not replaced either, though the folder would allow it.
  if (exists && ::access(target.c_str(), W_OK) != 0) fail(name_, errno);
  open_temporary(target);
  if (exists) (void)::fchmod(descriptor_, status.st_mode & 07777);
}

void AtomicFile::open_temporary(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter = 0;
  for (;;) {
    // Short, so that a name near the limit of the file system (255 bytes) still fits.
    const std::string suffix =
        ".rholm-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".part";
    temporary_ = target.parent_path() / suffix;
    // Entered first: a signal between the two lines must find the file.
    slot_ = enter(temporary_.string());
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) break;
    const int error = errno;
    leave(slot_);
    slot_ = nullptr;
    if (error == EEXIST || error == EINTR) continue;
    fail(name_, error);
  }
  target_ = target;
}

void AtomicFile::write(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    } else if (errno == EINTR) {
      report_progress(context_, "write", 0);
    } else if (errno == EAGAIN) {
      pollfd wait = {.fd = descriptor_, .events = POLLOUT, .revents = 0};
      (void)::poll(&wait, 1, -1);
      report_progress(context_, "write", 0);
    } else {
      fail(name_, errno);
    }
  }
}

void AtomicFile::close() {
  if (descriptor_ < 0) return;
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Some file systems report a full disk only here.
  if (descriptor != STDOUT_FILENO && ::close(descriptor) != 0 && errno != EINTR) fail(name_, errno);
}

void AtomicFile::commit() {
  close();
  if (target_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(name_, errno);
  target_.clear();
  leave(slot_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0 && descriptor_ != STDOUT_FILENO) ::close(descriptor_);
  if (target_.empty()) return;
  ::unlink(temporary_.c_str());
  leave(slot_);
}

void discard_unfinished_files() noexcept {
  const int error = errno;
  for (std::atomic<char*>& slot : g_unfinished) {
    if (const char* name = slot.exchange(nullptr)) ::unlink(name);
  }
  errno = error;
}

}  // namespace rholm
