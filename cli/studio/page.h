// The files of the studio's page. Layer: cli.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace rholm::cli {

struct PageFile {
  std::string type;  // "text/javascript"
  std::shared_ptr<const std::string> bytes;
};
// Files by name below the address: "index.html", "assets/main.js".
using Page = std::map<std::string, PageFile>;

// Reads all files of a folder that has an index.html, once: no other file can be requested. Throws
// Io for a folder without one, or with more files than a page has.
Page read_page(const std::string& folder);

// Returns the page installed with the program, or of its source tree; if both are missing, a page
// that tells how to get it.
Page own_page();

}  // namespace rholm::cli
