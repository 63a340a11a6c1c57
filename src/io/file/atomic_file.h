// Files that appear whole or not at all. Layer: io.
#pragma once

#include <atomic>
#include <filesystem>
#include <span>
#include <string>

#include "rholm/context.h"

namespace rholm {

// A file being written. The bytes go to a temporary file in the same folder; commit() renames it
// to `path`, and a destructor without commit() removes it, so that `path` always holds the old or
// the new content whole. A symbolic link is followed, an existing file keeps its permissions.
// "-" (standard output) and what is not a regular file (a pipe, /dev/null) are written directly.
//
// There is no fsync: the promise is against interrupted programs, not against power failures.
class AtomicFile {
 public:
  // `context` is asked whether to cancel when a signal interrupts a write. Throws Io.
  explicit AtomicFile(const std::filesystem::path& path, const Context& context = {});
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // The file that becomes `path`, for libraries that open files by name (they may truncate it);
  // empty if the output is written directly.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  void write(std::span<const char> bytes);  // throws Io, Cancelled
  void commit();                            // throws Io; at most once, the last call

 private:
  void open_temporary(const std::filesystem::path& target);
  void close();

  std::string name_;              // for messages
  std::filesystem::path target_;  // the regular file to replace; empty if written directly
  std::filesystem::path temporary_;
  Context context_;
  int descriptor_ = -1;
  std::atomic<char*>* slot_ = nullptr;  // where discard_unfinished_files() finds the name
};

}  // namespace rholm
