// The user's browser. Layer: cli.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/file/temporary_folder.h"

namespace rholm::cli {

// Opens an address in the browser that the desktop has chosen (xdg-open). The address does not
// stand in the list of processes, which all users can read: the browser is given a file that leads
// there, which only this user can read and which goes with the object.
class Browser {
 public:
  // Below the folder for temporary files. Opens nothing where that cannot be done; see opened().
  Browser(const std::string& address, const std::filesystem::path& temporary);
  bool opened() const { return opened_; }

 private:
  std::optional<TemporaryFolder> folder_;
  bool opened_ = false;
};

}  // namespace rholm::cli
