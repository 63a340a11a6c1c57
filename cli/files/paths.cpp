#include "cli/files/paths.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "base/plain_text.h"

namespace rholm::cli {

bool is_stream(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return path == "-" || std::filesystem::is_fifo(status) ||
         std::filesystem::is_character_file(status) || std::filesystem::is_socket(status);
}

std::string display_name(const std::string& path) {
  return path == "-" ? "standard input" : escaped_line(path);
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace rholm::cli
