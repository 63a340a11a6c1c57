// The folder of a store: its lock, its manifest, the files of its pieces. Layer: io, private.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "io/spill/spill_file.h"

namespace rholm {

class SpillFolder {
 public:
  // Opens the folder as FolderStore does.
  SpillFolder(const std::filesystem::path& path, const std::string& manifest);
  // Joins a folder that another process has opened and will remove. Throws Io if there is none.
  explicit SpillFolder(const std::filesystem::path& path);
  // Removes all files of the store, unless `kept`.
  ~SpillFolder();
  SpillFolder(const SpillFolder&) = delete;
  SpillFolder& operator=(const SpillFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path pieces() const { return path_ / "pieces"; }
  bool was_there() const { return was_there_; }
  std::uint64_t bytes_there() const { return bytes_there_; }  // bytes of pieces at opening
  void check_room(std::uint64_t bytes) const;
  void keep(bool kept) { kept_ = kept; }
  bool is_kept() const { return kept_; }

 private:
  void lock();
  void take_up(const std::string& wanted);
  void clear() noexcept;

  std::filesystem::path path_;
  bool made_ = false;  // true if this or the resumed run made the folder
  bool was_there_ = false;
  bool kept_ = false;
  bool locked_ = false;
  std::uint64_t bytes_there_ = 0;
  std::unique_ptr<SpillFile> lock_;
};

}  // namespace rholm
