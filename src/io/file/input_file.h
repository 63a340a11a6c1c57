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
  // "-" is standard input. Throws Io.
  explicit InputFile(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  // That the file has now; 0 for pipes and devices, whose size is not known.
  std::size_t size() const { return size_; }
  // Reads at most that much; nothing if a signal came first, or if no byte came within a tenth of
  // a second: the caller asks whether to go on, on whatever thread it waits. Throws Io.
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
