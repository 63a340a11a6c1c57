#include "shape/points/orient_scene.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/refuse.h"
#include "rholm/error.h"
#include "shape/on_line.h"
#include "shape/points/isolated_points.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

// Width of a line relative to the extent: ten roundings of the single precision of fits.
constexpr double kLine = 1e-6;
constexpr std::size_t kFewest = 3;  // least number of points with a plane

// Moves the kept input points to the frame of the scene and sorts them by the tree.
void put_in_order(const PointCloud& cloud, const std::vector<std::uint32_t>& kept,
                  OrientScene& scene, const Context& context) {
  std::vector<Vec3> local;
  local.reserve(kept.size());
  for (const std::uint32_t i : kept) local.push_back(scene.frame.to_local(cloud.points[i]));
  // Checks the points first; fits of millions of them would take a minute to find no plane.
  if (lie_on_line(local, kLine)) refuse_line(cloud.points.size());
  scene.tree.emplace(local, context);
  scene.place.resize(kept.size());
  scene.points.resize(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    scene.place[i] = kept[scene.tree->order()[i]];
    scene.points[i] = local[scene.tree->order()[i]];
  }
  scene.gaps = find_gaps(*scene.tree, scene.points, {}, context);
}

// Returns the bounding box of the points that are not isolated.
Bounds bounds_of_kept(const PointCloud& cloud, const std::vector<std::uint8_t>& isolated) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < isolated.size(); ++i) {
    if (isolated[i] == 0) kept.push_back(cloud.points[i]);
  }
  return bounds(kept);
}

void find_taken(const PointCloud& cloud, const std::vector<std::uint32_t>& first,
                OrientScene& scene) {
  scene.taken.resize(first.size());
  for (std::uint32_t i = 0; i < scene.place.size(); ++i) scene.taken[scene.place[i]] = i;
  std::vector<Neighbor> near;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    scene.duplicates += first[i] != i;
    if (first[i] != i) {
      scene.taken[i] = scene.taken[first[i]];
    } else if (scene.isolated[i] != 0) {
      scene.tree->nearest(scene.frame.to_local(cloud.points[i]), 1, near);
      scene.taken[i] = near[0].index;
    }
  }
}

}  // namespace

void refuse_line(std::size_t n_points) {
  refuse("all " + std::to_string(n_points) +
         " points lie on one line, where there are no normals; give points of a surface");
}

OrientScene make_orient_scene(const PointCloud& cloud, bool leave_out_isolated,
                              const Context& context) {
  const std::vector<std::uint32_t> first = first_identical(cloud.points);
  OrientScene scene;
  scene.isolated.assign(first.size(), 0);
  if (leave_out_isolated) scene.isolated = find_far_isolated_points(cloud.points);
  scene.frame = unit_frame(bounds_of_kept(cloud, scene.isolated));
  const auto kept = [&] {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      if (first[i] == i && scene.isolated[i] == 0) result.push_back(i);
    }
    return result;
  };
  const std::vector<std::uint32_t> distinct = kept();
  if (distinct.size() < kFewest) {
    throw Error(ErrorCode::kInvalidInput,
                std::to_string(cloud.points.size()) + " points at " +
                    std::to_string(distinct.size()) +
                    " different places have no plane; at least 3 places are needed");
  }
  put_in_order(cloud, distinct, scene, context);
  for (int pass = 0; leave_out_isolated && pass < kIsolatedPasses; ++pass) {
    const auto flags = find_isolated_points(*scene.tree, scene.points, scene.gaps, context);
    const auto n = static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
    if (n == 0 || flags.size() - n < kFewest) break;
    for (std::size_t i = 0; i < flags.size(); ++i) scene.isolated[scene.place[i]] |= flags[i];
    put_in_order(cloud, kept(), scene, context);
  }
  // Every point at the place of an isolated point is isolated too.
  for (std::uint32_t i = 0; i < first.size(); ++i) scene.isolated[i] = scene.isolated[first[i]];
  find_taken(cloud, first, scene);
  return scene;
}

}  // namespace rholm
