// A file by its descriptor: written from its end on, or in place, read at any place. Layer: io,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace rholm {

// All throw Io with the file's name and the reason.
class SpillFile {
 public:
  enum class Mode { kNew, kAppend, kInPlace, kRead, kLock };
  SpillFile(const std::filesystem::path& path, Mode mode);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  const std::string& name() const { return name_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const;
  void write(std::span<const std::byte> bytes);
  void write_at(std::uint64_t at, std::span<const std::byte> bytes);
  // The file has that size, on the disk, where the file system can do that.
  void make_room(std::uint64_t size);
  // False if the file ends before.
  bool read(std::uint64_t at, std::span<std::byte> bytes) const;
  void sync();
  void close();  // some file systems say only here that they are full

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace rholm
