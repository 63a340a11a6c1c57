// Vectors of many MB. Layer: base.
#pragma once

#include <cstddef>
#include <vector>

#include "rholm/context.h"

namespace rholm {

// Asks the system for the memory by huge pages, where it offers them, and on all threads: else the
// first thread to write to each page waits for it.
void touch_pages(void* data, std::size_t bytes, const Context& context);

// v of n elements instead of none, with room for `more` that will not be moved.
template <typename T>
void resize_large(std::vector<T>& v, std::size_t n, std::size_t more, const Context& context) {
  v.reserve(n + more);
  touch_pages(v.data(), n * sizeof(T), context);
  v.resize(n);
}

// Frees its memory, which v = {} keeps.
template <typename T>
void release(std::vector<T>& v) {
  std::vector<T>().swap(v);
}

// Gives memory that was freed back to the system. What is asked for in larger pieces than before
// would else be added to it.
void return_free_memory();

}  // namespace rholm
