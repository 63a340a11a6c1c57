#include "studio/scratch.h"

#include <fstream>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm::studio {
namespace {

// Deletes a file at the end of a scope.
struct Removed {
  std::filesystem::path path;
  explicit Removed(std::filesystem::path p) : path(std::move(p)) {}
  ~Removed() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  Removed(const Removed&) = delete;
  Removed& operator=(const Removed&) = delete;
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::string bytes(file ? static_cast<std::size_t>(file.tellg()) : 0, '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw Error(ErrorCode::kIo, "a temporary file cannot be read: " + path.string());
  return bytes;
}

}  // namespace

std::filesystem::path Scratch::next_file(const std::string& ending) {
  const std::lock_guard lock(mutex_);
  if (!folder_) folder_.emplace(parent_, "rholm-studio-");
  return folder_->path() / fmt::format("{}{}", ++files_, ending);
}

std::string Scratch::written(const std::string& ending,
                             const std::function<void(const std::filesystem::path&)>& write) {
  const Removed file(next_file(ending));
  write(file.path);
  return contents(file.path);
}

void Scratch::read(std::string_view bytes, const std::string& ending,
                   const std::function<void(const std::filesystem::path&)>& read) {
  const Removed file(next_file(ending));
  write_file(file.path, bytes);
  read(file.path);
}

}  // namespace rholm::studio
