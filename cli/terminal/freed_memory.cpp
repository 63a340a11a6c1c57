#include "cli/terminal/freed_memory.h"

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#endif

namespace rholm::cli {

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
  constexpr int kRoom = 64 << 20;  // chosen: a report of Bennu has little more at a time
  // The heap grows by that much more than is asked for; nothing of it is touched.
  mallopt(M_TOP_PAD, kRoom);
  auto* const first = static_cast<std::byte*>(std::malloc(kHugePage));
  if (first == nullptr) return;
  std::byte* const begin = first + kHugePage - reinterpret_cast<std::uintptr_t>(first) % kHugePage;
  auto* const end = static_cast<std::byte*>(sbrk(0));
  // A wish that may be refused without harm.
  if (begin < end) madvise(begin, static_cast<std::size_t>(end - begin), MADV_HUGEPAGE);
  std::free(first);
  mallopt(M_TOP_PAD, 128 << 10);  // as it is by default
#endif
}

void keep_large_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace rholm::cli
