#include "cli/files/page_folder.h"

#include <filesystem>
#include <vector>

#include "cli/files/inputs.h"
#include "rholm/error.h"

namespace rholm::cli {

std::optional<std::string> page_folder() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (program.empty()) return std::nullopt;
  // Places of the program: PREFIX/bin/rholm; for a wheel
  // PREFIX/lib/pythonX.Y/site-packages/rholm.scripts/rholm, where auditwheel moves it;
  // build/cli/rholm, and build/PRESET/cli/rholm.
  for (const char* place : {"../share/rholm/studio", "../../../../share/rholm/studio",
                            "../../web/dist", "../../../web/dist"}) {
    const fs::path folder = program / place;
    if (fs::is_regular_file(folder / "index.html", error)) return folder.string();
  }
  return std::nullopt;
}

std::string viewer_script() {
  const std::optional<std::string> folder = page_folder();
  if (!folder) {
    throw Error(ErrorCode::kUnsupported,
                "interactive pages need the viewer, which is not installed; 'scripts/studio' in "
                "the sources of rholm builds it");
  }
  const std::vector<char> bytes = read_all_bytes(*folder + "/viewer/viewer.js");
  return {bytes.begin(), bytes.end()};
}

}  // namespace rholm::cli
