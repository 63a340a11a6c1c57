// The user's browser. Layer: cli.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/temporary_folder.h"

namespace rholm::cli {

// Opens an address in the desktop's browser (xdg-open). The list of processes, which all users can
// read, does not show the address: the browser gets a file that redirects to it. Only this user can
// read the file, and it is removed with the object.
class Browser {
 public:
  // Puts the file below the folder for temporary files. Does nothing if that fails; see opened().
  Browser(const std::string& address, const std::filesystem::path& temporary);
  bool opened() const { return opened_; }

 private:
  std::optional<TemporaryFolder> folder_;
  bool opened_ = false;
};

}  // namespace rholm::cli
