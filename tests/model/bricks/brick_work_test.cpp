#include "rholm/reconstruct_bricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/bricks/torus_in_bricks.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/shape_io.h"
#include "support/reconstruct_checks.h"

namespace rholm {
namespace {

using namespace testing;

class BrickReconstructWork : public BrickFiles {};

TEST_F(BrickReconstructWork, neither_threads_nor_a_folder_nor_the_order_change_a_bit_nightly) {
  PointCloud cloud = torus_points(20000);
  run(cloud, 3000, "a.ply", {}, 1);
  run(cloud, 3000, "b.ply", {}, 3, "work");
  EXPECT_TRUE(bytes("a.ply") == bytes("b.ply"));
  EXPECT_FALSE(std::filesystem::exists(path("work")));
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.normals.begin(), cloud.normals.end());
  run(cloud, 3000, "c.ply");
  EXPECT_TRUE(bytes("a.ply") == bytes("c.ply"));
}

// Cancelled after each of its stages, and taken up.
// Also what is rare: outliers, borders, strips of triangles between bricks.
TEST_F(BrickReconstructWork, is_taken_up_where_it_ended_nightly) {
  PointCloud cloud = with_outliers(torus_points(12000), 200);
  for (std::size_t i = 0; i < 12000; ++i) {
    if (norm(cloud.points[i] - Vec3{1.3, 0.1, 0.2}) < 0.3) cloud.points[i] = {0, 0, 2.5};
  }
  const ReconstructOptions options{.holes = HolePolicy::kKeep,
                                   .simplify = SimplifyOptions{.share = 0.1}};
  run(cloud, 3000, "whole.ply", options);
  const BrickOptions bricks{.points_per_brick = 3000, .work_dir = path("work"), .resume = true};
  std::size_t runs = 0;
  std::vector<std::string> ended;  // stages
  for (bool done = false; !done && runs < 100; ++runs) {
    std::string first;
    Context context{.threads = 2};
    context.progress = [&](std::string_view stage, double part) {
      // The first time that a stage is at its end.
      if (first.empty() && part == 1 &&
          std::find(ended.begin(), ended.end(), stage) == ended.end()) {
        first = stage;
        ended.push_back(first);
      }
      return first.empty();
    };
    try {
      const BrickReconstruction made =
          reconstruct_bricks(cloud, path("parts.ply"), options, bricks, context);
      EXPECT_EQ(made.bricks, 4U);
      EXPECT_EQ(made.report.points, 12200U);
      EXPECT_EQ(made.triangles, made.report.faces / 10);
      done = true;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
      EXPECT_FALSE(std::filesystem::exists(path("parts.ply")));
      EXPECT_TRUE(std::filesystem::exists(path("work")));
    }
  }
  EXPECT_GE(runs, 8U);
  EXPECT_TRUE(bytes("parts.ply") == bytes("whole.ply"));
  EXPECT_FALSE(std::filesystem::exists(path("work")));
}

TEST_F(BrickReconstructWork, leaves_no_folder_unless_it_is_to_be_taken_up) {
  const PointCloud cloud = torus_points(6000);
  BrickOptions bricks{.points_per_brick = 3000, .work_dir = path("work")};
  Context stops;
  stops.progress = [&](std::string_view stage, double) { return stage != "surface"; };
  EXPECT_THROW(reconstruct_bricks(cloud, path("a.ply"), {}, bricks, stops), Error);
  EXPECT_FALSE(std::filesystem::exists(path("work")));
  bricks.resume = true;
  EXPECT_THROW(reconstruct_bricks(cloud, path("a.ply"), {}, bricks, stops), Error);
  PointCloud given = cloud;
  const auto refused = [&](const ReconstructOptions& options, const char* says) {
    try {
      reconstruct_bricks(given, path("a.ply"), options, bricks);
      ADD_FAILURE() << "it was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  refused({.tolerance = 0.01}, "another run");
  given.points.back().x += 1e-3;
  refused({}, "another run");
  given = cloud;
  bricks.resume = false;
  refused({}, "earlier run");
  bricks.resume = true;
  bricks.points_per_brick = 10;
  refused({}, "1000");
  bricks.points_per_brick = 3000;
  reconstruct_bricks(cloud, path("a.ply"), {}, bricks);
  EXPECT_FALSE(std::filesystem::exists(path("work")));
}

TEST_F(BrickReconstructWork, foresees_nothing_for_bricks_that_there_are_none_of) {
  for (const std::uint64_t points :
       {std::uint64_t{0}, std::uint64_t{999}, std::uint64_t{1} << 29}) {
    EXPECT_THROW(foresee_bricks(1000000, points), Error);
  }
}

TEST_F(BrickReconstructWork, foresees_what_it_takes) {
  const PointCloud cloud = torus_points(20000);
  BrickForecast told;
  const BrickOptions bricks{.points_per_brick = 5000,
                            .work_dir = path("work"),
                            .foreseen = [&](const BrickForecast& forecast) { told = forecast; }};
  const BrickReconstruction made = reconstruct_bricks(cloud, path("a.ply"), {}, bricks);
  EXPECT_EQ(told.points, 20000U);
  EXPECT_EQ(told.bricks, made.bricks);
  EXPECT_GT(made.stored, told.stored / 2);
  EXPECT_LT(made.stored, 2 * told.stored);
  try {
    reconstruct_bricks(cloud, path("b.ply"), {.max_memory = 1 << 20}, bricks);
    ADD_FAILURE() << "it was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
  }
  EXPECT_FALSE(std::filesystem::exists(path("work")));
}

TEST_F(BrickReconstructWork, reads_a_file_and_writes_a_model_of_its_caps) {
  const PointCloud cloud = torus_points(10000);
  write_shape(cloud, path("points.ply"));
  const BrickOptions bricks{.points_per_brick = 3000, .model = path("model.h5")};
  const BrickReconstruction made =
      reconstruct_bricks(path("points.ply"), path("file.ply"), {}, bricks);
  const PointCloud read = std::get<PointCloud>(read_shape(path("points.ply")).shape);
  run(read, 3000, "memory.ply");
  EXPECT_TRUE(bytes("file.ply") == bytes("memory.ply"));
  const AtlasModel model = read_atlas(path("model.h5"));
  EXPECT_EQ(model.atlas.caps.size(), made.report.caps);
  EXPECT_EQ(model.atlas.coefficients.size(), made.coefficients);
  const Mesh again = synthesize(model);
  EXPECT_EQ(test::expect_closed_manifold(again).genus, 1);
  EXPECT_LT(rms_of(again), 1.05 * rms_of(mesh("file.ply")));
}

}  // namespace
}  // namespace rholm
