// Surfaces of scans that are misaligned by rigid motions, with positions of the scanners. Oracles
// are bodies in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "rholm/compare.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"
#include "support/reconstruct_checks.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::expect_closed_manifold;
using test::sphere_points;

TEST(Reconstruct, scans_that_are_off_make_one_sheet_nightly) {
  // The misalignment is three spacings rms: unaligned, thousands of caps contain two sheets each.
  const Mesh body = bumpy_sphere(5);
  const PointCloud scans =
      sample_surface(body, {.points = 30000, .scans = 8, .misalignment = 0.02, .normals = false});
  const Reconstruction made = reconstruct(scans), left = reconstruct(scans, {.keep_scans = true});
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  EXPECT_EQ(made.report.scans.scans, 8U);
  EXPECT_EQ(left.report.scans.scans, 0U);
  // The mean of all motions stays, about a third of each motion.
  const double diagonal = bounds(body.vertices).diagonal();
  EXPECT_LT(compare(made.mesh, body, {.samples = 20000}).a_to_b.rms, 0.5 * 0.02 * diagonal);
  EXPECT_EQ(made.report.noise, 0);
  EXPECT_GT(left.report.noise, 0.1 * 0.02 * diagonal);
}

TEST(Reconstruct, what_has_been_seen_to_be_empty_is_not_closed) {
  const double whole = 8, bore = std::numbers::pi * 0.16 * 1.5;
  const Reconstruction blind = reconstruct(test::bored_box(false));
  // The bottom of the bore becomes a closed bubble, and the bore is filled.
  EXPECT_EQ(expect_closed_manifold(blind.mesh).euler_characteristic, 4);
  EXPECT_GT(blind.report.volume, whole - 0.4 * bore);
  const Reconstruction made = reconstruct(test::bored_box(true));
  EXPECT_EQ(expect_closed_manifold(made.mesh).euler_characteristic, 2);
  // The radius is smaller by at most two spacings of 0.03.
  EXPECT_NEAR(made.report.volume, whole - bore, 0.3 * bore);
  const double radius = 0.4, spacing = made.report.spacing;
  for (const Vec3& v : made.mesh.vertices) {
    if (std::abs(v.z - 0.25) > 0.5 || std::hypot(v.x, v.y) > 0.7) continue;
    // The cubes are two spacings wide, with a transition over two more spacings.
    EXPECT_NEAR(std::hypot(v.x, v.y), radius, 4 * spacing);
  }
}

TEST(Reconstruct, one_sensor_decides_all_signs) {
  // The front of a ball as seen from far away: by itself it could be a bowl.
  PointCloud front = sphere_points(6000);
  std::vector<Vec3> seen;
  for (const Vec3& p : front.points) {
    if (p.z > 0.5) seen.push_back(p);
  }
  for (const double z : {50.0, -50.0}) {
    const Reconstruction made = reconstruct({.points = seen, .normals = {}, .attributes = {}},
                                            {.holes = HolePolicy::kKeep, .sensor = Vec3{0, 0, z}});
    for (std::size_t i = 0; i < made.mesh.vertices.size(); ++i) {
      EXPECT_GT(find_attribute(made.mesh.attributes, "nz")->values[i] * z, 0);
    }
    EXPECT_EQ(find_attribute(made.mesh.attributes, "sensor_x"), nullptr);
  }
}

}  // namespace
}  // namespace rholm
