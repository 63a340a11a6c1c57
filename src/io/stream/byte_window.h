// A file from its begin to its end through a window. Layer: io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file/input_file.h"
#include "rholm/context.h"

namespace rholm {

class ByteWindow {
 public:
  // "-" is standard input. Throws Io.
  explicit ByteWindow(const std::filesystem::path& path) : file_(path) {}

  const std::string& name() const { return file_.name(); }
  // What is in the window, after reading on until that is n bytes or the end. Throws Io, Cancelled.
  std::span<const char> at_least(std::size_t n, const Context& context);
  std::span<const char> bytes() const { return {bytes_.data() + first_, last_ - first_}; }
  // Moves the window's begin on.
  void pass(std::size_t n) {
    first_ += n;
    passed_ += n;
  }
  bool ended() const { return ended_; }
  std::uint64_t passed() const { return passed_; }
  std::uint64_t size() const { return file_.size(); }  // 0 for pipes and devices

 private:
  InputFile file_;
  std::uint64_t passed_ = 0;
  bool ended_ = false;
  std::vector<char> bytes_;
  std::size_t first_ = 0, last_ = 0;  // of the window in these
};

}  // namespace rholm
