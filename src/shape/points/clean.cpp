#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

void check_sizes(const PointCloud& cloud) {
  const auto check = [&](std::size_t n, const std::string& what) {
    if (n == cloud.points.size()) return;
    throw Error(ErrorCode::kInvalidInput, "there are " + std::to_string(n) + " " + what + " for " +
                                              std::to_string(cloud.points.size()) +
                                              " points; give one for each");
  };
  if (!cloud.normals.empty()) check(cloud.normals.size(), "normals");
  for (const Attribute& a : cloud.attributes) check(a.values.size(), "values of '" + a.name + "'");
}

// Keeps the points that are marked, in their order.
void keep_only(const std::vector<char>& kept, PointCloud& cloud) {
  const auto squeeze = [&](auto& values) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (kept[i]) values[n++] = values[i];
    }
    values.resize(n);
  };
  squeeze(cloud.points);
  squeeze(cloud.normals);
  for (Attribute& a : cloud.attributes) squeeze(a.values);
}

// Scaled first: normals in a file have any length.
Vec3 unit_or_zero(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !is_finite(v)) return {};
  return normalized({v.x / largest, v.y / largest, v.z / largest});
}

// Distances between neighbours are those of single precision (point_tree.h): what is closer than
// this part of the extent is at one place.
constexpr double kPlace = 0x1p-23;

// The first point in the same cell of that size. Of two that are closer, but in two cells, both
// stay.
std::vector<std::uint32_t> first_in_place(const std::vector<Vec3>& points, const Context& context) {
  const Bounds box = bounds(points);
  const double per_length = 1 / (kPlace * box.diagonal());
  if (!std::isnormal(per_length)) return first_identical(points, context);
  std::vector<Vec3> places(points.size());
  parallel_for(points.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 cell = per_length * (points[i] - box.min);
      places[i] = {std::floor(cell.x), std::floor(cell.y), std::floor(cell.z)};
    }
  });
  return first_identical(places, context);
}

// Adds the normals of duplicates to those of the points that stay.
std::size_t merge_normals(const std::vector<std::uint32_t>& first, std::vector<Vec3>& normals) {
  std::vector<Vec3> sums(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) sums[i] = unit_or_zero(normals[i]);
  std::size_t opposite = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (first[i] == i) continue;
    Vec3& sum = sums[first[i]];
    const Vec3 own = unit_or_zero(normals[i]);
    if (dot(own, sum) < 0) {
      ++opposite;
    } else {
      sum += own;
    }
    normals[first[i]] = normalized(sum);
  }
  return opposite;
}

}  // namespace

CleanReport clean(PointCloud& cloud, const Context& context) {
  check_sizes(cloud);
  CleanReport report{.points = cloud.points.size()};
  std::vector<char> kept(cloud.points.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = is_finite(cloud.points[i]);
  report.not_finite = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 0));
  if (report.not_finite > 0) keep_only(kept, cloud);
  for (Vec3& normal : cloud.normals) {
    if (!is_finite(normal)) normal = {};
  }
  const std::vector<std::uint32_t> first = first_in_place(cloud.points, context);
  kept.resize(first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    kept[i] = first[i] == i;
    report.duplicates += first[i] != i;
  }
  if (report.duplicates > 0) {
    if (!cloud.normals.empty()) report.opposite_normals = merge_normals(first, cloud.normals);
    keep_only(kept, cloud);
  }
  report.zero_normals =
      static_cast<std::size_t>(std::count(cloud.normals.begin(), cloud.normals.end(), Vec3{}));
  return report;
}

}  // namespace rholm
