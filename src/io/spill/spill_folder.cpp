#include "io/spill/spill_folder.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/refuse.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr const char* kPart = ".part";
// The first line of a manifest; kGiven is for folders that existed before.
constexpr const char* kMade = "rholm pieces 1, in a folder of their own\n";
constexpr const char* kGiven = "rholm pieces 1, in a folder that was there\n";

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error) {
  throw Error(ErrorCode::kIo, fmt::format("the folder {} cannot be {}: {}", path.string(), what,
                                          std::strerror(error)));
}

std::string text_of_file(const std::filesystem::path& path) {
  const SpillFile file(path, SpillFile::Mode::kRead);
  constexpr std::uint64_t kMostText = std::uint64_t{1} << 20;  // chosen: far more than is written
  std::string text(std::min(file.size(), kMostText), '\0');
  if (!file.read(0, std::as_writable_bytes(std::span(text)))) text.clear();
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Returns the first line that differs, in both versions.
std::string difference(const std::string& there, const std::string& wanted) {
  const std::vector<std::string> a = lines_of(there), b = lines_of(wanted);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string left = i < a.size() ? a[i] : "nothing",
                      right = i < b.size() ? b[i] : "nothing";
    if (left != right) return fmt::format("'{}' there, '{}' now", left, right);
  }
  return "ends of lines";
}

}  // namespace

SpillFolder::SpillFolder(const std::filesystem::path& path, const std::string& manifest)
    : path_(path) {
  std::error_code error;
  made_ = std::filesystem::create_directories(path_, error);
  if (error) fail(path_, "made", error.value());
  if (!std::filesystem::is_directory(path_, error)) fail(path_, "made", ENOTDIR);
  try {
    take_up(manifest);
  } catch (...) {
    if (locked_ && !was_there_) clear();
    if (made_) ::rmdir(path_.c_str());  // fails if the folder is not empty
    throw;
  }
}

SpillFolder::SpillFolder(const std::filesystem::path& path)
    : path_(path), was_there_(true), kept_(true) {
  std::error_code error;
  if (!std::filesystem::exists(path_ / "manifest", error)) {
    throw Error(ErrorCode::kIo,
                fmt::format("the folder {} is not seen by all processes: give one on a file system "
                            "that they share",
                            path_.string()));
  }
}

void SpillFolder::lock() {
  lock_ = std::make_unique<SpillFile>(path_ / "lock", SpillFile::Mode::kLock);
  const bool locked = ::flock(lock_->descriptor(), LOCK_EX | LOCK_NB) == 0;
  struct stat status = {};
  // A deleted lock file belonged to another process that has just ended. On file systems without
  // locks the work goes on.
  const bool gone = ::fstat(lock_->descriptor(), &status) == 0 && status.st_nlink == 0;
  if ((!locked && errno == EWOULDBLOCK) || gone) {
    throw Error(ErrorCode::kIo, fmt::format("the folder {} is in use: another program works there",
                                            path_.string()));
  }
  locked_ = true;
}

void SpillFolder::take_up(const std::string& wanted) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(path_, error)) {
    const std::string name = entry.path().filename().string();
    if (name == "lock" || name == "pieces" || name.starts_with("manifest")) continue;
    refuse(fmt::format("the folder {} has other files, as {}: give a new or an empty folder",
                       path_.string(), name));
  }
  if (error) fail(path_, "read", error.value());
  lock();
  const std::filesystem::path manifest = path_ / "manifest";
  was_there_ = std::filesystem::exists(manifest, error);
  if (was_there_) {
    const std::string text = text_of_file(manifest);
    made_ = text.starts_with(kMade);
    const std::string_view first = made_ ? kMade : kGiven;
    if (!text.starts_with(first)) refuse(manifest.string() + ": is not that of a run");
    const std::string there = text.substr(first.size());
    if (there != wanted) {
      refuse(
          fmt::format("the folder {} has the pieces of another run ({}): give another folder, or "
                      "delete it",
                      path_.string(), difference(there, wanted)));
    }
  }
  std::filesystem::create_directories(pieces(), error);
  if (error) fail(pieces(), "made", error.value());
  std::vector<std::filesystem::path> parts;
  for (auto it = std::filesystem::recursive_directory_iterator(pieces(), error);
       it != std::filesystem::recursive_directory_iterator(); it.increment(error)) {
    if (error) break;
    if (it->path().extension() == kPart) {
      parts.push_back(it->path());
      if (it->is_directory()) it.disable_recursion_pending();
    } else if (it->is_regular_file()) {
      bytes_there_ += it->file_size();
    }
  }
  for (const auto& part : parts) std::filesystem::remove_all(part, error);
  if (was_there_) return;
  const std::filesystem::path half = path_ / "manifest.part";
  SpillFile file(half, SpillFile::Mode::kNew);
  const std::string text = (made_ ? kMade : kGiven) + wanted;
  file.write(std::as_bytes(std::span(text)));
  file.sync();
  file.close();
  if (::rename(half.c_str(), manifest.c_str()) != 0) fail(path_, "written", errno);
}

void SpillFolder::check_room(std::uint64_t bytes) const {
  struct statvfs status = {};
  if (::statvfs(path_.c_str(), &status) != 0) fail(path_, "looked at", errno);
  const std::uint64_t room = std::uint64_t{status.f_bavail} * status.f_frsize;
  if (room >= bytes) return;
  constexpr double kGigabyte = 1e9;
  throw Error(
      ErrorCode::kIo,
      fmt::format("the folder {} has room for {:.1f} GB, and {:.1f} GB are needed: give one "
                  "on another disk",
                  path_.string(), static_cast<double>(room) / kGigabyte,
                  static_cast<double>(bytes) / kGigabyte));
}

void SpillFolder::clear() noexcept {
  std::error_code ignored;
  std::filesystem::remove_all(pieces(), ignored);
  std::filesystem::remove(path_ / "manifest.part", ignored);
  std::filesystem::remove(path_ / "manifest", ignored);
  std::filesystem::remove(path_ / "lock", ignored);
  if (made_) ::rmdir(path_.c_str());
}

SpillFolder::~SpillFolder() {
  if (!kept_) clear();
}

}  // namespace rholm
