#include "cli/options/memory_options.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "cli/terminal/capture.h"
#include "cli/terminal/freed_memory.h"
#include "rholm/error.h"

namespace rholm::cli {

std::size_t MemoryOptions::limit() const {
  if (gib) return static_cast<std::size_t>(*gib * 0x1p30);
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::size_t limit = pages > 0 && page > 0
                          ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page)
                          : std::size_t{8} << 30;
  // Limit of a container; "max" is no number.
  std::ifstream group("/sys/fs/cgroup/memory.max");
  if (std::size_t allowed = 0; group >> allowed) limit = std::min(limit, allowed);
  return limit;
}

std::string MemoryOptions::folder() const {
  if (!work_dir.empty()) return work_dir;
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? "/tmp" : folder.string();
}

int threads_of(const Context& context) {
  if (context.threads > 0) return context.threads;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void MemoryOptions::keep(const Session& session) const {
  if (!gib || capture() != nullptr) return;
  limit_memory(limit(), threads_of(session.context()));
}

std::optional<std::string> MemoryOptions::refusal(double needed) const {
  // Amounts below the libraries' own memory do not matter.
  constexpr double kNoMatter = 16 << 20;
  if (!gib || needed <= static_cast<double>(limit()) + kNoMatter) return {};
  return fmt::format("more memory than the {:.3g} GiB of --max-memory: {} would do", *gib,
                     limit_to_type(needed));
}

void MemoryOptions::require(double needed, const std::string& what, double most) const {
  if (const std::optional<std::string> refused = refusal(needed)) {
    throw Error(ErrorCode::kOutOfMemory, fmt::format("{} needs {}", what, *refused));
  }
  constexpr double kMore = 1.25;  // chosen
  if (gib) note_enough_memory(std::max(kMore * needed, most));
}

Option max_memory_option(MemoryOptions& options) {
  return {.name = "max-memory",
          .value = "GIB",
          .help = "most memory to use, in GiB; by default the memory of the machine",
          .target = &options.gib,
          .min = 1e-6,
          .max = 1 << 20,
          .group = Group::kAdvanced};
}

std::vector<Option> memory_options(MemoryOptions& options) {
  return {max_memory_option(options),
          {.name = "work-dir",
           .value = "DIR",
           .help = "folder for the part of standard input that does not fit in a quarter of "
                   "--max-memory; by default the folder for temporary files",
           .target = &options.work_dir,
           .group = Group::kAdvanced}};
}

}  // namespace rholm::cli
