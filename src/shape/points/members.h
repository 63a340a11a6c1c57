// Groups points by the parts that they belong to. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rholm {

// The points of each part, in order. `part` has the part, 0 ... n_parts - 1, of every point.
struct Members {
  std::vector<std::uint32_t> begin;  // n_parts + 1
  std::vector<std::uint32_t> points;

  Members(std::span<const std::uint32_t> part, std::size_t n_parts)
      : begin(n_parts + 1, 0), points(part.size()) {
    for (const std::uint32_t p : part) ++begin[p + 1];
    for (std::size_t p = 0; p < n_parts; ++p) begin[p + 1] += begin[p];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < part.size(); ++i) points[next[part[i]]++] = i;
  }
  std::span<const std::uint32_t> of(std::size_t p) const {
    return std::span(points).subspan(begin[p], begin[p + 1] - begin[p]);
  }
  std::size_t size(std::size_t p) const { return begin[p + 1] - begin[p]; }
};

}  // namespace rholm
