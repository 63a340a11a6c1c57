// Files in a folder of their own, for what the library reads and writes by name only. Layer:
// studio.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/temporary_folder.h"

namespace rholm::studio {

// The folder is made below `parent` when it is first needed, for its owner only, and goes with the
// object. Throw Io. For several threads.
class Scratch {
 public:
  explicit Scratch(std::filesystem::path parent) : parent_(std::move(parent)) {}

  // The bytes that `write` puts into the file it is given, whose name ends like that.
  std::string written(const std::string& ending,
                      const std::function<void(const std::filesystem::path&)>& write);
  // Calls `read` with a file that holds the bytes.
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
