#include "cli/studio/page.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/page_folder.h"
#include "cli/files/paths.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kMaxFiles = 2000;  // chosen: prevents reading all of a wrong folder

constexpr const char* kNoPage =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>rholm studio</title>"
    "<body style=\"font-family:sans-serif;max-width:40em;margin:3em auto;line-height:1.5\">"
    "<h1>The studio runs, but its page is not installed</h1><p>In the sources of rholm, "
    "<code>scripts/studio</code> builds it into <code>web/dist</code>, where the program finds it; "
    "<code>rholm studio --page DIR</code> takes it from elsewhere.</p></body></html>";

std::string type_of(const std::string& name) {
  static const std::map<std::string, std::string> kTypes = {{".html", "text/html; charset=utf-8"},
                                                            {".js", "text/javascript"},
                                                            {".mjs", "text/javascript"},
                                                            {".css", "text/css"},
                                                            {".svg", "image/svg+xml"},
                                                            {".png", "image/png"},
                                                            {".ico", "image/x-icon"},
                                                            {".json", "application/json"},
                                                            {".woff2", "font/woff2"},
                                                            {".wasm", "application/wasm"},
                                                            {".txt", "text/plain; charset=utf-8"}};
  const auto found = kTypes.find(extension_of(name));
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

PageFile file_of(const std::string& name, const std::vector<char>& bytes) {
  return {type_of(name), std::make_shared<const std::string>(bytes.begin(), bytes.end())};
}

}  // namespace

Page read_page(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_regular_file(fs::path(folder) / "index.html", error)) {
    throw Error(
        ErrorCode::kIo,
        fmt::format(
            "{} has no index.html and is not a page; run 'scripts/studio' in the sources of rholm",
            folder));
  }
  Page page;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    if (page.size() == kMaxFiles) {
      throw Error(ErrorCode::kIo,
                  fmt::format("{} has more than {} files and is not a page", folder, kMaxFiles));
    }
    const std::string name = fs::relative(entry.path(), folder).generic_string();
    page[name] = file_of(name, read_all_bytes(entry.path().string()));
  }
  return page;
}

Page own_page() {
  if (const auto folder = page_folder()) return read_page(*folder);
  const std::string_view text = kNoPage;
  return {{"index.html", file_of("index.html", {text.begin(), text.end()})}};
}

}  // namespace rholm::cli
