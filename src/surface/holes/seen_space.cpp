#include "surface/holes/seen_space.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr double kMostCubes = 256;  // along an axis; chosen: 16 MiB
// Sum of the weights 1, 2, 1 along each axis. Smoothing blurs an edge of seen
// space over two cubes, and keeps a single unseen cube among seen ones empty.
constexpr int kAll = 64;
constexpr std::size_t kGrain = 1024;  // lines per task

// Clips the line from p to q to the box from 0 to `size`; returns false if it misses the box.
bool clip(const Vec3& p, const Vec3& q, const std::array<double, 3>& size, double& first,
          double& last) {
  first = 0, last = 1;
  const double from[3] = {p.x, p.y, p.z};
  const double way[3] = {q.x - p.x, q.y - p.y, q.z - p.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (way[k] == 0) {
      if (from[k] < 0 || from[k] >= size[k]) return false;
      continue;
    }
    const double a = -from[k] / way[k], b = (size[k] - from[k]) / way[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last;
}

}  // namespace

SeenSpace::SeenSpace(std::span<const Vec3> points, std::span<const Vec3> sensors, double edge,
                     double margin, const Context& context)
    : SeenSpace(bounds({points.begin(), points.end()}), edge) {
  add_lines(points, sensors, margin, context);
  smooth(context);
}

SeenSpace::SeenSpace(const SeenCubes& kept, const Context& context)
    : origin_(kept.origin), edge_(kept.edge), size_(kept.size) {
  const bool fits = std::all_of(size_.begin(), size_.end(), [](std::size_t n) {
    return n >= 3 && n <= static_cast<std::size_t>(kMostCubes);
  });
  if (!fits || !(edge_ > 0) || 8 * kept.bits.size() < size_[0] * size_[1] * size_[2]) {
    throw Error(ErrorCode::kInvalidInput, "the seen space of a surface's rules has too few cubes");
  }
  seen_.assign(size_[0] * size_[1] * size_[2], 0);
  for (std::size_t c = 0; c < seen_.size(); ++c) seen_[c] = (kept.bits[c / 8] >> c % 8) & 1;
  smooth(context);
}

SeenSpace::SeenSpace(const Bounds& box, double edge) {
  const Vec3 extent = box.max - box.min;
  edge_ = std::max(edge, std::max({extent.x, extent.y, extent.z}) / (kMostCubes - 3));
  // One layer of cubes is added all around.
  origin_ = box.min - edge_ * Vec3{1, 1, 1};
  const double sides[3] = {extent.x, extent.y, extent.z};
  for (std::size_t k = 0; k < 3; ++k) size_[k] = static_cast<std::size_t>(sides[k] / edge_) + 3;
  seen_.assign(size_[0] * size_[1] * size_[2], 0);
}

void SeenSpace::add_lines(std::span<const Vec3> points, std::span<const Vec3> sensors,
                          double margin, const Context& context) {
  parallel_for(points.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 sight = points[i] - sensors[i];
      const double length = norm(sight);
      if (length > margin) go_through(sensors[i], points[i] - margin / length * sight);
    }
  });
}

std::vector<std::uint64_t> SeenSpace::cubes() const {
  std::vector<std::uint64_t> bits((seen_.size() + 63) / 64, 0);
  for (std::size_t c = 0; c < seen_.size(); ++c) {
    if (seen_[c] != 0) bits[c / 64] |= std::uint64_t{1} << c % 64;
  }
  return bits;
}

void SeenSpace::add_cubes(std::span<const std::uint64_t> cubes) {
  for (std::size_t c = 0; c < seen_.size(); ++c) {
    if ((cubes[c / 64] >> c % 64 & 1) != 0) seen_[c] = 1;
  }
}

// Amanatides and Woo (1987). Cubes are only set, never cleared, so the order is irrelevant.
void SeenSpace::go_through(Vec3 from, Vec3 to) {
  from = (from - origin_) / edge_, to = (to - origin_) / edge_;
  double first = 0, last = 0;
  const std::array<double, 3> sizes = {static_cast<double>(size_[0]), static_cast<double>(size_[1]),
                                       static_cast<double>(size_[2])};
  if (!clip(from, to, sizes, first, last)) return;
  const double start[3] = {from.x, from.y, from.z};
  const double way[3] = {to.x - from.x, to.y - from.y, to.z - from.z};
  std::size_t at[3];
  double next[3], step[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double here = std::clamp(start[k] + first * way[k], 0.0, sizes[k] - 1e-9);
    at[k] = static_cast<std::size_t>(here);
    const double wall = static_cast<double>(at[k]) + (way[k] > 0 ? 1 : 0);
    step[k] = way[k] == 0 ? std::numeric_limits<double>::infinity() : 1 / std::abs(way[k]);
    next[k] = way[k] == 0 ? std::numeric_limits<double>::infinity() : (wall - start[k]) / way[k];
  }
  while (true) {
    std::atomic_ref<std::uint8_t>(seen_[cell(at[0], at[1], at[2])])
        .store(1, std::memory_order_relaxed);
    const std::size_t k =
        next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
    if (next[k] >= last) return;
    next[k] += step[k];
    if (way[k] > 0 ? ++at[k] == size_[k] : at[k]-- == 0) return;
  }
}

void SeenSpace::smooth(const Context& context) {
  bits_.assign((seen_.size() + 7) / 8, 0);
  for (std::size_t c = 0; c < seen_.size(); ++c) {
    if (seen_[c] != 0) bits_[c / 8] |= static_cast<std::uint8_t>(1U << c % 8);
  }
  const std::size_t strides[3] = {1, size_[0], size_[0] * size_[1]};
  std::vector<std::uint8_t> before;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    before = seen_;
    parallel_for(size_[2], 1, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        for (std::size_t j = 0; j < size_[1]; ++j) {
          for (std::size_t i = 0; i < size_[0]; ++i) {
            const std::size_t place[3] = {i, j, k};
            const std::size_t c = cell(i, j, k);
            const int low = place[axis] > 0 ? before[c - strides[axis]] : before[c];
            const int high = place[axis] + 1 < size_[axis] ? before[c + strides[axis]] : before[c];
            seen_[c] = static_cast<std::uint8_t>(low + 2 * before[c] + high);
          }
        }
      }
    });
  }
}

double SeenSpace::emptiness(const Vec3& x) const {
  const Vec3 p = (x - origin_) / edge_ - Vec3{0.5, 0.5, 0.5};  // from the first cube's centre
  const double places[3] = {p.x, p.y, p.z};
  std::size_t at[3];
  double part[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double most = static_cast<double>(size_[k]) - 1;
    const double here = std::clamp(places[k], 0.0, most);
    at[k] = static_cast<std::size_t>(std::min(here, most - 1));
    part[k] = here - static_cast<double>(at[k]);
  }
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t of[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t up = (corner >> k) & 1;
      of[k] = at[k] + up;
      weight *= up == 1 ? part[k] : 1 - part[k];
    }
    sum += weight * seen_[cell(of[0], of[1], of[2])];
  }
  return sum / kAll;
}

}  // namespace rholm
