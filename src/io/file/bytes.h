// Whole files in memory. Layer: io.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>

#include "rholm/context.h"

namespace rholm {

// The content of a file, in memory that is not cleared before it is filled.
class Bytes {
 public:
  Bytes() = default;
  Bytes(char* data, std::size_t size) : data_(data), size_(size) {}  // owns memory from malloc
  std::span<const char> view() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* data) const { std::free(data); }
  };
  std::unique_ptr<char, Free> data_;
  std::size_t size_ = 0;
};

// Reads a whole file; "-" is standard input. Uses large reads, not a memory map: if another program
// truncates a mapped file, the reader is killed (SIGBUS). Copying costs little beside parsing.
// Reports stage "read" from 0 to `to`; a signal that interrupts a read asks the callback whether to
// cancel. Throws Io with the name and the reason, Cancelled.
Bytes read_bytes(const std::filesystem::path& path, const Context& context = {}, double to = 1);

}  // namespace rholm
