// Helps to find reads of memory that nobody has written. Layer: base.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace rholm {

// Marks scratch memory as uninitialised: memory that a kernel must fill, or that holds values of
// its last use. In the programs of the tests the memory is filled with NaN (as integers: -1 or the
// largest one). Tests then find code that reads memory before writing it. Everywhere else this
// function does nothing.
void poison_scratch(void* data, std::size_t bytes);

template <typename T>
void poison_scratch(std::span<T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  poison_scratch(values.data(), values.size_bytes());
}
// Poisons all bytes of `scratch`.
template <typename T>
void poison_all(T& scratch) {
  static_assert(std::is_trivially_copyable_v<T>);
  poison_scratch(&scratch, sizeof scratch);
}

}  // namespace rholm
