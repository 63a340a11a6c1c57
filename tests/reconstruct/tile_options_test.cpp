#include "rholm/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "reconstruct/torus_in_tiles.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "support/reconstruct_checks.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using namespace testing;

class TileReconstructOptions : public TileFiles {};

// The cloud has two holes, one of which crosses several tiles.
TEST_F(TileReconstructOptions, keeps_holes_open_through_tiles_nightly) {
  const PointCloud cloud =
      with_hole(with_hole(torus_points(20000), {1.3, 0.1, 0.2}, 0.25), {-1, 0.2, -0.4}, 0.15);
  const ReconstructOptions keep{.holes = HolePolicy::kKeep};
  const ReconstructReport report = run(cloud, 3000, "open.ply", keep);
  const Mesh open = mesh("open.ply");
  const Inspection found = inspect(open);
  EXPECT_TRUE(found.manifold);
  EXPECT_TRUE(found.oriented);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.euler_characteristic, -2);  // a torus without two discs
  EXPECT_EQ(report.holes, 2U);
  EXPECT_EQ(report.closed_area, 0);
  const Reconstruction one = reconstruct(cloud, keep);
  EXPECT_NEAR(report.area, one.report.area, 2e-3 * report.area);
  const Inspection in_one = inspect(one.mesh);
  EXPECT_NEAR(static_cast<double>(found.boundary_edges), static_cast<double>(in_one.boundary_edges),
              0.05 * static_cast<double>(in_one.boundary_edges));
  EXPECT_LT(rms_of(open), 1.05 * rms_of(one.mesh));
  run(cloud, 3000, "other.ply", keep, 1, "work");
  EXPECT_TRUE(bytes("open.ply") == bytes("other.ply"));
}

// The rim of the wavy sheet is where its points end.
TEST_F(TileReconstructOptions, keeps_a_sheet_open) {
  PointCloud cloud;
  for (std::size_t i = 0; i < 5000; ++i) {
    const double x = 2 * random_uniform(5, 2 * i) - 1, y = 2 * random_uniform(5, 2 * i + 1) - 1;
    cloud.points.push_back({x, y, 0.2 * std::sin(3 * x)});
    cloud.normals.push_back(normalized(Vec3{-0.6 * std::cos(3 * x), 0, 1}));
  }
  const ReconstructOptions keep{.holes = HolePolicy::kKeep};
  run(cloud, 1500, "sheet.ply", keep);
  const Mesh sheet = mesh("sheet.ply");
  const Inspection found = inspect(sheet);
  EXPECT_TRUE(found.manifold);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.euler_characteristic, 1);
  const double spacing = std::sqrt(4.0 / 5000);
  for (const Vec3& v : sheet.vertices) {
    const double rim = std::max(std::abs(v.x), std::abs(v.y));
    // Beyond the last points the surface is extrapolated.
    ASSERT_NEAR(v.z, 0.2 * std::sin(3 * v.x), (rim < 0.9 ? 0.05 : 1.0) * spacing);
    ASSERT_LT(rim, 1 + 2 * spacing);
  }
}

