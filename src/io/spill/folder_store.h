// A store in a folder, whose pieces are files. Layer: io, private.
//
// The folder has FOLDER/lock, FOLDER/manifest, and FOLDER/pieces with a file for each piece. Only
// names of incomplete files end in ".part".
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/spill/spill_folder.h"
#include "parts/store.h"

namespace rholm {

class FolderStore final : public PieceStore {
 public:
  // Makes the folder if there is none. `manifest` describes the origin of the pieces: the input,
  // the options, the version. A folder with pieces of the same manifest is resumed with its
  // complete pieces. Throws Io if the folder cannot be made or another process has it; InvalidInput
  // if it has pieces of another manifest, or other files.
  explicit FolderStore(const std::filesystem::path& folder, const std::string& manifest = {});
  // Opens the folder of a store of another process, for as long as it exists. Two processes must
  // not write the same piece at the same time. Throws Io if there is no folder.
  static std::unique_ptr<FolderStore> joined(const std::filesystem::path& folder);
  // The destructor removes what the store has made, unless keep(true) was called.

  using PieceStore::write;

  bool was_there() const { return folder_->was_there(); }  // true if an earlier run is resumed
  bool in_memory() const override { return false; }
  bool has(const std::string& name) const override;
  void write(const std::string& name, std::vector<SectionBytes> sections) override;
  PieceReader open(const std::string& name) const override;
  void remove(const std::string& name) override;
  std::unique_ptr<GrowingPieces> grow(const std::string& group, std::size_t n) override;
  void check_room(std::uint64_t bytes) const override { folder_->check_room(bytes); }
  void keep(bool kept) override { folder_->keep(kept); }
  bool is_kept() const override { return folder_->is_kept(); }

 private:
  class Growing;

  explicit FolderStore(std::unique_ptr<SpillFolder> folder) : folder_(std::move(folder)) {}
  std::filesystem::path path_of(const std::string& name) const { return folder_->pieces() / name; }
  std::filesystem::path part_of(const std::string& name) {
    return folder_->pieces() / (name + "." + std::to_string(counter_++) + ".part");
  }

  std::unique_ptr<SpillFolder> folder_;
  std::atomic<unsigned> counter_ = 0;  // numbers the unfinished files
};

}  // namespace rholm
