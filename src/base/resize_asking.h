// Resizes large arrays. The first touch of their pages takes a second for ten gigabytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/cancel.h"

namespace rholm {

// Does the same as values.resize(n), and asks from time to time whether to cancel.
template <class T>
void resize_asking(std::vector<T>& values, std::size_t n) {
  constexpr std::size_t kStep = std::size_t{1} << 18;  // chosen: takes a millisecond
  values.reserve(n);
  while (values.size() < n) {
    ask_cancel();
    values.resize(std::min(n, values.size() + kStep));
  }
  values.resize(n);
}

}  // namespace rholm
