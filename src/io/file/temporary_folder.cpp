#include "io/file/temporary_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/file/leftovers.h"
#include "rholm/error.h"

namespace rholm {

TemporaryFolder::TemporaryFolder(const std::filesystem::path& parent, const std::string& kind) {
  remove_left_folders(parent, kind);
  for (;;) {
    std::string name = (parent / (kind + "XXXXXX")).string();
    if (::mkdtemp(name.data()) != nullptr) {
      path_ = name;
      descriptor_ = ::open((path_ / kFolderLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    }
    if (descriptor_ < 0) {
      const int error = errno;
      if (!path_.empty()) ::rmdir(path_.c_str());
      throw Error(ErrorCode::kIo, fmt::format("no folder can be made in {}: {}", parent.string(),
                                              std::strerror(error)));
    }
    // Another process that looks for leftovers may remove the folder between the two calls.
    if (try_lock(descriptor_) != Lock::kRefused && !is_unlinked(descriptor_)) return;
    ::close(descriptor_);
    descriptor_ = -1;
  }
}

TemporaryFolder::~TemporaryFolder() {
  remove_temporary_folder(path_);
  ::close(descriptor_);
}

}  // namespace rholm
