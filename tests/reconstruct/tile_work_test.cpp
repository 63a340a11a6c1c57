#include "rholm/reconstruct.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "reconstruct/torus_in_tiles.h"
#include "rholm/atlas_model.h"
#include "rholm/error.h"
#include "rholm/shape_io.h"
#include "support/reconstruct_checks.h"

namespace rholm {
namespace {

using namespace testing;

class TileReconstructWork : public TileFiles {};

TEST_F(TileReconstructWork, neither_threads_nor_a_folder_nor_the_order_change_a_bit_nightly) {
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

// The run is cancelled after each of its stages and resumed. The cloud has rare features: outliers,
// borders, strips of triangles between tiles.
TEST_F(TileReconstructWork, is_taken_up_where_it_ended_nightly) {
  PointCloud cloud = with_outliers(torus_points(12000), 200);
  for (std::size_t i = 0; i < 12000; ++i) {
    if (norm(cloud.points[i] - Vec3{1.3, 0.1, 0.2}) < 0.3) cloud.points[i] = {0, 0, 2.5};
  }
  const ReconstructOptions options{.holes = HolePolicy::kKeep,
                                   .simplify = SimplifyOptions{.share = 0.1}};
  run(cloud, 3000, "whole.ply", options);
  ReconstructOptions resumed = options;
  resumed.tile_points = 3000, resumed.output = path("parts.ply");
  resumed.work_dir = path(""), resumed.resume = true;
  const std::filesystem::path kept = path("parts.ply.tiles");
  std::size_t runs = 0;
  std::vector<std::string> ended;  // names of stages
  for (bool done = false; !done && runs < 100; ++runs) {
    std::string first;
    Context context{.threads = 2};
    context.progress = [&](std::string_view stage, double part) {
      // Stops the first time that a stage is at its end.
      if (first.empty() && part == 1 &&
          std::find(ended.begin(), ended.end(), stage) == ended.end()) {
        first = stage;
        ended.push_back(first);
      }
      return first.empty();
    };
    try {
      const ReconstructReport report = reconstruct(cloud, resumed, context).report;
      EXPECT_EQ(report.tiles, 4U);
      EXPECT_EQ(report.points, 12200U);
      EXPECT_EQ(report.faces, report.faces / 10);
      done = true;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
      EXPECT_FALSE(std::filesystem::exists(path("parts.ply")));
      EXPECT_TRUE(std::filesystem::exists(kept));
    }
  }
  EXPECT_GE(runs, 8U);
  EXPECT_TRUE(bytes("parts.ply") == bytes("whole.ply"));
  EXPECT_FALSE(std::filesystem::exists(kept));
}

TEST_F(TileReconstructWork, leaves_no_folder_unless_it_is_to_be_taken_up) {
  const PointCloud cloud = torus_points(6000);
  ReconstructOptions wanted{.tile_points = 3000,
                            .max_memory = 12 << 20,  // too little to keep tiles in memory
                            .output = path("a.ply"),
                            .work_dir = path("")};
  const auto is_empty = [&] { return std::filesystem::is_empty(path("")); };
  Context stops;
  stops.progress = [&](std::string_view stage, double) { return stage != "surface"; };
  EXPECT_THROW(reconstruct(cloud, wanted, stops), Error);
  EXPECT_TRUE(is_empty());
  wanted.resume = true;
  EXPECT_THROW(reconstruct(cloud, wanted, stops), Error);
  EXPECT_FALSE(is_empty());
  PointCloud given = cloud;
  const auto refused = [&](const ReconstructOptions& options, const char* says) {
    try {
      reconstruct(given, options);
      ADD_FAILURE() << "it was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  ReconstructOptions other = wanted;
  other.tolerance = 0.01;
  refused(other, "another run");
  other = wanted;
  other.tile_points = 2000;
  refused(other, "another run");
  other.tile_points = 10;
  refused(other, "1000");
  given.points.back().x += 1e-3;
  refused(wanted, "another run");
  // Options that do not change the surface may differ.
  wanted.max_memory = std::size_t{1} << 30;
  reconstruct(cloud, wanted);
  std::filesystem::remove(path("a.ply"));
  EXPECT_TRUE(is_empty());
}

TEST_F(TileReconstructWork, foresees_nothing_for_tiles_that_there_are_none_of) {
  for (const std::uint64_t points :
       {std::uint64_t{0}, std::uint64_t{999}, std::uint64_t{1} << 29}) {
    EXPECT_THROW(foresee_tiles(1000000, points), Error);
  }
}

TEST_F(TileReconstructWork, foresees_what_it_takes) {
  const PointCloud cloud = torus_points(8000);
  TileForecast told;
  ReconstructOptions wanted{.tile_points = 2000,
                            .output = path("a.ply"),
                            .work_dir = path(""),
                            .foreseen = [&](const TileForecast& forecast) { told = forecast; }};
  const ReconstructReport report = reconstruct(cloud, wanted).report;
  EXPECT_EQ(told.points, 8000U);
  EXPECT_EQ(told.tiles, report.tiles);
  EXPECT_GT(report.stored, told.stored / 2);
  EXPECT_LT(report.stored, 2 * told.stored);
  wanted.max_memory = 1 << 20, wanted.output = path("b.ply");
  try {
    reconstruct(cloud, wanted);
    ADD_FAILURE() << "it was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
  }
  std::filesystem::remove(path("a.ply"));
  EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

// Runs of one tile and of several: errors name tiles that fit, and nothing else changes.
TEST_F(TileReconstructWork, memory_refuses_or_changes_nothing) {
  const PointCloud cloud = torus_points(9000);
  for (const std::uint64_t tile_points : {std::uint64_t{6000}, kTilePoints}) {
    const Mesh known = reconstruct(cloud, {.tile_points = tile_points}).mesh;
    for (const std::size_t mebibytes : {6, 24}) {
      ReconstructOptions wanted{
          .tile_points = tile_points, .max_memory = mebibytes << 20, .output = path("s.ply")};
      try {
        reconstruct(cloud, wanted);
        const Mesh made = mesh("s.ply");
        EXPECT_EQ(made.faces, known.faces);
        write_shape(known, path("known.ply"));
        EXPECT_TRUE(bytes("s.ply") == bytes("known.ply"));
      } catch (const Error& error) {
        EXPECT_EQ(mebibytes, 6U);
        ASSERT_EQ(error.code(), ErrorCode::kOutOfMemory);
        const std::string said = error.what(), option = "--tile-points ";
        const std::size_t at = said.find(option);
        ASSERT_NE(at, std::string::npos) << said;
        wanted.tile_points = std::stoull(said.substr(at + option.size()));
        EXPECT_LT(wanted.tile_points, tile_points);
        EXPECT_GT(reconstruct(cloud, wanted).report.tiles, 1U);
      }
    }
  }
}

TEST_F(TileReconstructWork, gives_the_same_in_memory_and_in_files) {
  const PointCloud cloud = torus_points(5000);
  write_shape(cloud, path("points.ply"));
  const PointCloud read = std::get<PointCloud>(read_shape(path("points.ply")).shape);
  const ReconstructReport report =
      reconstruct(path("points.ply"),
                  {.tile_points = 1500, .output = path("file.ply"), .model = path("model.h5")})
          .report;
  const Reconstruction kept = reconstruct(read, {.tile_points = 1500});
  write_shape(kept.mesh, path("memory.ply"));
  EXPECT_TRUE(bytes("file.ply") == bytes("memory.ply"));
  EXPECT_EQ(kept.mesh.vertices.size(), report.vertices);
  EXPECT_EQ(kept.report.area, report.area);
  write_atlas(kept.model, path("kept.h5"));
  EXPECT_TRUE(bytes("model.h5") == bytes("kept.h5"));
  const AtlasModel model = read_atlas(path("model.h5"));
  EXPECT_EQ(model.atlas.caps.size(), report.caps);
  EXPECT_EQ(model.atlas.coefficients.size(), report.coefficients);
}

// A plan with one tile gives the same bytes for any order of the points, and for points from
// memory, a file and a pipe. With a pipe, points and intermediate results are kept in a folder.
TEST_F(TileReconstructWork, of_one_tile_depends_on_the_set_of_points_only) {
  for (const bool directed : {true, false}) {
    PointCloud cloud = with_outliers(torus_points(6000), 100);
    if (!directed) cloud.normals.clear();
    std::vector<double> heights;
    heights.reserve(cloud.points.size());
    for (const Vec3& p : cloud.points) heights.push_back(p.z);
    cloud.attributes.push_back({"height", ScalarType::kFloat64, heights});
    const ReconstructReport report =
        run(cloud, kTilePoints, "a.ply", {.model = path("a.h5")}, /*threads=*/1);
    EXPECT_EQ(report.tiles, 1U);
    EXPECT_EQ(report.computed_normals, !directed);
    EXPECT_GT(report.outliers, 0U);

    std::reverse(cloud.points.begin(), cloud.points.end());
    std::reverse(cloud.normals.begin(), cloud.normals.end());
    std::reverse(cloud.attributes[0].values.begin(), cloud.attributes[0].values.end());
    write_shape(cloud, path("points.ply"));
    run(std::get<PointCloud>(read_shape(path("points.ply")).shape), kTilePoints, "b.ply",
        {.model = path("b.h5")}, /*threads=*/3);
    reconstruct(path("points.ply"), {.output = path("c.ply"), .model = path("c.h5")});

    const std::string points = bytes("points.ply");
    ASSERT_EQ(::mkfifo(path("pipe.ply").c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(path("pipe.ply"), std::ios::binary) << points; });
    reconstruct(path("pipe.ply"),
                {.output = path("d.ply"), .model = path("d.h5"), .work_dir = path("")});
    writer.join();
    std::filesystem::remove(path("pipe.ply"));
    for (const std::string name : {"b", "c", "d"}) {
      EXPECT_TRUE(bytes("a.ply") == bytes(name + ".ply")) << name;
      EXPECT_TRUE(bytes("a.h5") == bytes(name + ".h5")) << name;
    }
  }
}

// A mesh gives its vertices, with the mean normals of their faces.
TEST_F(TileReconstructWork, reads_meshes_as_a_whole) {
  write_shape(torus(kRing, kTube, 60, 40), path("torus.obj"));
  for (const std::uint64_t tile_points : {std::uint64_t{1000}, kTilePoints}) {
    const Reconstruction made = reconstruct(path("torus.obj"), {.tile_points = tile_points});
    EXPECT_EQ(made.report.points, 2400U);
    EXPECT_EQ(made.report.tiles > 1, tile_points < 2400);
    EXPECT_FALSE(made.report.computed_normals);
    EXPECT_EQ(test::expect_closed_manifold(made.mesh).genus, 1);
  }
}

}  // namespace
}  // namespace rholm
