// Files that appear whole or not at all. Layer: io.
#pragma once

#include <atomic>
#include <filesystem>
#include <span>
#include <string>

#include "rholm/context.h"

namespace rholm {

// A file being written. The bytes go to a temporary file on the same file system; commit() makes it
// `path`, and a destructor without commit() removes it, so that `path` always holds the old or
// the new content whole. A symbolic link is followed, an existing file keeps its permissions.
// "-" (standard output) and what is not a regular file (a pipe, /dev/null) are written directly,
// and so is what the path of a descriptor of this process names (/dev/stdout, /dev/fd/3).
//
// The temporary file has no name where the file system has such files and lets them have one later:
// nothing of it is left when the process is killed. Elsewhere it is a hidden file in the folder of
// `path`. Those that killed processes have left there are removed first.
//
// There is no fsync: the promise is against interrupted programs, not against power failures.
class AtomicFile {
 public:
  enum class Writers {
    kThisProcess,
    kSeveral  // other processes open temporary_path() too: it is a name that all of them see
  };
  // `context` is asked whether to cancel when a signal interrupts a write. Throws Io, Cancelled.
  explicit AtomicFile(const std::filesystem::path& path, const Context& context = {},
                      Writers writers = Writers::kThisProcess);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // The file that becomes `path`, for libraries that open files by name (they may truncate it);
  // empty if the output is written directly.
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
