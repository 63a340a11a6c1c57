#include "shape/topology/identical.h"
#include "base/cancel.h"

#include <bit>

namespace rholm {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }  // -0 + 0 = 0

std::uint64_t hash(const Vec3& v) {
  // Odd multipliers of xxHash64; the shifts bring high bits, where doubles differ, down.
  std::uint64_t h = bits(v.x) * 0x9e3779b185ebca87ULL;
  h = (h ^ (h >> 32) ^ bits(v.y)) * 0xc2b2ae3d27d4eb4fULL;
  h = (h ^ (h >> 29) ^ bits(v.z)) * 0x165667b19e3779f9ULL;
  return h ^ (h >> 32);
}

}  // namespace

std::vector<std::uint32_t> first_identical(std::span<const Vec3> points) {
  constexpr std::uint32_t kFree = 0xffffffff;
  const std::size_t slots = std::bit_ceil(2 * points.size() + 1);
  std::vector<std::uint32_t> table(slots, kFree);
  std::vector<std::uint32_t> first(points.size());
  CancelPoll poll;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    poll();
    std::size_t slot = hash(points[i]) & (slots - 1);
    while (table[slot] != kFree && !(points[table[slot]] == points[i])) {
      slot = (slot + 1) & (slots - 1);
    }
    if (table[slot] == kFree) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

}  // namespace rholm
