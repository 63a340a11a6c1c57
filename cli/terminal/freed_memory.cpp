#include "cli/terminal/freed_memory.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#endif

namespace rholm::cli {
namespace {

std::atomic<std::size_t> limit_in_force = 0;  // 0: none
std::atomic<double> enough_memory = 0;

#if defined(RLIMIT_DATA) && !defined(RHOLM_SANITIZED)
// Returns a line of /proc/self/status, in bytes; 0 if it is missing.
std::size_t own_memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kibibytes = 0;
    if (word == name + ":" && status >> kibibytes) return kibibytes << 10;
  }
  return 0;
}

void limit_data(std::size_t bytes, int threads) {
  // The system counts writable memory, touched or not. Room for the stacks of threads, which are
  // almost empty, is therefore added. Chosen: 26 MiB for memory of libraries besides arrays.
  constexpr std::size_t kStack = std::size_t{4} << 20;  // stack size of oneTBB's threads
  constexpr std::size_t kBeside = std::size_t{26} << 20;
  const std::size_t untouched =
      own_memory("VmData") - std::min(own_memory("VmData"), own_memory("RssAnon"));
  const std::size_t others = static_cast<std::size_t>(std::max(threads, 1) - 1);
  rlimit limit = {};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const rlim_t wanted = bytes + kBeside + untouched + others * kStack;
  limit.rlim_cur = std::min(wanted, limit.rlim_max);
  setrlimit(RLIMIT_DATA, &limit);
}
#else
void limit_data(std::size_t, int) {}
#endif

}  // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargest = 16 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 16 * kLargest);
#endif
}

void start_on_huge_pages() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  constexpr int kRoom = 64 << 20;  // chosen: a report of Bennu needs little more at once
  // The heap grows by this amount more than requested, without touching it.
  mallopt(M_TOP_PAD, kRoom);
  auto* const first = static_cast<std::byte*>(std::malloc(kHugePage));
  if (first == nullptr) return;
  std::byte* const begin = first + kHugePage - reinterpret_cast<std::uintptr_t>(first) % kHugePage;
  auto* const end = static_cast<std::byte*>(sbrk(0));
  // A hint, which the system may ignore without harm.
  if (begin < end) madvise(begin, static_cast<std::size_t>(end - begin), MADV_HUGEPAGE);
  std::free(first);
  mallopt(M_TOP_PAD, 128 << 10);  // the default
#endif
}

void keep_large_freed_memory() {
  if (memory_limit()) return;
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

void limit_memory(std::size_t bytes, int threads) {
  limit_in_force = bytes;
#ifdef __GLIBC__
  constexpr int kReturned = 1 << 20;  // chosen: larger arrays are mapped and unmapped
  mallopt(M_MMAP_THRESHOLD, kReturned);
  mallopt(M_TRIM_THRESHOLD, kReturned);
  malloc_trim(0);
#endif
  limit_data(bytes, threads);
}

std::optional<std::size_t> memory_limit() {
  const std::size_t bytes = limit_in_force;
  return bytes > 0 ? std::optional(bytes) : std::nullopt;
}

void note_enough_memory(double bytes) {
  double before = enough_memory;
  while (before < bytes && !enough_memory.compare_exchange_weak(before, bytes)) {
  }
}

std::string limit_to_type(double bytes) {
  const double unit = std::pow(10, std::floor(std::log10(bytes / 0x1p30)) - 1);
  return fmt::format("{:.3g}", std::ceil(bytes / 0x1p30 / unit) * unit);
}

std::string beyond_memory_limit() {
  const auto limit = static_cast<double>(limit_in_force);
  std::string text =
      fmt::format("this needs more than the {:.3g} GiB of --max-memory", limit / 0x1p30);
  if (enough_memory > limit) text += fmt::format(": {} would do", limit_to_type(enough_memory));
  return text;
}

}  // namespace rholm::cli
