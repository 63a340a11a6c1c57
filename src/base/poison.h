// Finds reads of memory that nobody has written. Layer: base.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace rholm {

// Says that scratch memory holds nothing: what a kernel was given to fill, or has left from its
// last use. In the programs of the tests it is filled with NaN (as whole numbers: -1 or the
// largest), so that whoever reads what was not written since is found out; everywhere else this
// does nothing.
void poison_scratch(void* data, std::size_t bytes);

template <typename T>
void poison_scratch(std::span<T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  poison_scratch(values.data(), values.size_bytes());
}
// The same of all that is in `scratch`.
template <typename T>
void poison_all(T& scratch) {
  static_assert(std::is_trivially_copyable_v<T>);
  poison_scratch(&scratch, sizeof scratch);
}

}  // namespace rholm
