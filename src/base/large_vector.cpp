#include "base/large_vector.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kPiece = 4 * kHugePage;  // chosen: takes 1 ms or more

}  // namespace

void touch_pages(void* data, std::size_t bytes, const Context& context) {
#if defined(MADV_HUGEPAGE) && defined(MADV_POPULATE_WRITE)
  // Only whole huge pages are requested. The system may refuse these calls without harm.
  const std::size_t before =
      (kHugePage - reinterpret_cast<std::uintptr_t>(data) % kHugePage) % kHugePage;
  if (bytes < before + kHugePage) return;
  const std::size_t size = (bytes - before) / kHugePage * kHugePage;
  std::byte* const first = static_cast<std::byte*>(data) + before;
  madvise(first, size, MADV_HUGEPAGE);
  const auto populate = [&](std::size_t begin, std::size_t end) {
    madvise(first + begin, end - begin, MADV_POPULATE_WRITE);
  };
  parallel_for(size, kPiece, context, {}, populate, {});  // no place: the loop writes nothing
#endif
}

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace rholm
