// Vectors of many MB. Layer: base.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/context.h"

namespace rholm {

// Requests the memory from the system on all threads, and as huge pages where the system has them.
// Without this call, the first thread that writes to a page waits for the page.
void touch_pages(void* data, std::size_t bytes, const Context& context);

// Resizes an empty v to n elements, and reserves room for `more` elements behind them.
template <typename T>
void resize_large(std::vector<T>& v, std::size_t n, std::size_t more, const Context& context) {
  v.reserve(n + more);
  touch_pages(v.data(), n * sizeof(T), context);
  v.resize(n);
}

// Frees the memory of v, which v = {} keeps.
template <typename T>
void release(std::vector<T>& v) {
  std::vector<T>().swap(v);
}

// Returns freed memory to the system. Otherwise later requests for larger blocks, which do not fit
// into the freed blocks, would add to the memory in use.
void return_free_memory();

}  // namespace rholm
