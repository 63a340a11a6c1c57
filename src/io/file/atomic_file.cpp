#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include <sys/stat.h>

#include "base/cancel.h"
#include "base/parallel.h"
#include "io/file/leftovers.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

// Names of the temporary files that exist now. A signal handler may only use lock-free atomics: the
// code that exchanges a slot for nullptr owns the string. A process writes fewer than 64 at once.
// Without a slot a file is still written, but remains if a signal ends the process.
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

// Returns the descriptor of this process that the path names.
std::optional<int> descriptor_named_by(const std::filesystem::path& path) {
  const std::string word = path.filename().string();
  int number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || number < 0) return {};
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::canonical(path.parent_path(), ignored);
  const bool is_ours =
      folder == "/dev/fd" || folder == "/proc/" + std::to_string(::getpid()) + "/fd";
  return is_ours ? std::optional(number) : std::nullopt;
}

// Returns the end of a chain of symbolic links, which may not exist, or a descriptor's name.
std::filesystem::path follow_links(std::filesystem::path path) {
  constexpr int kMaxLinks = 40;  // the limit of Linux
  for (int i = 0; i < kMaxLinks; ++i) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error) || descriptor_named_by(path)) break;
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

// Returns a name for a temporary file in the folder of `target`. It is short, so that it fits where
// a name near the limit of the file system (255 bytes) fits.
std::filesystem::path next_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter = 0;
  std::string name(kTemporaryBegin);
  name += std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return target.parent_path() / name.append(kTemporaryEnd);
}

std::filesystem::path folder_of(const std::filesystem::path& target) {
  return target.has_parent_path() ? target.parent_path() : ".";
}

std::string name_by_descriptor(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

int open_without_name(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  return ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
#else
  (void)folder;
  return -1;
#endif
}

// A file that has got its first name, which discard_unfinished_files() knows.
struct FirstName {
  std::filesystem::path path;
  std::atomic<char*>* slot = nullptr;
  int error = 0;  // error of the system, if the file got no name
};

FirstName name_file(int descriptor, const std::filesystem::path& target) {
  const std::string nameless = name_by_descriptor(descriptor);
  for (;;) {
    FirstName name = {.path = next_name(target)};
    name.slot = enter(name.path.string());
    if (::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.path.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      return name;
    }
    name.error = errno;
    leave(std::exchange(name.slot, nullptr));
    if (name.error != EEXIST && name.error != EINTR) return name;
  }
}

// Returns true if unnamed files of the folder can get a name. Without /proc, and where FUSE or
// policies (AppArmor) forbid it, they cannot, which must be known before the work. An empty file
// tests this once per folder and process.
bool can_name_files(const std::filesystem::path& target) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, bool> known;
  const std::lock_guard lock(mutex);
  const std::filesystem::path folder = std::filesystem::absolute(folder_of(target));
  if (const auto found = known.find(folder); found != known.end()) return found->second;
  const int descriptor = open_without_name(folder);
  if (descriptor < 0) return false;
  (void)try_lock(descriptor);
  const FirstName name = name_file(descriptor, target);
  if (name.error == 0) {
    ::unlink(name.path.c_str());
    leave(name.slot);
  }
  ::close(descriptor);
  return known[folder] = name.error == 0;
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path, const Context& context, Writers writers)
    : name_(path == "-" ? "standard output" : path.string()), context_(context) {
  if (path.empty()) fail("a file without a name", ENOENT);
  const std::filesystem::path target = path == "-" ? "-" : follow_links(path);
  const std::optional<int> open =
      path == "-" ? std::optional(STDOUT_FILENO) : descriptor_named_by(target);
  if (open) {
    descriptor_ = ::fcntl(*open, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (descriptor_ < 0) fail(name_, errno);
    return;
  }
  struct stat status = {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  // A name that is too long, or a circle of links, is reported now and not after the work.
  if (!exists && errno != ENOENT) fail(name_, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(name_, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    open_directly(target);
    return;
  }
  // A file without write permission is not replaced, although the folder permits it.
  if (exists && ::access(target.c_str(), W_OK) != 0) fail(name_, errno);
  target_ = target;
  // A process may have been killed between the two names of a file, or while it wrote a named file.
  remove_left_files(folder_of(target));
  if (writers == Writers::kSeveral || !open_nameless()) open_named();
  if (exists) (void)::fchmod(descriptor_, status.st_mode & 07777);
}

// Opens a pipe once it has a reader; until then, a signal can cancel.
void AtomicFile::open_directly(const std::filesystem::path& path) {
  while ((descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC)) < 0) {
    if (errno != EINTR) fail(name_, errno);
    report_progress(context_, "write", 0);
  }
}

// Returns false if the system or file system has no unnamed files or cannot name them later.
bool AtomicFile::open_nameless() {
  if (!can_name_files(target_)) return false;
  descriptor_ = open_without_name(folder_of(target_));
  if (descriptor_ < 0) return false;
  temporary_ = name_by_descriptor(descriptor_);
  is_nameless_ = true;
  (void)try_lock(descriptor_);  // for the moment in which it has two names
  return true;
}

void AtomicFile::open_named() {
  for (;;) {
    temporary_ = next_name(target_);
    // The name is entered first: a signal between the two lines must find the file.
    slot_ = enter(temporary_.string());
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int error = errno;
    // Another process that looks for leftovers may have removed the file between the two calls.
    if (descriptor_ >= 0 && try_lock(descriptor_) != Lock::kRefused && !is_unlinked(descriptor_)) {
      return;
    }
    leave(slot_);
    slot_ = nullptr;
    if (descriptor_ >= 0) {
      ::close(descriptor_);
      descriptor_ = -1;
    } else if (error != EEXIST && error != EINTR) {
      target_.clear();
      fail(name_, error);
    }
  }
}

// Gives the complete file a name, so that it can replace an older file at once.
void AtomicFile::give_a_name() {
  const FirstName name = name_file(descriptor_, target_);
  if (name.error != 0) fail(name_, name.error);
  temporary_ = name.path;
  slot_ = name.slot;
  is_nameless_ = false;
}

void AtomicFile::write(std::span<const char> bytes) {
  constexpr std::size_t kPiece = std::size_t{16} << 20;  // chosen: a hundredth of a second
  while (!bytes.empty()) {
    ask_cancel();
    const ssize_t n = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kPiece));
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

// Closes a file; some file systems report a full disk only here.
void AtomicFile::close(int descriptor) {
  if (::close(descriptor) != 0 && errno != EINTR) fail(name_, errno);
}

void AtomicFile::commit() {
  if (!target_.empty()) {
    if (is_nameless_) give_a_name();
    // Closing a copy reports a full disk now; the descriptor keeps the lock until the rename.
    if (const int copy = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0); copy >= 0) close(copy);
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(name_, errno);
    target_.clear();
    leave(slot_);
  }
  close(std::exchange(descriptor_, -1));
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (target_.empty() || is_nameless_) return;
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

void write_file(const std::filesystem::path& path, std::span<const char> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace rholm
