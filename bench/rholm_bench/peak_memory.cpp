#include "rholm_bench/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace rholm {
namespace {

// Returns the bytes of a line "Name:   123 kB" in /proc/self/status.
std::optional<std::size_t> status_of(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kibibytes = 0;
    if (word == name && status >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> resident_memory() { return status_of("VmRSS:"); }

std::optional<std::size_t> peak_memory() { return status_of("VmHWM:"); }

bool restart_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);  // so that memory that was freed counts again
#endif
  // proc(5): writing 5 sets the peak to the memory in use now.
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace rholm
