// Input from a stream that does not fit in memory. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/mapped_mesh.h"

namespace rholm::cli {

// All bytes of standard input or of a pipe, in memory or in an unnamed file. The system removes the
// file with the object, however the program ends.
class SpooledInput {
 public:
  // Keeps up to `in_memory` bytes in memory. Throws Io, Cancelled.
  SpooledInput(const std::string& path, std::size_t in_memory, const std::string& folder);
  ~SpooledInput();
  SpooledInput(const SpooledInput&) = delete;
  SpooledInput& operator=(const SpooledInput&) = delete;

  bool is_in_file() const { return file_ >= 0; }
  // Returns a name of the file, valid as long as the object; empty if the bytes are in memory.
  std::string path_of_file() const;
  std::span<const char> bytes() const;
  // Moves the bytes out of memory to the caller.
  std::vector<char> take_bytes() { return std::move(memory_); }
  // Maps the file by map_mesh(); returns nothing if the bytes are in memory.
  std::optional<MappedMesh> mesh(const Context& context) const;

 private:
  void to_file(const std::string& folder);
  void write(std::span<const char> bytes, const std::string& folder);

  std::string path_;
  std::vector<char> memory_;
  int file_ = -1;
  std::size_t size_ = 0;
  void* map_ = nullptr;
};

}  // namespace rholm::cli
