#include "shape/points/wall_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "rholm/topology.h"
#include "shape/normal_attributes.h"
#include "shape/points/point_rank.h"

namespace rholm {
namespace {

// Approximate number of chosen points (chosen: the share is then exact to 0.035).
constexpr double kChosen = 200;
// Least distance of walls in scatters. Points that fill a plate of thickness T evenly have a
// scatter of sqrt(T^2 / 48 + (d - T / 4)^2) about walls 2 d apart. Such walls are at most 4.0
// scatters apart, for d = T / 3. Surfaces follow their points a little: filled slabs and rods have
// 4 to 5.5 scatters. A plate four deviations of Gaussian noise thick has them too, a plate of five
// has more (tests/cli/clouds_test.py --walls).
constexpr double kResolved = 5.5;
// Limits for points that fill a shell or volume. kMostKurtosis: mean fourth power of a patch's
// distances over their squared mean square. A filled shell has 1.8; Gaussian noise with 32 points
// has 2.8, uneven noise more (--walls). kLeastScatter: least scatter in spacings (chosen), as
// points at middles of voxels along a surface have up to 0.5.
constexpr double kMostKurtosis = 2.3, kLeastScatter = 0.5;
// Every kFirstLook-th patch is tested first; a share below kFewOff ends the check. If half of all
// patches are off, a third of 200 shows less than a fifth once in a million times.
constexpr std::size_t kFirstLook = 3;
constexpr double kFewOff = 0.2;
// Distance in which vertices are sought: kReach radii of a patch and kStepsOfReach steps. A flat
// patch has a scatter of at most 0.2 of its radius.
constexpr double kReach = 2, kStepsOfReach = 2;
constexpr double kOpposite = -0.3;  // cosine of the normals of two walls (chosen)

double reach_of(std::span<const Vec3> patch, double step) {
  double radius = 0;
  for (const Vec3& point : patch) radius = std::max(radius, norm(point - patch.front()));
  return kReach * radius + kStepsOfReach * step;
}

// Marks the cubes of a coarse grid that are within reach of patches.
class ReachGrid {
 public:
  ReachGrid(const WallPatches& patches, double step) {
    const std::size_t n = patches.size();
    std::vector<double> reach(n);
    std::vector<Vec3> middles(n);
    for (std::size_t p = 0; p < n; ++p) {
      reach[p] = reach_of(patches[p], step), middles[p] = patches[p].front();
    }
    const double most = *std::max_element(reach.begin(), reach.end());
    const Bounds box = bounds(middles);
    const Vec3 size = box.max - box.min + Vec3{2 * most, 2 * most, 2 * most};
    origin_ = box.min - Vec3{most, most, most};
    edge_ = std::max(std::max({size.x, size.y, size.z}) / kCubes, most / kCubesOfReach);
    const auto cubes = [&](double length) {
      return static_cast<std::int64_t>(std::ceil(length / edge_)) + 1;
    };
    n_ = {cubes(size.x), cubes(size.y), cubes(size.z)};
    near_.assign(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]), 0);
    for (std::size_t p = 0; p < n; ++p) mark(middles[p], reach[p]);
  }

  bool is_near(const Vec3& place) const {
    const auto [x, y, z] = cube_of(place);
    if (x < 0 || y < 0 || z < 0 || x >= n_[0] || y >= n_[1] || z >= n_[2]) return false;
    return near_[index(x, y, z)] != 0;
  }

 private:
  // Largest number of cubes along the longest side, and in the longest reach (both
  // chosen for time and memory).
  static constexpr double kCubes = 128, kCubesOfReach = 4;

  std::array<std::int64_t, 3> cube_of(const Vec3& place) const {
    const Vec3 at = (place - origin_) / edge_;
    // Coordinates of far places exceed every integer, so they are clamped.
    const auto whole = [](double x) {
      return static_cast<std::int64_t>(std::floor(std::clamp(x, -1.0, 1e6)));
    };
    return {whole(at.x), whole(at.y), whole(at.z)};
  }
  std::size_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return static_cast<std::size_t>((z * n_[1] + y) * n_[0] + x);
  }
  void mark(const Vec3& middle, double reach) {
    const auto low = cube_of(middle - Vec3{reach, reach, reach});
    const auto high = cube_of(middle + Vec3{reach, reach, reach});
    for (std::int64_t z = low[2]; z <= std::min(high[2], n_[2] - 1); ++z) {
      for (std::int64_t y = low[1]; y <= std::min(high[1], n_[1] - 1); ++y) {
        for (std::int64_t x = low[0]; x <= std::min(high[0], n_[0] - 1); ++x) {
          near_[index(x, y, z)] = 1;
        }
      }
    }
  }

  Vec3 origin_;
  double edge_ = 0;
  std::array<std::int64_t, 3> n_ = {};
  std::vector<std::uint8_t> near_;
};

struct PatchCheck {
  bool resolved = false;
  double scatter = 0, kurtosis = 3;
};

// The vertices of the surface, in a tree.
class Wall {
 public:
  Wall(std::span<const WallVertex> vertices, const Context& context)
      : tree_(places_of(vertices), context), vertices_(vertices) {}

