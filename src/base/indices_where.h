// Selects indices by a condition. Layer: base.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"

namespace rholm {

// Returns the i of 0 ... n - 1 for which wanted(i) is true, ascending. Calls it on several threads.
template <typename Wanted>
std::vector<std::uint32_t> indices_where(std::size_t n, const Context& context,
                                         const Wanted& wanted,
                                         CallSite where = {__builtin_FILE(), __builtin_LINE()}) {
  constexpr std::size_t kGrain = 8192;  // chosen: takes some 10 us
  std::vector<std::vector<std::uint32_t>> found((n + kGrain - 1) / kGrain);
  const auto look = [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& own = found[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      if (wanted(static_cast<std::uint32_t>(i))) own.push_back(static_cast<std::uint32_t>(i));
    }
  };
  parallel_for(n, kGrain, context, {}, look, where);
  std::size_t all = 0;
  for (const auto& own : found) all += own.size();
  std::vector<std::uint32_t> indices;
  indices.reserve(all);
  for (const auto& own : found) indices.insert(indices.end(), own.begin(), own.end());
  return indices;
}

}  // namespace rholm
