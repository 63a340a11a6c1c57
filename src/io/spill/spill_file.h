// A file with its descriptor: written at its end or in place, read at any position. Layer: io,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace rholm {

// All members throw Io with the file's name and the reason.
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
  // Reserves this size on the disk, if the file system supports this.
  void make_room(std::uint64_t size);
  // Returns false if the file ends before.
  bool read(std::uint64_t at, std::span<std::byte> bytes) const;
  void sync();
  void close();  // some file systems report a full disk only here

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace rholm
