#include "io/file/format_lists.h"

namespace rholm {

std::vector<std::string> words_of(const std::vector<std::pair<const char*, bool>>& words) {
  std::vector<std::string> all;
  for (const auto& [word, is_true] : words) {
    if (is_true) all.emplace_back(word);
  }
  return all;
}

const FileExtension* extension_of(const FileFormat& format, const std::filesystem::path& path) {
  std::string name = path.extension().string();
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const FileExtension& extension : format.extensions) {
    if (name == "." + extension.name) return &extension;
  }
  return nullptr;
}

}  // namespace rholm
