#include "reconstruct/points/point_sample.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace rholm {
namespace {

bool is_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Returns bits above the bits that choose a slot.
std::uint32_t more_bits(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 20); }

}  // namespace

std::uint64_t place_hash(const Vec3& p) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // -0 + 0 = 0
  // Odd multipliers of xxHash64, and the finaliser of splitmix64 (base/random.cpp): every bit of
  // the coordinates reaches the highest ones, which decide what is sampled.
  std::uint64_t h = bits(p.x) * 0x9e3779b185ebca87ULL;
  h = (h ^ (h >> 32) ^ bits(p.y)) * 0xc2b2ae3d27d4eb4fULL;
  h = (h ^ (h >> 29) ^ bits(p.z)) * 0x165667b19e3779f9ULL;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
  return h ^ (h >> 31);
}

PointSample::PointSample(std::size_t k) : k_(k), table_(std::bit_ceil(4 * k)) {
  kept_.reserve(2 * k);
}

void PointSample::grow(std::size_t k) {
  if (k <= k_) return;
  k_ = k;
  kept_.reserve(2 * k);
  drop_beyond(kept_.size());  // makes the table larger
}

void PointSample::keep(std::uint64_t hash, const Vec3& p) {
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = hash & mask;  // the lowest bits: the highest are all small
  for (; table_[slot].after != 0; slot = (slot + 1) & mask) {
    if (table_[slot].bits != more_bits(hash)) continue;
    Kept& there = kept_[table_[slot].after - 1];
    if (there.hash != hash) continue;
    // Two different places of one hash, once in 2^64 pairs: the choice must not be by order.
    const Vec3 place{p.x + 0.0, p.y + 0.0, p.z + 0.0};
    if (is_before(place, there.place)) there.place = place;
    return;
  }
  if (kept_.size() == 2 * k_) {
    // A quarter more: of points to come, for a larger sample, fewer may be below than their share.
    drop_beyond(k_ + k_ / 4);
    if (hash <= most_) keep(hash, p);
    return;
  }
  kept_.push_back({hash, {p.x + 0.0, p.y + 0.0, p.z + 0.0}});
  table_[slot] = {more_bits(hash), static_cast<std::uint32_t>(kept_.size())};
}

void PointSample::drop_beyond(std::size_t k) {
  if (k < kept_.size()) {
    const auto last = kept_.begin() + static_cast<std::ptrdiff_t>(k) - 1;
    std::nth_element(kept_.begin(), last, kept_.end(),
                     [](const Kept& a, const Kept& b) { return a.hash < b.hash; });
    most_ = last->hash;
    kept_.resize(k);
  }
  table_.assign(std::bit_ceil(4 * k_), {});
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    std::size_t slot = kept_[i].hash & mask;
    while (table_[slot].after != 0) slot = (slot + 1) & mask;
    table_[slot] = {more_bits(kept_[i].hash), static_cast<std::uint32_t>(i + 1)};
  }
}

std::vector<Vec3> PointSample::take(std::size_t k) {
  const bool all = most_ == std::numeric_limits<std::uint64_t>::max() && kept_.size() <= k;
  drop_beyond(k);
  std::sort(kept_.begin(), kept_.end(),
            [](const Kept& a, const Kept& b) { return a.hash < b.hash; });
  const auto n = static_cast<double>(kept_.size());
  // The k-th smallest of n uniform numbers is k / (n + 1) on average.
  n_different_ = all ? n : (n - 1) / (static_cast<double>(kept_.back().hash) * 0x1p-64);
  std::vector<Vec3> places;
  places.reserve(kept_.size());
  for (const Kept& kept : kept_) places.push_back(kept.place);
  return places;
}

}  // namespace rholm
