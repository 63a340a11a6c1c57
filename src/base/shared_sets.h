// Union-find over 0 ... n - 1 by several threads at once (Anderson, Woll 1991). Sets, and their
// representatives (the smallest members), do not depend on the order of the unions.
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
  // Returns a member that has been the representative at some time since the call.
  std::uint32_t find(std::uint32_t i) {
    for (;;) {
      const std::uint32_t up = parent(i), over = parent(up);
      if (over == up) return up;
      // A member with a parent never becomes a root again, and all its ancestors are in its set. So
      // the path stays valid, whichever thread writes last.
      at(i).store(over, std::memory_order_relaxed);
      i = over;
    }
  }
  void unite(std::uint32_t i, std::uint32_t j) {
    if (parent(i) == parent(j)) return;  // nearly always so for edges of faces
    for (;;) {
      i = find(i), j = find(j);
      if (i == j) return;
      if (i > j) std::swap(i, j);
      std::uint32_t own = j;  // unless j has got another parent meanwhile
      if (at(j).compare_exchange_strong(own, i, std::memory_order_relaxed)) return;
    }
  }
  // Returns true if i is the smallest member of its set, once all sets are united.
  bool is_first(std::uint32_t i) const { return parent_[i] == i; }

 private:
  // The order is relaxed, because threads exchange nothing but parents.
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref(parent_[i]); }
  std::uint32_t parent(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }

  std::vector<std::uint32_t> parent_;  // a parent is never larger than the member itself
};

}  // namespace rholm
