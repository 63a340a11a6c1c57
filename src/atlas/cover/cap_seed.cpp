#include "atlas/cover/cap_seed.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Cosine of half the angle of a right edge.
constexpr double kSameFace = 0.7;
// Number of nearest points in the mean: on one sheet, and enough to average noisy normals.
constexpr std::size_t kMeanOf = 12;
// Share of the neighbours that determine the sheet's height. Measured on noisy bodies:
// an eighth leaves more noise, a half moves seeds inwards where the sheet is curved.
constexpr double kSettledBy = 0.25;

// Falls faster than the weight of large caps, which do worse with this one (cap_candidate.cpp).
double value_weight(double d2, double support2) {
  const double rest = std::max(0.0, 1 - d2 / support2);
  return rest * rest + 0.01;  // see method 7.4
}

// Returns the mean of the nearest normals that agree with the seed's own.
Vec3 sheet_normal(const OrderedPoints& all, std::size_t seed, const CapWorker& worker) {
  const Vec3& own = all.normals[seed];
  Vec3 sum = own;
  for (std::size_t j = 0; j < std::min(kMeanOf, worker.near.size()); ++j) {
    const Vec3& n = all.normals[worker.near[j].index];
    if (dot(n, own) > 0) sum += n;
  }
  return normalized(sum);
}

}  // namespace

void settle(const OrderedPoints& all, std::size_t seed, CapWorker& worker) {
  const Vec3 sheet = sheet_normal(all, seed, worker);
  const auto most =
      static_cast<std::size_t>(std::ceil(kSettledBy * static_cast<double>(worker.near.size())));
  double height = 0;
  std::size_t n = 0;
  for (std::size_t j = 0; j < std::min(most, worker.near.size()); ++j) {
    const std::size_t i = worker.near[j].index;
    if (dot(all.normals[i], sheet) < kSameFace) continue;
    height += dot(all.points[i] - worker.middle, sheet);
    ++n;
  }
  if (n == 0) return;
  worker.middle += height / static_cast<double>(n) * sheet;
  for (Neighbor& near : worker.near) {
    const Vec3 offset = all.points[near.index] - worker.middle;
    near.distance2 = static_cast<float>(dot(offset, offset));
  }
  std::sort(worker.near.begin(), worker.near.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
  });
}

std::size_t reach_of(const OrderedPoints& all, std::size_t seed, std::size_t wanted,
                     const CapWorker& worker) {
  const Vec3 sheet = sheet_normal(all, seed, worker);
  std::size_t n = 0;
  for (std::size_t j = 0; j < worker.near.size(); ++j) {
    const bool own = dot(all.normals[worker.near[j].index], sheet) >= kOtherSheet;
    if (own && ++n == wanted) return j + 1;
  }
  return 0;
}

Vec3 take_points(const OrderedPoints& all, std::size_t seed, std::size_t k, double support,
                 CapSide side, bool leave_out, CapWorker& worker) {
  worker.points.clear();
  const bool face = side == CapSide::kFace;
  const Vec3 sheet = face ? all.normals[seed] : sheet_normal(all, seed, worker);
  const double least = face ? kSameFace : kOtherSheet;
  Vec3 axis;
  for (std::size_t j = 0; j < k; ++j) {
    const std::size_t i = worker.near[j].index;
    if ((leave_out && i == seed) || dot(all.normals[i], sheet) < least) continue;
    const Vec3 offset = all.points[i] - worker.middle;
    const double weight = value_weight(dot(offset, offset), support * support);
    worker.points.add(offset, all.normals[i], weight);
    axis += weight * all.normals[i];
  }
  worker.points.pad();
  return axis;
}

}  // namespace rholm
