#include "base/aligned_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <limits>
#include <new>

namespace rholm {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{1} << 21;
// Chosen: below, a huge page that is filled in part costs more than it saves.
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
  // A wish that may be refused without harm.
  if (unit == kHugePage) madvise(data, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return data;
}

void free_aligned(void* data) noexcept { std::free(data); }

}  // namespace rholm
