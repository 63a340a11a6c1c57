// Temporary files in their own folder, for library
// functions that take only file names. Layer: studio.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/temporary_folder.h"

namespace rholm::studio {

// The folder is made below `parent` when needed, accessible to its owner only,
// and is deleted with the object. Functions throw Io. Safe for several threads.
class Scratch {
 public:
  explicit Scratch(std::filesystem::path parent) : parent_(std::move(parent)) {}

  // Returns the bytes that `write` puts into a file whose name has this ending.
  std::string written(const std::string& ending,
                      const std::function<void(const std::filesystem::path&)>& write);
  // Calls `read` with a file that contains the bytes.
  void read(std::string_view bytes, const std::string& ending,
            const std::function<void(const std::filesystem::path&)>& read);

 private:
  std::filesystem::path next_file(const std::string& ending);

  std::filesystem::path parent_;
  std::mutex mutex_;
  std::optional<TemporaryFolder> folder_;
  int files_ = 0;
};

}  // namespace rholm::studio
