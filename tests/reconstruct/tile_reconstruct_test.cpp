#include "rholm/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "io/spill/folder_store.h"
#include "parts/threads.h"
#include "reconstruct/points/point_source.h"
#include "reconstruct/points/point_survey.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/tile_run.h"
#include "reconstruct/torus_in_tiles.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/reconstruct_checks.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using namespace testing;

class TileReconstruct : public TileFiles {};

TEST_F(TileReconstruct, is_as_good_as_one_piece) {
  const PointCloud cloud = torus_points(9000);
  const ReconstructReport report = run(cloud, 3000, "tiles.ply");
  const Mesh tiles = mesh("tiles.ply");
  const Inspection found = test::expect_closed_manifold(tiles);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1);
  EXPECT_FALSE(found.inside_out);
  const Reconstruction one = reconstruct(cloud);
  EXPECT_NEAR(report.area, one.report.area, 1e-4 * report.area);
  EXPECT_NEAR(report.volume, one.report.volume, 1e-4 * report.volume);
  EXPECT_NEAR(report.points_area, one.report.points_area, 0.05 * report.points_area);
  EXPECT_NEAR(report.step, one.report.step, 0.03 * one.report.step);
  EXPECT_EQ(report.faces, tiles.faces.size());
  EXPECT_LT(rms_of(tiles), 1.05 * rms_of(one.mesh));
  // Compares normals with the true normals.
  double worst = 1;
  for (std::size_t v = 0; v < tiles.vertices.size(); ++v) {
    const Vec3& p = tiles.vertices[v];
    const double around = std::hypot(p.x, p.y);
    const Vec3 truth = normalized(p - Vec3{kRing * p.x / around, kRing * p.y / around, 0});
    const Vec3 normal{tiles.attributes[0].values[v], tiles.attributes[1].values[v],
                      tiles.attributes[2].values[v]};
    worst = std::min(worst, dot(truth, normal));
  }
  EXPECT_GT(worst, 0.99);
}

double distance_to_faces(const Bounds& cell, const Vec3& x) {
  const double to[] = {x.x - cell.min.x, cell.max.x - x.x, x.y - cell.min.y,
                       cell.max.y - x.y, x.z - cell.min.z, cell.max.z - x.z};
  double least = to[0];
  for (const double d : to) least = std::min(least, std::abs(d));
  return least;
}

// Errors within three cubes of a face between tiles equal errors elsewhere: over all vertices, and
// over the worst thousandth.
TEST_F(TileReconstruct, has_no_seam_at_faces_of_tiles_nightly) {
  constexpr std::uint64_t kPerTile = 4000;
  const PointCloud cloud = torus_points(100000);
  const ReconstructReport report = run(cloud, kPerTile, "tiles.ply");
  const Survey found = survey(*points_in_memory(cloud), {.points_per_tile = kPerTile});
  const TilePlan plan = make_plan(found, kPerTile);
  std::vector<double> near, away;
  for (const Vec3& v : mesh("tiles.ply").vertices) {
    const Bounds& cell = plan.cell(plan.tile_of(v));
    (distance_to_faces(cell, v) < 3 * report.step ? near : away)
        .push_back(std::abs(distance_to_torus(v)));
  }
  ASSERT_GT(near.size(), 20000U);
  ASSERT_GT(away.size(), 20000U);
  const auto rms = [](const std::vector<double>& all) {
    double sum = 0;
    for (const double e : all) sum += e * e;
    return std::sqrt(sum / static_cast<double>(all.size()));
  };
  const auto worst = [](std::vector<double>& all) {
    const auto at = all.end() - static_cast<std::ptrdiff_t>(all.size() / 1000);
    std::nth_element(all.begin(), at, all.end());
    return *at;
  };
  EXPECT_LT(rms(near), 1.05 * rms(away));
  EXPECT_LT(worst(near), 1.05 * worst(away));
}

TEST_F(TileReconstruct, finds_normals_as_one_piece_does_nightly) {
  PointCloud cloud = torus_points(30000);
  cloud.normals.clear();
  const ReconstructReport report = run(cloud, 5000, "tiles.ply", {}, 1);
  const Mesh tiles = mesh("tiles.ply");
  const Inspection found = test::expect_closed_manifold(tiles);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1);
  EXPECT_FALSE(found.inside_out);
  EXPECT_TRUE(report.computed_normals);
  EXPECT_FALSE(report.turned_normals);
  const Reconstruction one = reconstruct(cloud);
  EXPECT_EQ(report.unsure, one.report.unsure);
  EXPECT_NEAR(report.area, one.report.area, 1e-3 * report.area);
  EXPECT_NEAR(report.volume, one.report.volume, 1e-3 * report.volume);
  EXPECT_LT(rms_of(tiles), 1.05 * rms_of(one.mesh));
  std::reverse(cloud.points.begin(), cloud.points.end());
  run(cloud, 5000, "other.ply", {}, 3);
  EXPECT_TRUE(bytes("tiles.ply") == bytes("other.ply"));
}

