// What programs that were killed have left behind. Layer: io, private.
//
// Whoever makes a temporary file that has a name holds a lock on it, and whoever makes a temporary
// folder holds one on a file in it. The system drops the lock when the process ends, however it
// ends: what can be locked belongs to nobody any more.
#pragma once

#include <filesystem>
#include <string_view>

namespace rholm {

enum class Lock {
  kTaken,
  kRefused,  // another process has it
  kNone      // the file system has no locks
};
// Locks an open file without waiting.
Lock try_lock(int descriptor);

// Whether an open file has no name any more.
bool is_unlinked(int descriptor);

// Names of temporary files: ".rholm.PID-N.part".
inline constexpr std::string_view kTemporaryBegin = ".rholm.";
inline constexpr std::string_view kTemporaryEnd = ".part";
// The file in a temporary folder that carries the lock; a folder without it is not ours.
inline constexpr const char* kFolderLock = ".rholm-lock";

// Remove the temporary files in `folder`, or the temporary folders there whose names begin with
// `kind`, that are of this user and that nobody holds. Once in the life of a process for each
// `folder`, since it can be large. Errors are ignored.
void remove_left_files(const std::filesystem::path& folder) noexcept;
void remove_left_folders(const std::filesystem::path& folder, std::string_view kind) noexcept;

// Removes a temporary folder, its lock last.
void remove_temporary_folder(const std::filesystem::path& path) noexcept;

}  // namespace rholm
