// What comes from a stream and does not fit in memory. Layer: cli.
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

// All bytes of standard input or of a pipe: in memory, or in a file without a name, which is gone
// when this is, however the program ends.
class SpooledInput {
 public:
  // Up to `in_memory` bytes stay there. Throws Io, Cancelled.
  SpooledInput(const std::string& path, std::size_t in_memory, const std::string& folder);
  ~SpooledInput();
  SpooledInput(const SpooledInput&) = delete;
  SpooledInput& operator=(const SpooledInput&) = delete;

  bool is_in_file() const { return file_ >= 0; }
  // A name of that file, for as long as this is there; empty if the bytes are in memory.
  std::string path_of_file() const;
  std::span<const char> bytes() const;
  // Those that are in memory, which has them no longer.
  std::vector<char> take_bytes() { return std::move(memory_); }
  // See map_mesh(); none if the bytes are in memory.
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
