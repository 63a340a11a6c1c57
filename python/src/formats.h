// Returns a row of the table of formats for rholm/_formats.py.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

#include "rholm/formats.h"

namespace rholm::python {

inline nanobind::tuple format_row(const FileFormat& format, const std::vector<std::string>& held) {
  nanobind::list extensions, words;
  for (const FileExtension& extension : format.extensions) {
    extensions.append(extension.name.c_str());
  }
  for (const std::string& word : held) words.append(word.c_str());
  return nanobind::make_tuple(format.name.c_str(), format.title.c_str(),
                              nanobind::tuple(extensions), format.text, format.binary, format.read,
                              format.written, nanobind::tuple(words), format.help.c_str());
}

}  // namespace rholm::python
