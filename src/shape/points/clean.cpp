#include <algorithm>
#include <string>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/points/place_lattice.h"

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

// Keeps the marked points, in their order.
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
  const PlaceLattice lattice(bounds(cloud.points));
  const std::vector<std::uint32_t> first = first_in_place(cloud.points, lattice, context);
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
