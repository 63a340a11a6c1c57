// What a store and its appenders share. Layer: io, private.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/spill/piece_file.h"
#include "io/spill/spill_folder.h"

namespace rholm {

// Sections in memory, or in a file that is open.
class PieceContent {
 public:
  std::vector<std::vector<std::byte>> memory = {};
  std::unique_ptr<SpillFile> file = {};
  std::vector<PieceSection> sections = {};  // of the file
  std::vector<std::uint64_t> starts = {};

  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const auto& section : memory) sum += section.size();
    return sum;
  }
};

class StoreState {
 public:
  mutable std::mutex mutex;
  std::map<std::string, std::shared_ptr<const PieceContent>> pieces;  // in memory
  std::optional<SpillFolder> folder;
  std::atomic<unsigned> counter = 0;  // of unfinished files

  void add(std::uint64_t bytes) {
    const std::lock_guard lock(mutex);
    bytes_ += bytes;
    most_ = std::max(most_, bytes_);
  }
  void take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex);
    bytes_ -= std::min(bytes, bytes_);
  }
  std::uint64_t bytes() const {
    const std::lock_guard lock(mutex);
    return bytes_;
  }
  std::uint64_t most() const {
    const std::lock_guard lock(mutex);
    return most_;
  }
  std::filesystem::path path_of(const std::string& name) const { return folder->pieces() / name; }
  std::filesystem::path part_of(const std::string& name) {
    return folder->pieces() / (name + "." + std::to_string(counter++) + ".part");
  }

 private:
  std::uint64_t bytes_ = 0, most_ = 0;
};

// Throws InvalidInput for what no piece may be called.
void check_piece_name(const std::string& name);

}  // namespace rholm
