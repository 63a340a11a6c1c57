// A file or stream that is read to its end, whatever its kind. Layer: cli.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace rholm::cli {

class InputDescriptor {
 public:
  // "-" is standard input. Throws Io, Cancelled.
  explicit InputDescriptor(const std::string& path);
  ~InputDescriptor();
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;

  // How many bytes came: 0 at the end. While it waits for a writer it asks ten times a second
  // whether the program was interrupted, on whatever thread. Throws Io, Cancelled.
  std::size_t read(std::span<char> room);

 private:
  std::string path_;
  int number_;
};

}  // namespace rholm::cli