// The result has as many triangles as requested, and attributes of vertices are kept.
TEST_F(TileReconstructOptions, simplifies_through_tiles_nightly) {
  PointCloud cloud = torus_points(15000);
  cloud.attributes = {{"height", ScalarType::kFloat32, {}}};
  for (const Vec3& p : cloud.points) {
    cloud.attributes[0].values.push_back(static_cast<double>(static_cast<float>(p.z)));
  }
  const ReconstructOptions wanted{.simplify = SimplifyOptions{.faces = 8000}};
  const ReconstructReport report = run(cloud, 3000, "simple.ply", wanted);
  const Mesh simple = mesh("simple.ply");
  const Inspection found = test::expect_closed_manifold(simple);
  EXPECT_EQ(found.faces, 8000U);
  EXPECT_EQ(found.components, 1U);
  EXPECT_EQ(found.genus, 1);
  const Reconstruction one = reconstruct(cloud, wanted);
  EXPECT_NEAR(static_cast<double>(report.faces), static_cast<double>(one.report.faces),
              0.05 * static_cast<double>(one.report.faces));
  EXPECT_GT(report.simplify_error, 0.5 * one.report.simplify_error);
  EXPECT_LT(report.simplify_error, 2 * one.report.simplify_error);
  EXPECT_NEAR(report.area, one.report.area, 1e-3 * report.area);
  EXPECT_NEAR(report.volume, one.report.volume, 1e-3 * report.volume);
  ASSERT_EQ(simple.attributes.size(), 4U);
  for (std::size_t v = 0; v < simple.vertices.size(); ++v) {
    const Vec3& p = simple.vertices[v];
    const double around = std::hypot(p.x, p.y);
    const Vec3 truth = normalized(p - Vec3{kRing * p.x / around, kRing * p.y / around, 0});
    ASSERT_GT(dot(truth, {simple.attributes[0].values[v], simple.attributes[1].values[v],
                          simple.attributes[2].values[v]}),
              0.99);
    ASSERT_NEAR(simple.attributes[3].values[v], p.z, 0.06);
  }
  run(cloud, 3000, "other.ply", wanted, 1, "work");
  EXPECT_TRUE(bytes("simple.ply") == bytes("other.ply"));
}

// Simplification with borders, to the error that a step of the grid allows.
TEST_F(TileReconstructOptions, simplifies_what_is_open_nightly) {
  const PointCloud cloud = with_hole(torus_points(15000), {1.3, 0.1, 0.2}, 0.3);
  const ReconstructOptions wanted{.holes = HolePolicy::kKeep, .simplify = SimplifyOptions{}};
  const ReconstructReport report = run(cloud, 3000, "simple.ply", wanted);
  const Inspection found = inspect(mesh("simple.ply"));
  EXPECT_TRUE(found.manifold);
  EXPECT_TRUE(found.oriented);
  EXPECT_EQ(found.euler_characteristic, -1);
  EXPECT_LE(report.simplify_error, 0.02 * report.step * (1 + 1e-4));
  const Reconstruction one = reconstruct(cloud, wanted);
  EXPECT_NEAR(report.area, one.report.area, 5e-3 * report.area);
  const auto n = static_cast<double>(one.mesh.faces.size());
  EXPECT_NEAR(static_cast<double>(found.faces), n, 0.05 * n);
}

// The cloud is a torus with a hole and a thin plate.
TEST_F(TileReconstructOptions, knows_how_sure_it_is_as_one_piece_does_nightly) {
  PointCloud cloud = with_hole(torus_points(20000), {1.3, 0.1, 0.2}, 0.3);
  const auto random = [](std::size_t i) { return 1.2 * random_uniform(21, i) - 0.6; };
  for (std::size_t i = 0; i < 6000; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    cloud.points.push_back({random(2 * i), random(2 * i + 1), 0.7 + 0.015 * side});
    cloud.normals.push_back({0, 0, side});
  }
  for (std::size_t i = 0; i < 320; ++i) {  // its edges
    const double side = i % 2 == 0 ? 1 : -1, along = random(13000 + 2 * i);
    const double z = 0.7 + 0.025 * random(13001 + 2 * i);
    const bool x = i % 4 < 2;
    cloud.points.push_back(x ? Vec3{0.6 * side, along, z} : Vec3{along, 0.6 * side, z});
    cloud.normals.push_back(x ? Vec3{side, 0, 0} : Vec3{0, side, 0});
  }
  const ReconstructOptions wanted{.confidence = true};
  const ReconstructReport report = run(cloud, 3000, "sure.ply", wanted);
  const Mesh sure = mesh("sure.ply");
  ASSERT_EQ(sure.attributes.size(), 4U);
  EXPECT_EQ(sure.attributes[3].name, "confidence");
  const Reconstruction one = reconstruct(cloud, wanted);
  EXPECT_GT(report.unseen_area, 0.005);
  EXPECT_GT(report.thin_area, 0.05);
  EXPECT_NEAR(report.unseen_area, one.report.unseen_area, 0.03 * report.unseen_area);
  EXPECT_NEAR(report.thin_area, one.report.thin_area, 0.03 * report.thin_area);
  EXPECT_NEAR(report.unsure_area, one.report.unsure_area, 0.03 * report.unsure_area);
  // In the middle of the hole confidence is 0, and far from the hole and the plate it is full.
  for (std::size_t v = 0; v < sure.vertices.size(); ++v) {
    const double here = sure.attributes[3].values[v];
    if (norm(sure.vertices[v] - Vec3{1.3, 0.1, 0.2}) < 0.12) {
      ASSERT_EQ(here, 0);
    } else if (sure.vertices[v].x < -0.9) {
      ASSERT_GT(here, 0.9);
    }
  }
}

