// Thin bodies whose two sheets have normals: plates and boxes a few spacings thick. Oracles are
// distances in closed form and exact counts of parts and handles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "rholm/compare.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"
#include "support/reconstruct_checks.h"
#include "support/sizes.h"

namespace rholm {
namespace {

using test::expect_closed_manifold;

constexpr std::size_t kPoints = 30000;
// Spacing of points on both sides of a rectangle of 2 x 1, as if they formed a square grid.
const double kSpacing = std::sqrt(4.0 / kPoints);

// All points within t / 2 of the rectangle |x| < a, |y| < b in the plane z = 0.
struct RoundPlate {
  double thickness, a = 1 - thickness / 2, b = 0.5 - thickness / 2;

  double distance(const Vec3& p) const {
    const Vec3 q{std::max(0.0, std::abs(p.x) - a), std::max(0.0, std::abs(p.y) - b), p.z};
    return std::abs(norm(q) - thickness / 2);
  }

  Mesh mesh() const {
    Mesh mesh = icosphere(6);
    for (Vec3& v : mesh.vertices) {
      v = thickness / 2 * v + Vec3{std::copysign(a, v.x), std::copysign(b, v.y), 0};
    }
    return mesh;
  }
};

double farthest(const Mesh& mesh, const RoundPlate& plate) {
  double most = 0;
  for (const Vec3& v : mesh.vertices) most = std::max(most, plate.distance(v));
  return most;
}

TEST_OF_TWO_SIZES(ReconstructThin, a_plate_of_two_spacings_has_no_islands_beside_its_rim) {
  for (const std::uint64_t seed : nightly ? std::vector{1U, 3U, 4U} : std::vector{3U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RoundPlate plate{2 * kSpacing};
    const Reconstruction made =
        reconstruct(sample_surface(plate.mesh(), {.points = kPoints, .seed = seed}));
    const Inspection found = expect_closed_manifold(made.mesh);
    EXPECT_EQ(made.report.dropped_components, 0U);
    EXPECT_EQ(found.components, 1U);
    EXPECT_EQ(found.euler_characteristic, 2);
    EXPECT_LT(farthest(made.mesh, plate), kSpacing);
  }
}

TEST(ReconstructThin, a_plate_of_one_spacing_is_near_its_points_everywhere) {
  const RoundPlate plate{kSpacing};
  const Reconstruction made =
      reconstruct(sample_surface(plate.mesh(), {.points = kPoints, .seed = 4}));
  const Inspection found = expect_closed_manifold(made.mesh);
  EXPECT_EQ(found.components, 1U);
  EXPECT_LT(farthest(made.mesh, plate), 1.5 * kSpacing);
}

TEST(ReconstructThin, a_sharp_rim_of_one_spacing_makes_no_fins) {
  const Mesh truth = box({2, 1, kSpacing});
  const Reconstruction made = reconstruct(sample_surface(truth, {.points = kPoints, .seed = 4}));
  EXPECT_EQ(expect_closed_manifold(made.mesh).components, 1U);
  const std::vector<double> off = distances_to_surface(made.mesh.vertices, truth);
  const auto wrong = std::count_if(off.begin(), off.end(), [](double d) { return d > kSpacing; });
  EXPECT_LT(static_cast<double>(wrong), 0.01 * static_cast<double>(off.size()));
  EXPECT_LT(*std::max_element(off.begin(), off.end()), 2 * kSpacing);
}

}  // namespace
}  // namespace rholm
