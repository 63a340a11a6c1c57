// Union-find over 0 ... n - 1 in which members of a set have a sign relative to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace rholm {

class SignedSets {
 public:
  struct Member {
    std::uint32_t set = 0;  // smallest member of the set
    bool opposite = false;  // the sign differs from the smallest member's sign
  };

  explicit SignedSets(std::size_t n) : parent_(n), opposite_(n, 0) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  Member find(std::uint32_t i) {
    std::uint32_t root = i;
    bool sign = false;  // sign of i relative to its root
    while (parent_[root] != root) {
      sign ^= opposite_[root] != 0;
      root = parent_[root];
    }
    for (bool rest = sign; parent_[i] != root && i != root;) {  // the whole path points to the root
      const std::uint32_t next = std::exchange(parent_[i], root);
      const bool next_rest = rest ^ (opposite_[i] != 0);
      opposite_[i] = rest;
      rest = next_rest;
      i = next;
    }
    return {root, sign};
  }

  // Unites the sets of i and j, which then have equal or opposite signs. Returns false and changes
  // nothing if i and j are in one set already.
  bool unite(std::uint32_t i, std::uint32_t j, bool opposite) {
    Member a = find(i), b = find(j);
    if (a.set == b.set) return false;
    if (a.set > b.set) std::swap(a, b);
    parent_[b.set] = a.set;
    opposite_[b.set] = opposite ^ a.opposite ^ b.opposite;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<char> opposite_;  // sign relative to the parent
};

}  // namespace rholm
