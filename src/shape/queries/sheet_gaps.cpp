#include "shape/queries/sheet_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "rholm/topology.h"
#include "shape/face.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 256;  // points: some hundred microseconds
// Rays start this part of the diagonal before their point: ten times the error of their
// position in single precision.
constexpr double kBack = 1e-6;
// Number of rays that vote on a point's winding number: a ray through an edge may count it twice.
constexpr std::uint64_t kVotes = 3;

// Returns the unit normal, or zero for a triangle without area.
Vec3 normal_of(const Mesh& mesh, std::uint32_t triangle) {
  return normalized(face_normal(scaled_corners(mesh, mesh.faces[triangle], 1)).twice_area);
}

template <class Visit>
void for_each_point(const PointsOnMesh& on, const Context& context, const Visit& visit) {
  parallel_for(on.points.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) visit(i, normal_of(on.mesh, on.faces[i]));
  });
}

}  // namespace

std::vector<double> sheet_gaps(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context) {
  const double back = kBack * bounds(on.mesh.vertices).diagonal();
  std::vector<double> gaps(on.points.size(), std::numeric_limits<double>::infinity());
  for_each_point(on, context, [&](std::size_t i, const Vec3& normal) {
    if (!(norm(normal) > 0)) return;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 ahead = side * normal;
      for (const RayCrossing& met : scene.crossings(on.points[i] - back * ahead, ahead)) {
        if (met.triangle == on.faces[i]) continue;
        if (!(dot(normal_of(on.mesh, met.triangle), normal) < 0)) continue;
        gaps[i] = std::min(gaps[i], std::abs(met.distance - back));
        break;
      }
    }
  });
  return gaps;
}

std::vector<int> outer_winding(const PointsOnMesh& on, const RayScene& scene,
                               const Context& context) {
  const double back = kBack * bounds(on.mesh.vertices).diagonal();
  std::vector<int> winding(on.points.size(), 0);
  for_each_point(on, context, [&](std::size_t i, const Vec3& normal) {
    if (!(norm(normal) > 0)) return;
    std::array<int, kVotes> votes = {};
    for (std::uint64_t k = 0; k < kVotes; ++k) {
      const auto draw = [&](std::uint64_t n) {
        return 2 * random_uniform(1, 3 * (kVotes * i + k) + n) - 1;
      };
      // The direction is within 60 degrees of the normal, and in no plane that meshes often have.
      const Vec3 ahead = normalized(normal + 0.5 * Vec3{draw(0), draw(1), draw(2)});
      for (const RayCrossing& met : scene.crossings(on.points[i] + back * normal, ahead)) {
        if (met.triangle == on.faces[i]) continue;
        const double out = dot(normal_of(on.mesh, met.triangle), ahead);
        votes[k] += out > 0 ? 1 : out < 0 ? -1 : 0;
      }
    }
    std::sort(votes.begin(), votes.end());
    winding[i] = votes[kVotes / 2];
  });
  return winding;
}

}  // namespace rholm
