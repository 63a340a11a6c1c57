// A file or stream of any kind that is read to its end. Layer: cli.
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

  // Returns the number of bytes read; 0 at the end. While it waits for a writer, it checks ten
  // times a second, on any thread, whether the program was interrupted. Throws Io, Cancelled.
  std::size_t read(std::span<char> room);

 private:
  std::string path_;
  int number_;
};

}  // namespace rholm::cli