TEST_F(TileReconstruct, removes_outliers_near_the_surface_nightly) {
  const PointCloud cloud = with_outliers(torus_points(30000), 1500);
  const ReconstructReport report = run(cloud, 5000, "tiles.ply");
  const Mesh tiles = mesh("tiles.ply");
  const Inspection found = test::expect_closed_manifold(tiles);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1);
  const Reconstruction one = reconstruct(cloud);
  EXPECT_NEAR(static_cast<double>(report.outliers), static_cast<double>(one.report.outliers), 15);
  // The few that remain are near the surface: they only make dents.
  EXPECT_LT(most_of(tiles), 1.05 * most_of(one.mesh));
  EXPECT_NEAR(report.area, one.report.area, 1e-3 * report.area);
  run(cloud, 5000, "other.ply", {}, 1, "work");
  EXPECT_TRUE(bytes("tiles.ply") == bytes("other.ply"));
}

// Wrong normals are at random points, and in a patch that crosses several tiles.
TEST_F(TileReconstruct, mends_normals_as_one_piece_does_nightly) {
  PointCloud cloud = torus_points(30000);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3& p = cloud.points[i];
    const bool patch = norm(p - Vec3{1, 0, 0}) < 0.7;
    if (patch || random_uniform(5, i) < 0.2) cloud.normals[i] = -cloud.normals[i];
  }
  const ReconstructReport report = run(cloud, 5000, "tiles.ply");
  const Reconstruction one = reconstruct(cloud);
  EXPECT_GT(report.mended_normals, 6000U);
  EXPECT_EQ(report.mended_normals, one.report.mended_normals);
  EXPECT_EQ(report.contradicting_normals, 0U);
  EXPECT_FALSE(report.turned_normals);
  EXPECT_NEAR(report.volume, one.report.volume, 1e-3 * report.volume);
  test::expect_closed_manifold(mesh("tiles.ply"));
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  run(cloud, 5000, "other.ply", {}, 3, "work");
  EXPECT_TRUE(bytes("tiles.ply") == bytes("other.ply"));
}

// No point is far from the surface: only the normals are wrong.
TEST_F(TileReconstruct, removes_points_with_wrong_normals_nightly) {
  PointCloud cloud = torus_points(30000);
  for (std::size_t i = 0; i < cloud.points.size(); i += 25) {
    const auto random = [&](std::size_t k) { return 2 * random_uniform(13, 3 * i + k) - 1; };
    cloud.normals[i] = normalized(Vec3{random(0), random(1), random(2)});
  }
  const ReconstructReport report = run(cloud, 5000, "tiles.ply");
  const Reconstruction one = reconstruct(cloud);
  EXPECT_GT(report.outliers, 800U);
  // Some points are flipped and kept, as in one piece; the others are removed.
  EXPECT_EQ(report.mended_normals, one.report.mended_normals);
  EXPECT_NEAR(static_cast<double>(report.outliers), static_cast<double>(one.report.outliers), 15);
  // The bound, chosen for a torus without noise, is a hundredth of the spacing.
  EXPECT_LT(rms_of(mesh("tiles.ply")), 0.01 * report.spacing);
  EXPECT_LT(rms_of(one.mesh), 0.01 * report.spacing);
}

// A patch with fewer points than are kept away from the surface, in at least two tiles: x = 0 lies
// between tiles.
TEST_F(TileReconstruct, removes_groups_through_tiles_nightly) {
  PointCloud cloud = with_outliers(torus_points(30000), 300);
  std::size_t n = 0;
  for (double x = -0.03; x < 0.031; x += 0.01) {
    for (double y = -0.03; y < 0.031; y += 0.01, ++n) {
      cloud.points.push_back({x, y + 1.0, 0.55});
      cloud.normals.push_back({0, 0, 1});
    }
  }
  ASSERT_EQ(n, 49U);  // a group needs 60 here
  run(cloud, 5000, "tiles.ply", {.min_component = 0});
  const Mesh tiles = mesh("tiles.ply");
  EXPECT_EQ(inspect(tiles).components, 1U);
  for (const Vec3& v : tiles.vertices) EXPECT_LT(std::abs(distance_to_torus(v)), 0.05);
}

// Points without a direction are useless here, as at a place with a single point.
TEST_F(TileReconstruct, drops_points_without_normals_where_others_have_some) {
  PointCloud cloud = torus_points(10000);
  for (std::size_t i = 0; i < 500; ++i) {
    cloud.points.push_back(0.999 * cloud.points[i]);
    cloud.normals.push_back({});
  }
  EXPECT_EQ(run(cloud, 3000, "some.ply").dropped_points, 500U);
  test::expect_closed_manifold(mesh("some.ply"));
}