TEST_F(TileReconstructOptions, does_not_close_what_has_been_seen_to_be_empty_nightly) {
  const PointCloud cloud = test::bored_box(true);
  const ReconstructReport report = run(cloud, 5000, "seen.ply");
  EXPECT_EQ(test::expect_closed_manifold(mesh("seen.ply")).euler_characteristic, 2);
  const Reconstruction one = reconstruct(cloud);
  EXPECT_NEAR(report.volume, one.report.volume, 0.01 * report.volume);
  const double bore = std::numbers::pi * 0.16 * 1.5;
  EXPECT_NEAR(report.volume, 8 - bore, 0.3 * bore);
}

// The sensor lies inside: the surface that closes the hole ends where lines of sight leave.
TEST_F(TileReconstructOptions, takes_one_sensor_for_all_nightly) {
  PointCloud cloud;
  for (const Vec3& p : sample_surface(icosphere(4), {.points = 12000, .seed = 5}).points) {
    if (p.z < 0.7) cloud.points.push_back(normalized(p));
  }
  cloud.attributes = {{"sensor_x", ScalarType::kFloat64, {}}};
  cloud.attributes[0].values.assign(cloud.points.size(), 7);
  const ReconstructOptions wanted{.holes = HolePolicy::kKeep, .sensor = Vec3{0, 0, 0.1}};
  const ReconstructReport report = run(cloud, 4000, "inside.ply", wanted);
  const Mesh inside = mesh("inside.ply");
  EXPECT_EQ(find_attribute(inside.attributes, "sensor_x"), nullptr);
  for (std::size_t v = 0; v < inside.vertices.size(); ++v) {
    const Vec3 normal{inside.attributes[0].values[v], inside.attributes[1].values[v],
                      inside.attributes[2].values[v]};
    ASSERT_LT(dot(normal, inside.vertices[v]), -0.9);
  }
  // The volume is taken about the middle of the box, as in one piece.
  const Reconstruction one = reconstruct(cloud, wanted);
  EXPECT_NEAR(report.volume, one.report.volume, 0.01 * std::abs(report.volume));
  EXPECT_LT(report.volume, 0);
}

// Eight scans of a ball, each misaligned by three spacings: on average they stay in place, on one
// sphere. The order of the points does not matter.
TEST_F(TileReconstructOptions, brings_scans_together_as_one_piece_does) {
  PointCloud cloud =
      sample_surface(bumpy_sphere(5), {.points = 8000, .scans = 8, .misalignment = 0.04});
  const Reconstruction one = reconstruct(cloud);
  ReconstructOptions options{.tile_points = 3000, .output = path("tiles.ply")};
  const ReconstructReport report = reconstruct(cloud, options).report;
  EXPECT_GT(report.tiles, 2U);
  EXPECT_EQ(report.scans.scans, 8U);
  EXPECT_GT(report.scans.pairs, 1000U);
  // A third of the points determine the motions. Their error is far below a tenth of the motions.
  EXPECT_NEAR(report.scans.moved, one.report.scans.moved, 0.1 * one.report.scans.moved);
  EXPECT_LT(report.scans.distance, 0.2 * report.scans.distance_before);
  EXPECT_EQ(report.noise, 0);
  EXPECT_EQ(test::expect_closed_manifold(mesh("tiles.ply")).euler_characteristic, 2);
  EXPECT_NEAR(report.volume, one.report.volume, 1e-3 * one.report.volume);
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  for (Attribute& attribute : cloud.attributes) {
    std::reverse(attribute.values.begin(), attribute.values.end());
  }
  options.output = path("reversed.ply");
  reconstruct(cloud, options);
  EXPECT_TRUE(bytes("tiles.ply") == bytes("reversed.ply"));
  options.output = path("left.ply"), options.keep_scans = true;
  EXPECT_EQ(reconstruct(cloud, options).report.scans.scans, 0U);
}

