// A folder that goes with the object. Layer: io, private.
#pragma once

#include <filesystem>
#include <string>

namespace rholm {

// A folder of its own in `parent`, for its owner only, deleted with all that is in it. Its name is
// `kind` and six letters. Folders of the same kind that killed programs have left in `parent` are
// deleted as well.
class TemporaryFolder {
 public:
  // Throws Io.
  TemporaryFolder(const std::filesystem::path& parent, const std::string& kind);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;  // has the lock
};

}  // namespace rholm
