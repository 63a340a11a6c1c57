#include "cli/batch/outputs_folder.h"

#include <filesystem>
#include <unordered_set>

#include <fmt/format.h>

namespace rholm::cli {
namespace {

constexpr std::size_t kLongestName = 200;  // chosen: file systems take 255 bytes, with extensions

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string safe_name(const std::string& id) {
  std::string name;
  for (const char c : id.substr(0, kLongestName)) {
    const bool safe = is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
    name += safe ? c : '_';
  }
  if (name.front() == '.' || name.front() == '-') name.front() = '_';
  return name;
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace

std::vector<std::string> file_names(const Manifest& manifest) {
  std::vector<std::string> names;
  std::unordered_set<std::string> taken;
  for (std::size_t row = 0; row < manifest.items.size(); ++row) {
    const std::string& id = manifest.items[row].id;
    std::string name = safe_name(id);
    if (id.size() > kLongestName || taken.contains(lower(name))) name += fmt::format("-{}", row);
    while (!taken.insert(lower(name)).second) name += '_';
    names.push_back(std::move(name));
  }
  return names;
}

TemporaryFolder scratch_folder() {
  return {std::filesystem::temp_directory_path(), "rholm-batch-"};
}

}  // namespace rholm::cli
