// A folder that is deleted with its object. Layer: io, private.
#pragma once

#include <filesystem>
#include <string>

namespace rholm {

// A new folder in `parent`, accessible to its owner only, which is deleted with its content. Its
// name is `kind` and six letters. Folders of the same kind that killed programs have left in
// `parent` are deleted, too.
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
  int descriptor_ = -1;  // holds the lock
};

}  // namespace rholm