  // Checks one patch; it stays unresolved if a point has no wall within reach.
  PatchCheck look(std::span<const Vec3> patch, double step, std::vector<Neighbor>& near) const {
    const double reach = reach_of(patch, step);
    PatchCheck check;
    double squares = 0, fourth = 0;
    const WallVertex* own = nullptr;
    for (const Vec3& point : patch) {
      Neighbor nearest;
      if (!tree_.nearest_within(point, reach, nearest)) return check;
      const WallVertex& vertex = at(nearest);
      if (own == nullptr) own = &vertex;
      const double height = dot(point - vertex.at, vertex.normal);
      squares += height * height, fourth += height * height * height * height;
    }
    const auto n = static_cast<double>(patch.size());
    check.scatter = std::sqrt(squares / n);
    if (squares > 0) check.kurtosis = fourth * n / (squares * squares);
    tree_.within(own->at, kResolved * check.scatter, near);
    check.resolved = std::none_of(near.begin(), near.end(), [&](const Neighbor& other) {
      const WallVertex& vertex = at(other);
      return dot(vertex.normal, own->normal) < kOpposite &&
             dot(vertex.at - own->at, own->normal) < 0;
    });
    return check;
  }

 private:
  static std::vector<Vec3> places_of(std::span<const WallVertex> vertices) {
    std::vector<Vec3> places;
    places.reserve(vertices.size());
    for (const WallVertex& vertex : vertices) places.push_back(vertex.at);
    return places;
  }
  const WallVertex& at(const Neighbor& neighbor) const {
    return vertices_[tree_.order()[neighbor.index]];
  }

  PointTree tree_;
  std::span<const WallVertex> vertices_;
};

}  // namespace

WallPatches choose_patches(const PointTree& tree, std::span<const Vec3> points,
                           std::span<const std::uint8_t> foreign, std::size_t n, std::size_t around,
                           const Context& context) {
  const double share = kChosen / static_cast<double>(n);
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!foreign.empty() && foreign[i] != 0) continue;
    if (is_chosen(rank_of(points[i]), share)) chosen.push_back(i);
  }
  const std::size_t taken = std::max(around, kPatch);
  WallPatches patches{std::vector<Vec3>(chosen.size() * kPatch),
                      std::vector<double>(chosen.size())};
  parallel_for(chosen.size(), 8, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t p = begin; p < end; ++p) {
      tree.nearest_to(chosen[p], taken, near);
      // If there are fewer points than a patch needs, some are taken twice.
      for (std::size_t k = 0; k < kPatch; ++k) {
        patches.points[p * kPatch + k] = points[near[k * near.size() / kPatch].index];
      }
      patches.areas[p] =
          std::numbers::pi * near.back().distance2 / static_cast<double>(near.size());
    }
  });
  return patches;
}

std::vector<WallVertex> vertices_near(const WallPatches& patches, double step, Mesh& mesh,
                                      std::size_t n) {
  std::vector<WallVertex> found;
  if (patches.size() == 0) return found;
  const ReachGrid grid(patches, step);
  const NormalAttributes normals = normal_attributes(mesh);
  for (std::size_t v = 0; v < n; ++v) {
    if (grid.is_near(mesh.vertices[v])) found.push_back({mesh.vertices[v], normals[v]});
  }
  return found;
}

WallCheck check_walls(const WallPatches& patches, std::span<const WallVertex> vertices, double step,
                      const Context& context) {
  const std::size_t n = patches.size();
  WallCheck check{.patches = n};
  std::vector<PatchCheck> found(n);
  if (!vertices.empty()) {
    const Wall wall(vertices, context);
    parallel_for(n, 8, context, {}, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> near;
      for (std::size_t p = begin; p < end; ++p) found[p] = wall.look(patches[p], step, near);
    });
  }
  double kurtosis = 0;
  for (const PatchCheck& one : found) kurtosis += one.kurtosis / static_cast<double>(n);
  std::vector<Vec3> places;
  places.reserve(n);
  for (std::size_t p = 0; p < n; ++p) {
    const bool far = found[p].scatter > kLeastScatter * std::sqrt(patches.areas[p]);
    const bool off = !found[p].resolved || (far && kurtosis < kMostKurtosis);
    if (off) places.push_back(patches[p].front());
  }
  check.off = places.size();
  std::sort(places.begin(), places.end(),
            [](const Vec3& a, const Vec3& b) { return rank_of(a) < rank_of(b); });
  std::copy_n(places.begin(), std::min(places.size(), kNamedWalls), check.at.begin());
  return check;
}

WallPatches WallPatches::every(std::size_t k) const {
  WallPatches some;
  some.areas.reserve(size() / k + 1), some.points.reserve((size() / k + 1) * kPatch);
  for (std::size_t p = 0; p < size(); p += k) {
    some.areas.push_back(areas[p]);
    some.points.insert(some.points.end(), (*this)[p].begin(), (*this)[p].end());
  }
  return some;
}

WallCheck check_walls(const WallPatches& patches, Mesh& mesh, double step, const Context& context) {
  WallCheck check;
  for (const std::size_t k : {kFirstLook, std::size_t{1}}) {
    const WallPatches some = patches.every(k);
    const std::vector<WallVertex> near = vertices_near(some, step, mesh, mesh.vertices.size());
    check = check_walls(some, near, step, context);
    if (check.share() < kFewOff) break;
  }
  return check;
}

}  // namespace rholm
