// Files and folders that killed programs have left behind. Layer: io, private.
//
// A program that makes a named temporary file holds a lock on it. For a temporary folder it holds a
// lock on a file in it. The system drops the lock however the process ends: a file that can be
// locked belongs to no running process.
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

// Returns true if an open file has no name any more.
bool is_unlinked(int descriptor);

// Names of temporary files are ".rholm.PID-N.part".
inline constexpr std::string_view kTemporaryBegin = ".rholm.";
inline constexpr std::string_view kTemporaryEnd = ".part";
// The locked file in a temporary folder; a folder without it is not ours.
inline constexpr const char* kFolderLock = ".rholm-lock";

// Remove the temporary files in `folder`, or its temporary folders whose names begin with `kind`.
// They remove only what belongs to this user and is not locked, once per process for each `folder`,
// since it can be large. Errors are ignored.
void remove_left_files(const std::filesystem::path& folder) noexcept;
void remove_left_folders(const std::filesystem::path& folder, std::string_view kind) noexcept;

// Removes a temporary folder, with its lock file last.
void remove_temporary_folder(const std::filesystem::path& path) noexcept;

}  // namespace rholm
