#include "cli/options/memory_options.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace rholm::cli {

std::size_t MemoryOptions::limit() const {
  if (gib) return static_cast<std::size_t>(*gib * 0x1p30);
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::size_t limit = pages > 0 && page > 0
                          ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page)
                          : std::size_t{8} << 30;
  // Of a container; "max" is no number.
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

Option max_memory_option(MemoryOptions& options) {
  return {.name = "max-memory",
          .value = "GIB",
          .help = "memory that may be used; by default what the machine has",
          .target = &options.gib,
          .min = 1e-6,
          .max = 1 << 20};
}

std::vector<Option> memory_options(MemoryOptions& options) {
  return {max_memory_option(options),
          {.name = "work-dir",
           .value = "DIR",
           .help = "folder for what of standard input does not fit in a quarter of it; by default "
                   "that of the system's temporary files",
           .target = &options.work_dir}};
}

}  // namespace rholm::cli
