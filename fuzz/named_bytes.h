// Bytes in memory, for readers that take the name of a file.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <span>
#include <string>

#include "shape_fuzzing.h"

namespace rholm::fuzzing {

// A file in memory that can be opened by its name.
class NamedBytes {
 public:
  explicit NamedBytes(std::span<const char> bytes) : file_(::memfd_create("fuzz", 0)) {
    require(file_ >= 0);
    require(::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~NamedBytes() { ::close(file_); }
  NamedBytes(const NamedBytes&) = delete;
  NamedBytes& operator=(const NamedBytes&) = delete;
  std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace rholm::fuzzing
