// The files that the browser shows. Layer: cli.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace rholm::cli {

struct PageFile {
  std::string type;  // "text/javascript"
  std::shared_ptr<const std::string> bytes;
};
// By their names below the address: "index.html", "assets/main.js".
using Page = std::map<std::string, PageFile>;

// All files of a folder that has an index.html, read once: nothing else can be asked for. Throws Io
// for a folder that has none, or more than a page has.
Page read_page(const std::string& folder);

// The page that is installed with the program, or that of the sources it was built from; where
// there is neither, one that says how to get it.
Page own_page();

}  // namespace rholm::cli
