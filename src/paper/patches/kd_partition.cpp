#include "paper/patches/kd_partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/parallel.h"
#include "base/refuse.h"
#include "shape/face.h"

namespace rholm {
namespace {

void check(std::span<const Vec3> points, std::span<const Vec3> normals,
           const PartitionOptions& options) {
  if (!(options.min_cosine >= 0 && options.min_cosine <= 1)) {
    refuse("the cosine of the normal cone is " + std::to_string(options.min_cosine) +
           "; it must be 0 ... 1");
  }
  if (!(options.star >= 0 && options.star <= 1)) {
    refuse("the least cosine between normals and rays is " + std::to_string(options.star) +
           "; it must be 0 ... 1");
  }
  if (options.min_points < 1) refuse("patches of 0 points are asked for; give at least 1");
  if (points.size() > std::numeric_limits<std::uint32_t>::max()) {
    refuse("there are " + std::to_string(points.size()) + " points; at most 2^32 - 1 are allowed");
  }
  if (normals.size() != points.size()) {
    refuse("there are " + std::to_string(points.size()) + " points and " +
           std::to_string(normals.size()) + " normals; give one for each");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) refuse("point " + std::to_string(i) + " is not finite; drop it");
    if (!is_finite(normals[i]) || normals[i] == Vec3{}) {
      refuse("the normal of point " + std::to_string(i) +
             " is zero or not finite; compute it first");
    }
  }
}

Bounds bounds_of(std::span<const Vec3> points) {
  Bounds box{.min = points.front(), .max = points.front()};
  for (const Vec3& p : points) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  return box;
}

// Without scaling, squares of very large or small components may be 0 or infinite.
Vec3 unit(const Vec3& a) {
  return normalized(a / std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}));
}

double along(const Vec3& p, std::size_t axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// Points and normals in the order of the partition, in the unit frame.
struct Sorted {
  struct Item {
    Vec3 point, normal;
    std::uint32_t index;
  };
  std::vector<Item> items;
};

struct Cell {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t size() const { return end - begin; }
};

// The result for one cell; items of a split cell are divided at the median.
struct Verdict {
  KdPatch patch;
  bool is_split = false;
};

void part(std::span<Sorted::Item> items, std::size_t axis) {
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
  std::nth_element(items.begin(), middle, items.end(),
                   [axis](const Sorted::Item& a, const Sorted::Item& b) {
                     const double x = along(a.point, axis), y = along(b.point, axis);
                     return x != y ? x < y : a.index < b.index;
                   });
}

std::size_t longest_axis(const Bounds& box) {
  const Vec3 extent = box.max - box.min;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

Verdict judge(std::span<Sorted::Item> items, const Cell& cell, const PartitionOptions& options) {
  std::vector<Vec3> points, normals;
  points.reserve(items.size());
  normals.reserve(items.size());
  for (const Sorted::Item& item : items) {
    points.push_back(item.point);
    normals.push_back(item.normal);
  }
  Verdict verdict;
  KdPatch& patch = verdict.patch;
  patch.begin = cell.begin;
  patch.end = cell.end;
  const Vec3 mean = mean_normal(normals);
  for (const Vec3& n : normals) patch.normal_cosine = std::min(patch.normal_cosine, dot(n, mean));
  const bool is_leaf = items.size() < 2 * options.min_points;
  const bool in_cone = patch.normal_cosine > options.min_cosine;
  if (in_cone || is_leaf) {
    patch.seen = patch_sphere({points, normals}, options.star);
    patch.holds = in_cone && patch.seen.star_cosine > options.star;
  }
  verdict.is_split = !patch.holds && !is_leaf;
  if (verdict.is_split) part(items, longest_axis(bounds_of(points)));
  return verdict;
}

Sorted sorted_points(std::span<const Vec3> points, std::span<const Vec3> normals,
                     const UnitFrame& frame) {
  Sorted sorted;
  sorted.items.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted.items.push_back(
        {frame.to_local(points[i]), unit(normals[i]), static_cast<std::uint32_t>(i)});
  }
  return sorted;
}

}  // namespace

KdPartition kd_partition(std::span<const Vec3> points, std::span<const Vec3> normals,
                         const PartitionOptions& options, const Context& context) {
  check(points, normals, options);
  KdPartition result;
  if (points.empty()) return result;
  const UnitFrame frame = unit_frame(bounds_of(points));
  Sorted sorted = sorted_points(points, normals, frame);

  // Works level by level: the cells of one level share no items.
  std::vector<Cell> open = {{0, static_cast<std::uint32_t>(points.size())}};
  while (!open.empty()) {
    std::vector<Verdict> verdicts(open.size());
    parallel_for(open.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto items = std::span(sorted.items).subspan(open[i].begin, open[i].size());
        verdicts[i] = judge(items, open[i], options);
      }
    });
    std::vector<Cell> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (verdicts[i].is_split) {
        const std::uint32_t middle = open[i].begin + open[i].size() / 2;
        next.push_back({open[i].begin, middle});
        next.push_back({middle, open[i].end});
      } else {
        result.patches.push_back(verdicts[i].patch);
      }
    }
    open = std::move(next);
  }
  std::sort(result.patches.begin(), result.patches.end(),
            [](const KdPatch& a, const KdPatch& b) { return a.begin < b.begin; });
  for (KdPatch& patch : result.patches) {
    Sphere& sphere = patch.seen.sphere;
    sphere.center = frame.to_shape(sphere.center);
    sphere.radius /= frame.scale;
    result.n_failed += !patch.holds;
  }
  for (const Sorted::Item& item : sorted.items) result.order.push_back(item.index);
  return result;
}

}  // namespace rholm
