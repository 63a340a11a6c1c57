// Union-find over 0 ... n - 1 by several threads at once (Anderson, Woll 1991): sets are the same
// in whatever order they are united, and so are their representatives, the smallest members.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rholm {

class SharedSets {
 public:
  explicit SharedSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::size_t size() const { return parent_.size(); }
  // While sets are united: what was the representative at some time since the call.
  std::uint32_t find(std::uint32_t i) {
    for (;;) {
      const std::uint32_t up = parent(i), over = parent(up);
      if (over == up) return up;
      // Whoever has a parent never loses it, and all above it are of its set: whichever thread
      // writes last, the path stays one.
      at(i).store(over, std::memory_order_relaxed);
      i = over;
    }
  }
  void unite(std::uint32_t i, std::uint32_t j) {
    if (parent(i) == parent(j)) return;  // nearly always, of the edges of triangles
    for (;;) {
      i = find(i), j = find(j);
      if (i == j) return;
      if (i > j) std::swap(i, j);
      std::uint32_t own = j;  // unless it has been put below another meanwhile
      if (at(j).compare_exchange_strong(own, i, std::memory_order_relaxed)) return;
    }
  }
  // Once all are united.
  bool is_first(std::uint32_t i) const { return parent_[i] == i; }

 private:
  // Relaxed: parents are all that threads tell each other.
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref(parent_[i]); }
  std::uint32_t parent(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }

  std::vector<std::uint32_t> parent_;  // never larger than the member itself
};

}  // namespace rholm
