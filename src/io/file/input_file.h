// A file that is read. Layer: io.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <unistd.h>

namespace rholm {

class InputFile {
 public:
  // Opens a file; "-" is standard input. Throws Io.
  explicit InputFile(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  // Returns the size of the file at opening; 0 for pipes and devices, whose size is unknown.
  std::size_t size() const { return size_; }
  // Reads at most room.size() bytes. Reads nothing if a signal interrupts, or if no byte comes
  // within a tenth of a second. The caller can then ask whether to go on. Throws Io.
  struct Piece {
    std::size_t size = 0;
    bool ended = false;
  };
  Piece read(std::span<char> room);

 private:
  struct Descriptor {
    int value = STDIN_FILENO;
    Descriptor() = default;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
      if (value > STDIN_FILENO) ::close(value);
    }
  };
  [[noreturn]] void fail(int error) const;

  std::string name_;
  Descriptor descriptor_;
  std::size_t size_ = 0;
};

}  // namespace rholm