TEST_F(TileReconstructOptions, refuses_what_no_surface_goes_with) {
  PointCloud plane, line;
  for (std::size_t i = 0; i < 3000; ++i) {
    const double x = random_uniform(5, 2 * i), y = random_uniform(5, 2 * i + 1);
    plane.points.push_back({x, y, 0});
    plane.normals.push_back({0, 0, 1});
    line.points.push_back({x, 2 * x, x});
    line.normals.push_back({0, 0, 1});
  }
  const auto message = [&](const PointCloud& cloud) -> std::string {
    try {
      run(cloud, 1000, "none.ply");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(plane).find("bound no solid"), std::string::npos);
  EXPECT_NE(message(line).find("lie on one line"), std::string::npos);
  PointCloud few = plane;
  few.points.resize(10), few.normals.resize(10);
  EXPECT_NE(message(few).find("too few"), std::string::npos);
  PointCloud tiny = torus_points(2000);
  for (Vec3& p : tiny.points) p *= 1e-14;
  EXPECT_NE(message(tiny).find("take another unit"), std::string::npos);
}

TEST_F(TileReconstructOptions, drops_small_parts_through_all_tiles_nightly) {
  PointCloud cloud = torus_points(20000);
  const PointCloud crumb =
      sample_surface(icosphere(3), {.points = 300, .seed = 3});  // a small ball far from the torus
  for (std::size_t i = 0; i < crumb.points.size(); ++i) {
    cloud.points.push_back(0.05 * crumb.points[i] + Vec3{0.02, 0, 0.01});
    cloud.normals.push_back(crumb.normals[i]);
  }
  EXPECT_EQ(run(cloud, 3000, "one.ply", {.min_component = 0.01}).dropped_components, 1U);
  EXPECT_EQ(inspect(mesh("one.ply")).components, 1U);
  EXPECT_EQ(run(cloud, 3000, "two.ply", {.min_component = 0}).dropped_components, 0U);
  EXPECT_EQ(inspect(mesh("two.ply")).components, 2U);
}

// Attributes have the values of the whole shape: a linear function and an integer.
TEST_F(TileReconstructOptions, carries_attributes) {
  PointCloud cloud = torus_points(6000);
  cloud.attributes = {{"height", ScalarType::kFloat32, {}}, {"side", ScalarType::kUint8, {}}};
  for (const Vec3& p : cloud.points) {
    cloud.attributes[0].values.push_back(static_cast<double>(static_cast<float>(p.z)));
    cloud.attributes[1].values.push_back(p.x < 0 ? 10 : 20);
  }
  run(cloud, 2000, "carried.ply");
  const Mesh carried = mesh("carried.ply");
  ASSERT_EQ(carried.attributes.size(), 5U);
  EXPECT_EQ(carried.attributes[3].name, "height");
  EXPECT_EQ(carried.attributes[4].type, ScalarType::kUint8);
  const double spacing = std::sqrt(4 * std::numbers::pi * std::numbers::pi * kRing * kTube / 6000);
  for (std::size_t v = 0; v < carried.vertices.size(); ++v) {
    const Vec3& p = carried.vertices[v];
    ASSERT_NEAR(carried.attributes[3].values[v], p.z, 2 * spacing);  // mean of eight neighbours
    if (std::abs(p.x) > 4 * spacing) {
      ASSERT_EQ(carried.attributes[4].values[v], p.x < 0 ? 10 : 20);
    }
  }
}

}  // namespace
}  // namespace rholm
