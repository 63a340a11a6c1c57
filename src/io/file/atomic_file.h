// Files that are written completely or not at all. Layer: io.
#pragma once

#include <atomic>
#include <filesystem>
#include <span>
#include <string>

#include "rholm/context.h"

namespace rholm {

// A file being written. The bytes go to a temporary file on the same file system. commit() renames
// it to `path`; without commit(), the destructor removes it. `path` thus always holds the complete
// old or new content. Symbolic links are followed, and an existing file keeps its permissions.
// Written directly are "-" (standard output), files that are not regular (a pipe, /dev/null), and
// paths of descriptors of this process (/dev/stdout, /dev/fd/3).
//
// The temporary file has no name if the file system supports this and can name it later. Nothing
// then remains of it if the process is killed. Otherwise it is a hidden file in the folder of
// `path`. Hidden files of killed processes are removed there first.
//
// There is no fsync: files are safe from interrupted programs, not from power failures.
class AtomicFile {
 public:
  enum class Writers {
    kThisProcess,
    kSeveral  // other processes open temporary_path() too: its name is visible to them
  };
  // If a signal interrupts a write, `context` is asked whether to cancel. Throws Io, Cancelled.
  explicit AtomicFile(const std::filesystem::path& path, const Context& context = {},
                      Writers writers = Writers::kThisProcess);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Returns the file that becomes `path`, for libraries that open files by name (they may truncate
  // it). Empty if the output is written directly.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  void write(std::span<const char> bytes);  // throws Io, Cancelled
  void commit();                            // throws Io; at most once, the last call

 private:
  bool open_nameless();
  void open_named();
  void open_directly(const std::filesystem::path& path);
  void give_a_name();
  void close(int descriptor);

  std::string name_;              // for messages
  std::filesystem::path target_;  // the regular file to replace; empty if written directly
  std::filesystem::path temporary_;
  Context context_;
  int descriptor_ = -1;
  bool is_nameless_ = false;
  std::atomic<char*>* slot_ = nullptr;  // where discard_unfinished_files() finds the name
};

}  // namespace rholm
