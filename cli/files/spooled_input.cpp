#include "cli/files/spooled_input.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "cli/files/input_descriptor.h"
#include "cli/files/paths.h"
#include "cli/terminal/interrupt.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;  // chosen: system calls cost little

std::string reason() { return std::strerror(errno); }

int nameless_file(const std::string& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
#endif
  std::string name = folder + "/rholm-XXXXXX";
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

SpooledInput::SpooledInput(const std::string& path, std::size_t in_memory,
                           const std::string& folder)
    : path_(path) {
  InputDescriptor input(path);
  try {
    std::vector<char> chunk(kChunk);
    while (const std::size_t n = input.read(chunk)) {
      if (!is_in_file() && size_ + n > in_memory) to_file(folder);
      const std::span<const char> got = std::span(chunk).first(n);
      if (is_in_file()) {
        write(got, folder);
      } else {
        memory_.insert(memory_.end(), got.begin(), got.end());
      }
      size_ += n;
    }
    if (!is_in_file()) return;
    map_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file_, 0);
    if (map_ == MAP_FAILED) {
      map_ = nullptr;
      throw Error(ErrorCode::kIo, fmt::format("the copy of {} in {} cannot be mapped: {}",
                                              display_name(path), folder, reason()));
    }
  } catch (...) {
    if (file_ >= 0) ::close(file_);
    throw;
  }
}

SpooledInput::~SpooledInput() {
  if (map_ != nullptr) ::munmap(map_, size_);
  if (file_ >= 0) ::close(file_);
}

void SpooledInput::to_file(const std::string& folder) {
  file_ = nameless_file(folder);
  if (file_ < 0) {
    throw Error(ErrorCode::kIo,
                fmt::format("{} is larger than a quarter of --max-memory, and no file can be made "
                            "in {} to hold it: {}; name another folder with --work-dir",
                            display_name(path_), folder, reason()));
  }
  write(memory_, folder);
  std::vector<char>().swap(memory_);
}

void SpooledInput::write(std::span<const char> bytes, const std::string& folder) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file_, bytes.data(), bytes.size());
    const int error = errno;
    stop_if_interrupted();
    if (n > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    } else if (error != EINTR) {
      throw Error(
          ErrorCode::kIo,
          fmt::format(
              "{} has no room for {} after {:.3g} GiB: {}; name another folder with --work-dir",
              folder, display_name(path_), static_cast<double>(size_) / 0x1p30,
              std::strerror(error)));
    }
  }
}

std::span<const char> SpooledInput::bytes() const {
  if (map_ != nullptr) return {static_cast<const char*>(map_), size_};
  return memory_;
}

std::optional<MappedMesh> SpooledInput::mesh(const Context& context) const {
  if (!is_in_file()) return {};
  return map_mesh(fmt::format("/proc/self/fd/{}", file_), context);
}

std::string SpooledInput::path_of_file() const {
  return is_in_file() ? fmt::format("/proc/self/fd/{}", file_) : std::string();
}

}  // namespace rholm::cli