// The hole crosses several tiles.
TEST_F(TileReconstruct, closes_holes_through_tiles_smoothly_nightly) {
  constexpr double kHole = 0.25;
  const PointCloud cloud = with_hole(torus_points(40000), {1.3, 0.1, 0.2}, kHole);
  const ReconstructReport report = run(cloud, 3000, "closed.ply");
  const Mesh closed = mesh("closed.ply");
  const Inspection found = test::expect_closed_manifold(closed);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1);
  EXPECT_GE(report.smooth_holes, 1U);
  EXPECT_GT(report.closed_area, 0.1);
  double worst = 0;
  for (const Vec3& v : closed.vertices) worst = std::max(worst, std::abs(distance_to_torus(v)));
  // The fill continues the surface around it to a few thousandths of the hole's size.
  EXPECT_LT(worst, 3e-3 * kHole);
  const Reconstruction one = reconstruct(cloud);
  EXPECT_NEAR(report.closed_area, one.report.closed_area, 0.05 * report.closed_area);
}

// A sphere with a gap around an island. Its rims are too far apart for one portion, and closing one
// rim closes the other.
TEST_F(TileReconstruct, closes_gaps_around_islands_whatever_the_portions_nightly) {
  const PointCloud whole = sample_surface(icosphere(6), {.points = 30000, .seed = 2});
  const PointCloud cloud = those_of(whole, [](const Vec3& p) {
    const double angle = std::acos(p.z / norm(p));
    return angle < 0.2 || angle > 1.75;
  });
  const auto run_portions = [&](std::size_t open_blocks, const std::string& name) {
    FolderStore store(path(name + ".work"));
    store.keep(true);
    Threads alone;
    const TileRunOptions wanted{.reconstruct = {.tile_points = 4000, .output = path(name)},
                                .open_blocks = open_blocks};
    const Reconstruction made = run_tiles(*points_in_memory(cloud), store, wanted, alone, {});
    // A second round closes what crossed several portions.
    EXPECT_EQ(store.has("filling-1/0"), open_blocks == 1);
    return made.report;
  };
  const ReconstructReport together = run_portions(100000, "together.ply");
  const ReconstructReport apart = run_portions(1, "apart.ply");
  EXPECT_EQ(apart.holes, together.holes);
  EXPECT_EQ(bytes("apart.ply"), bytes("together.ply"));
  const Inspection found = test::expect_closed_manifold(mesh("apart.ply"));
  const Reconstruction one = reconstruct(cloud);
  EXPECT_EQ(found.components, inspect(one.mesh).components);
  EXPECT_EQ(found.genus, inspect(one.mesh).genus);
  EXPECT_NEAR(together.volume, one.report.volume, 1e-3 * one.report.volume);
  EXPECT_NEAR(together.closed_area, one.report.closed_area, 0.02 * one.report.closed_area);
}

// A ring with a neck thinner than the points resolve, between tiles, within one tile, or in the
// only tile. The neck is cut and a ball is left, as in one piece, also where the surface may be
// open.
TEST_F(TileReconstruct, cuts_handles_as_one_piece_does_nightly) {
  const PointCloud cloud = sample_surface(test::ring_with_neck(0.15), {.points = 4000, .seed = 5});
  const Reconstruction one = reconstruct(cloud);
  ASSERT_EQ(one.report.cut_handles, 1U);
  for (const std::uint64_t per_tile : {1000, 2500, 5000}) {
    for (const HolePolicy holes : {HolePolicy::kFill, HolePolicy::kKeep}) {
      const ReconstructReport report = run(cloud, per_tile, "cut.ply", {.holes = holes});
      EXPECT_EQ(report.cut_handles, 1U);
      const Mesh cut = mesh("cut.ply");
      const Inspection found = inspect(cut);
      EXPECT_EQ(found.components, 1U);
      if (holes == HolePolicy::kFill) {
        EXPECT_EQ(test::expect_closed_manifold(cut).genus, 0);
      }
      EXPECT_NEAR(report.area, one.report.area, 0.01 * one.report.area);
    }
  }
}

TEST_F(TileReconstruct, turns_normals_that_point_inwards) {
  PointCloud cloud = torus_points(10000);
  for (Vec3& normal : cloud.normals) normal = -normal;
  const ReconstructReport report = run(cloud, 2000, "turned.ply");
  EXPECT_TRUE(report.turned_normals);
  EXPECT_GT(report.volume, 0);
}

// Normals exist also in the middle of a hole, which no cap reaches.
TEST_F(TileReconstruct, has_unit_normals_everywhere_nightly) {
  const PointCloud cloud = with_hole(torus_points(20000), {-1.2, 0.3, 0.25}, 0.35);
  run(cloud, 1500, "normals.ply");
  const Mesh closed = mesh("normals.ply");
  std::vector<Vec3> sums(closed.vertices.size());
  for (const Triangle& t : closed.faces) {
    const Vec3& a = closed.vertices[t[0]];
    const Vec3 area = cross(closed.vertices[t[1]] - a, closed.vertices[t[2]] - a);
    for (const std::uint32_t v : t) sums[v] += area;
  }
  for (std::size_t v = 0; v < closed.vertices.size(); ++v) {
    const Vec3 normal{closed.attributes[0].values[v], closed.attributes[1].values[v],
                      closed.attributes[2].values[v]};
    ASSERT_NEAR(norm(normal), 1, 1e-6);
    ASSERT_GT(dot(normal, normalized(sums[v])), 0.9);
  }
}

}  // namespace
}  // namespace rholm
