#include "shape/topology/identical.h"

#include <array>
#include <bit>
#include <utility>

#include "base/parallel.h"

namespace rholm {
namespace {

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }  // -0 + 0 = 0

std::uint64_t hash(const Vec3& v) {
  // Odd multipliers of xxHash64; the shifts move high bits, in which doubles differ, down.
  std::uint64_t h = bits(v.x) * 0x9e3779b185ebca87ULL;
  h = (h ^ (h >> 32) ^ bits(v.y)) * 0xc2b2ae3d27d4eb4fULL;
  h = (h ^ (h >> 29) ^ bits(v.z)) * 0x165667b19e3779f9ULL;
  return h ^ (h >> 32);
}

// Number of parts into which points are sorted by the highest bits of their hashes. Each part has
// its own table, which stays in the cache.
constexpr std::size_t kParts = 64;
constexpr std::size_t kGrain = 4096;  // chosen

struct Hashed {
  std::uint32_t low;  // bits of the hash
  std::uint32_t index;
};
struct Parts {
  std::vector<Hashed> points;                      // ascending within each part
  std::array<std::uint32_t, kParts + 1> first{0};  // start of each part, and the end of the last
};

Parts sort_by_hash(std::span<const Vec3> points, const Context& context) {
  const auto part_of = [](std::uint64_t h) { return static_cast<std::size_t>(h >> 58); };
  Parts parts;
  parts.points.resize(points.size());
  std::vector<std::array<std::uint32_t, kParts>> places((points.size() + kGrain - 1) / kGrain);
  parallel_for(points.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::array<std::uint32_t, kParts>& counts = places[begin / kGrain];
    counts.fill(0);
    for (std::size_t i = begin; i < end; ++i) ++counts[part_of(hash(points[i]))];
  });
  std::uint32_t next = 0;
  for (std::size_t p = 0; p < kParts; ++p) {
    parts.first[p] = next;
    for (auto& counts : places) next += std::exchange(counts[p], next);
  }
  parts.first[kParts] = next;
  parallel_for(points.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::array<std::uint32_t, kParts>& place = places[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t h = hash(points[i]);
      parts.points[place[part_of(h)]++] = {static_cast<std::uint32_t>(h),
                                           static_cast<std::uint32_t>(i)};
    }
  });
  return parts;
}

void find_first(std::span<const Vec3> points, std::span<const Hashed> part,
                std::vector<std::uint32_t>& first) {
  constexpr Hashed kFree{0, 0xffffffff};
  const std::size_t slots = std::bit_ceil(2 * part.size() + 1);
  std::vector<Hashed> table(slots, kFree);
  for (const Hashed& own : part) {
    std::size_t slot = own.low & (slots - 1);
    const auto is_other = [&](const Hashed& there) {
      return there.low != own.low || !(points[there.index] == points[own.index]);
    };
    while (table[slot].index != kFree.index && is_other(table[slot])) {
      slot = (slot + 1) & (slots - 1);
    }
    if (table[slot].index == kFree.index) table[slot] = own;
    first[own.index] = table[slot].index;
  }
}

}  // namespace

std::vector<std::uint32_t> first_identical(std::span<const Vec3> points, const Context& context) {
  const Parts parts = sort_by_hash(points, context);
  std::vector<std::uint32_t> first(points.size());
  parallel_for(kParts, 1, context, {}, [&](std::size_t p, std::size_t) {
    const std::span<const Hashed> all(parts.points);
    find_first(points, all.subspan(parts.first[p], parts.first[p + 1] - parts.first[p]), first);
  });
  return first;
}

}  // namespace rholm
