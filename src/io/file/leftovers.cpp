#include "io/file/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace rholm {
namespace {

bool is_first_look(const std::filesystem::path& folder, std::string_view begin) {
  static std::mutex mutex;
  static std::set<std::string> seen;
  const std::lock_guard lock(mutex);
  return seen.insert((std::filesystem::absolute(folder) / begin).string()).second;
}

// Calls remove() if no other process holds the lock on the file `lock`.
void if_left(const std::filesystem::path& lock, const std::function<void()>& remove) {
  // Links are not followed: in a folder that all may write into, a link may point anywhere.
  const int descriptor = ::open(lock.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status = {};
  const bool is_ours =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
  if (is_ours && try_lock(descriptor) == Lock::kTaken) remove();
  ::close(descriptor);
}

// Returns the folder's entries with this start and end of the name; none after the first call.
std::vector<std::filesystem::path> look_once(const std::filesystem::path& folder,
                                             std::string_view begin, std::string_view end) {
  std::vector<std::filesystem::path> found;
  if (!is_first_look(folder, begin)) return found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(begin) && name.ends_with(end)) found.push_back(entry.path());
  }
  return found;
}

}  // namespace

Lock try_lock(int descriptor) {
  int result = 0;
  do {
    result = ::flock(descriptor, LOCK_EX | LOCK_NB);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return Lock::kTaken;
  return errno == EWOULDBLOCK ? Lock::kRefused : Lock::kNone;
}

bool is_unlinked(int descriptor) {
  struct stat status = {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink == 0;
}

void remove_left_files(const std::filesystem::path& folder) noexcept {
  try {
    for (const std::filesystem::path& path : look_once(folder, kTemporaryBegin, kTemporaryEnd)) {
      if_left(path, [&] { ::unlink(path.c_str()); });
    }
  } catch (const std::exception&) {
    return;  // the content of a folder that cannot be read stays
  }
}

void remove_left_folders(const std::filesystem::path& folder, std::string_view kind) noexcept {
  try {
    for (const std::filesystem::path& path : look_once(folder, kind, "")) {
      struct stat status = {};
      if (::lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) continue;
      if (status.st_uid != ::geteuid()) continue;
      if_left(path / kFolderLock, [&] { remove_temporary_folder(path); });
    }
  } catch (const std::exception&) {
    return;
  }
}

void remove_temporary_folder(const std::filesystem::path& path) noexcept {
  try {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      if (entry.path().filename() != kFolderLock) {
        std::filesystem::remove_all(entry.path(), ignored);
      }
    }
    // A program that is killed before this line leaves a folder that a later program removes.
    ::unlink((path / kFolderLock).c_str());
    ::rmdir(path.c_str());
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace rholm
