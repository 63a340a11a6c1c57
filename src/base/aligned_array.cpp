#include "base/aligned_array.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

#include "base/poison.h"

namespace rholm {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{1} << 21;
// Chosen: in smaller blocks, a huge page that is only partly filled costs more than it saves.
constexpr std::size_t kHugeFrom = 2 * kHugePage;

std::size_t round_up(std::size_t n, std::size_t unit) { return (n + unit - 1) / unit * unit; }

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  const std::size_t unit = bytes >= kHugeFrom ? kHugePage : kCacheLine;
  if (bytes > std::numeric_limits<std::size_t>::max() - unit) throw std::bad_alloc();
  const std::size_t size = round_up(bytes == 0 ? 1 : bytes, unit == kHugePage ? 4096 : unit);
  void* data = nullptr;
  if (posix_memalign(&data, unit, size) != 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // The system may refuse this advice without harm.
  if (unit == kHugePage) madvise(data, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  poison_scratch(data, bytes);
  return data;
}

void free_aligned(void* data) noexcept { std::free(data); }

void* allocate_zeroed(std::size_t bytes, std::size_t& mapped) {
  mapped = 0;
  if (bytes < kHugeFrom) {
    void* const data = allocate_aligned(bytes);
    std::memset(data, 0, bytes);
    return data;
  }
  if (bytes > std::numeric_limits<std::size_t>::max() - 2 * kHugePage) throw std::bad_alloc();
  const std::size_t size = round_up(bytes, 4096);
  // The parts of the mapping in front of the aligned block and behind it are unmapped at once.
  void* const room =
      mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  const auto from = reinterpret_cast<std::uintptr_t>(room);
  const std::size_t before = round_up(from, kHugePage) - from;
  std::byte* const data = static_cast<std::byte*>(room) + before;
  if (before > 0) munmap(room, before);
  if (before < kHugePage) munmap(data + size, kHugePage - before);
#ifdef MADV_HUGEPAGE
  madvise(data, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  mapped = size;
  return data;
}

void free_zeroed(void* data, std::size_t mapped) noexcept {
  if (mapped == 0) return free_aligned(data);
  munmap(data, mapped);
}

}  // namespace rholm
