// Half-edges that wait for their twins.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rholm {

// An edge of two faces is processed once, with the sum of both half-edges. A half-edge whose twin
// is not among the last few thousand is processed alone: the sum is the same, at the price of more
// work.
template <typename HalfEdge>
class TwinCache {
 public:
  TwinCache() : slots_(std::size_t{1} << kBits) {}

  // Adds the half-edge between vertices i and j, in either direction. If its twin waits and
  // join(twin, edge) takes the edge in and is true, calls work(low, high, twin), with the vertices
  // in order. Otherwise the edge waits, and one that waited in its place is processed.
  template <typename Join, typename Work>
  void add(std::uint32_t i, std::uint32_t j, const HalfEdge& edge, const Join& join,
           const Work& work) {
    const std::uint64_t low = std::min(i, j), high = std::max(i, j);
    const std::uint64_t name = (low << 32 | high) + 1;
    Slot& slot = slots_[(name * 0x9E3779B97F4A7C15U) >> (64 - kBits)];  // 2^64 / the golden ratio
    if (slot.name == name && join(slot.edge, edge)) {
      work_slot(slot, work);
      return;
    }
    if (slot.name != 0) work_slot(slot, work);
    slot = {name, edge};
  }

  // Processes all half-edges that wait.
  template <typename Work>
  void flush(const Work& work) {
    for (Slot& slot : slots_) {
      if (slot.name != 0) work_slot(slot, work);
    }
  }

 private:
  static constexpr int kBits = 12;  // chosen: some 130 kB
  struct Slot {
    std::uint64_t name = 0;  // both ends; 0: empty
    HalfEdge edge;
  };
  template <typename Work>
  static void work_slot(Slot& slot, const Work& work) {
    const std::uint64_t ends = slot.name - 1;
    slot.name = 0;
    work(static_cast<std::uint32_t>(ends >> 32), static_cast<std::uint32_t>(ends), slot.edge);
  }
  std::vector<Slot> slots_;
};

}  // namespace rholm
