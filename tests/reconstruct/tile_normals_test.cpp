// Normals in tiles, compared with orient() on all points at once and with the true normals.
#include "reconstruct/normals/tile_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "parts/memory_store.h"
#include "parts/threads.h"
#include "reconstruct/cloud/load_tile.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/test_support.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

using testing::bytes_of_piece;
using testing::expect_error;
using testing::shuffled;
using testing::Tiles;

struct Oriented {
  MemoryStore store;
  Tiles tiles;
  StageTimes times = {};
  TileNormalsReport report = {};

  Oriented(const PointCloud& cloud, std::uint64_t points_per_tile,
           const TileNormalsOptions& options = {}, const Context& context = {})
      : tiles(*points_in_memory(cloud), store, points_per_tile) {
    Threads alone;
    Stages stages(alone, store, {}, times, context);
    report = orient_tiles(store, tiles.plan, spacings(), options, stages);
  }
  std::size_t n() const { return tiles.plan.n_tiles(); }
  std::vector<double> spacings() const {
    return spacings_of_sample(tiles.found, tiles.plan, tiles.found.n_different);
  }
};

PointCloud without_normals(PointCloud cloud) {
  cloud.normals.clear();
  return cloud;
}

using Place = std::tuple<double, double, double>;
Place place_of(const Vec3& p) { return {p.x, p.y, p.z}; }

// Calls body(index in the cloud, normal found) for the normal at each point of a cloud.
template <typename Body>
void for_each_normal(const Oriented& made, const PointCloud& cloud, const Body& body) {
  std::map<Place, std::size_t> index;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) index[place_of(cloud.points[i])] = i;
  std::size_t n = 0;
  for (std::size_t tile = 0; tile < made.n(); ++tile) {
    const PointCloud points = read_points(made.store, tile);
    const std::vector<TileNormal> normals = read_normals(made.store, tile);
    ASSERT_EQ(points.points.size(), normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i, ++n) {
      body(index.at(place_of(points.points[i])), normals[i]);
    }
  }
  EXPECT_EQ(n, cloud.points.size());
}

double share_right(const Oriented& made, const PointCloud& truth) {
  double right = 0;
  for_each_normal(made, truth, [&](std::size_t i, const TileNormal& found) {
    right += dot(truth.normals[i], found.normal()) > 0;
  });
  return right / static_cast<double>(truth.points.size());
}

PointCloud ring_points(std::size_t n) {
  return sample_surface(torus(1, 0.4, 96, 48), {.points = n});
}

TEST(tile_normals, of_one_tile_are_those_of_all_points) {
  const PointCloud given = ring_points(6000);
  const Oriented made(without_normals(given), 10000);
  ASSERT_EQ(made.n(), 1u);
  PointCloud whole = without_normals(given);
  const OrientReport report = orient(whole, {.keep_outliers = true, .confidence = true});
  EXPECT_EQ(made.report.components, report.components);
  EXPECT_EQ(made.report.neighbors, static_cast<std::uint64_t>(report.neighbors));
  EXPECT_EQ(made.report.points, given.points.size());
  EXPECT_EQ(static_cast<double>(made.report.unsure) / static_cast<double>(given.points.size()),
            report.unsure);
  double mean = 0;
  for_each_normal(made, whole, [&](std::size_t i, const TileNormal& found) {
    EXPECT_GT(dot(whole.normals[i], found.normal()), 0.0);
    mean += norm(whole.normals[i] - found.normal());
    EXPECT_NEAR(whole.attributes[0].values[i], static_cast<double>(found.confidence), 0.05);
  });
  // The difference comes from single precision and from other frames.
  EXPECT_LT(mean / static_cast<double>(given.points.size()), 1e-6);
}

TEST(tile_normals, of_many_tiles_point_out_nightly) {
  const PointCloud given = ring_points(12000);
  for (const std::uint64_t points_per_tile : {4000, 1000, 400}) {
    const Oriented made(without_normals(given), points_per_tile);
    EXPECT_GT(made.n(), 2u);
    EXPECT_EQ(made.report.components, 1u);
    EXPECT_EQ(made.report.undetermined, 0u);
    EXPECT_EQ(share_right(made, given), 1.0) << points_per_tile;
  }
}

// Normals beside faces between tiles use points on all sides.
TEST(tile_normals, have_the_directions_of_all_points) {
  for (const double noise : {0.0, 0.005}) {
    const PointCloud given =
        sample_surface(torus(1, 0.4, 96, 48), {.points = 6000, .noise = noise});
    const Oriented made(without_normals(given), 1000);
    PointCloud whole = without_normals(given);
    orient(whole, {.neighbors = static_cast<int>(made.report.neighbors), .keep_outliers = true});
    std::size_t others = 0;
    for_each_normal(made, whole, [&](std::size_t i, const TileNormal& found) {
      others += norm(whole.normals[i] - found.normal()) > 1e-3 ? 1 : 0;
    });
    EXPECT_LE(others, given.points.size() / 500) << noise;
  }
}

TEST(tile_normals, turn_what_bounds_a_cavity_inwards) {
  PointCloud shell = sample_surface(icosphere(4), {.points = 4500});
  const PointCloud inner = sample_surface(icosphere(4), {.points = 2000, .seed = 2});
  for (const Vec3& p : inner.points) shell.points.push_back(0.6 * p);
  for (const Vec3& n : inner.normals) shell.normals.push_back(-n);
  const Oriented made(without_normals(shell), 1000);
  EXPECT_EQ(made.report.components, 2u);
  EXPECT_EQ(share_right(made, shell), 1.0);
}

// Where the spanning tree is unsure, a field of all points decides: two intersecting balls, and
// rows.
PointCloud crossing_balls() {
  PointCloud cloud;
  for (const double x : {-0.45, 0.45}) {
    PointCloud ball = sample_surface(icosphere(4), {.points = 2500, .seed = x < 0 ? 1U : 2U});
    for (const Vec3& p : ball.points) cloud.points.push_back(p + Vec3{x, 0, 0});
    cloud.normals.insert(cloud.normals.end(), ball.normals.begin(), ball.normals.end());
  }
  return cloud;
}

TEST(tile_normals, are_those_of_a_field_where_the_graph_is_in_doubt_nightly) {
  const PointCloud rows =
      sample_surface(torus(1, 0.4, 96, 48),
                     {.points = 5000, .pattern = SamplePattern::kSlices, .pattern_ratio = 6});
  for (const PointCloud& given : {crossing_balls(), rows}) {
    PointCloud whole = without_normals(given);
    orient(whole, {.keep_outliers = true});
    for (const std::uint64_t points_per_tile : {20000, 1500}) {
      const std::uint64_t samples = points_per_tile == 1500 ? 1000 : 200000;
      const Oriented made(without_normals(given), points_per_tile, {.samples = samples});
      EXPECT_TRUE(made.times.contains("field"));
      double same = 0;
      for_each_normal(made, whole, [&](std::size_t i, const TileNormal& found) {
        same += dot(whole.normals[i], found.normal()) > 0;
      });
      EXPECT_GT(same, 0.995 * static_cast<double>(given.points.size())) << points_per_tile;
      EXPECT_FALSE(made.store.has("thinned/0"));
      EXPECT_FALSE(made.store.has("sheets0/0"));
    }
  }
}

// Samples farther apart than the plate is thick do not resolve it, and would use the field.
TEST(tile_normals, of_a_plate_that_samples_do_not_show_are_sure_nightly) {
  const PointCloud given = sample_surface(box({1, 1, 0.05}), {.points = 15000});
  const Oriented made(without_normals(given), 2500, {.samples = 300});
  PointCloud whole = without_normals(given);
  orient(whole, {.keep_outliers = true});
  double same = 0;
  for_each_normal(made, whole, [&](std::size_t i, const TileNormal& found) {
    same += dot(whole.normals[i], found.normal()) > 0;
  });
  EXPECT_EQ(same, static_cast<double>(given.points.size()));
  EXPECT_FALSE(made.times.contains("field"));
}

TEST(tile_normals, of_noisy_points_are_right_where_they_are_sure_nightly) {
  const PointCloud given = sample_surface(box({1, 2, 3}), {.points = 15000, .noise = 0.004});
  const Oriented made(without_normals(given), 2500);
  EXPECT_GT(made.report.neighbors, 10u);
  double sure = 0, wrong = 0;
  for_each_normal(made, given, [&](std::size_t i, const TileNormal& found) {
    if (found.confidence < 0.9F) return;
    ++sure;
    wrong += dot(given.normals[i], found.normal()) < 0;
  });
  EXPECT_GT(sure, 0.8 * 15000);
  // The given normals are normals of faces: beside an edge a fit may differ by more than 90
  // degrees.
  EXPECT_LT(wrong, 0.005 * sure);
}

TEST(tile_normals, do_not_depend_on_threads_or_on_the_order_of_the_points) {
  const PointCloud given = without_normals(
      sample_surface(bumpy_sphere(4), {.points = 9000, .noise = 0.003, .scans = 2}));
  const Oriented one(given, 3000, {}, {.threads = 1});
  const Oriented other(shuffled(given), 3000, {}, {.threads = 4});
  ASSERT_EQ(one.n(), other.n());
  for (std::size_t tile = 0; tile < one.n(); ++tile) {
    const std::string name = "normals/" + std::to_string(tile);
    EXPECT_EQ(bytes_of_piece(one.store, name), bytes_of_piece(other.store, name));
  }
}

TEST(tile_normals, face_the_sensor_of_each_point) {
  const PointCloud given =
      sample_surface(bumpy_sphere(4), {.points = 8000, .scans = 3, .sensor = true});
  const Oriented made(without_normals(given), 1500);
  EXPECT_EQ(made.report.components, 0u);
  PointCloud whole = without_normals(given);
  orient(whole);
  for_each_normal(made, whole, [&](std::size_t i, const TileNormal& found) {
    EXPECT_GT(dot(whole.normals[i], found.normal()), 0.0);
  });
  EXPECT_GT(share_right(made, given), 0.999);
}

TEST(tile_normals, face_one_sensor_for_all) {
  PointCloud given = ring_points(5000);
  const Vec3 above{0, 0, 5};
  const Oriented made(without_normals(given), 1000, {.sensor = above});
  std::size_t away = 0;
  for_each_normal(made, given, [&](std::size_t i, const TileNormal& found) {
    const Vec3 to = normalized(above - given.points[i]);
    // Points seen at a glancing angle may face away.
    away += dot(found.normal(), to) < -0.1 ? 1 : 0;
  });
  EXPECT_EQ(away, 0u);
}

TEST(tile_normals, are_looked_for_without_sensors_that_are_not_all_known) {
  PointCloud given = sample_surface(bumpy_sphere(3), {.points = 3000, .scans = 2, .sensor = true});
  for (Attribute& attribute : given.attributes) {
    if (attribute.name == "sensor_y") attribute.values[1234] = std::nan("");
  }
  const Oriented made(without_normals(given), 1000);
  EXPECT_EQ(made.report.components, 1u);
}

TEST(tile_normals, are_the_same_after_an_interruption) {
  const PointCloud given = without_normals(ring_points(4000));
  const Oriented whole(given, 1000);
  MemoryStore store;
  const Tiles tiles(*points_in_memory(given), store, 1000);
  const std::vector<double> spacings =
      spacings_of_sample(tiles.found, tiles.plan, tiles.found.n_different);
  {
    TileNormals begun(store, tiles.plan, spacings, {});
    begun.choose_neighbors({});
    for (const std::size_t tile : {2, 0, 1}) begun.find_directions(tile, {});
  }
  {
    TileNormals begun(store, tiles.plan, spacings, {});
    begun.choose_neighbors({});
    for (std::size_t tile = 0; tile < whole.n(); ++tile) begun.find_directions(tile, {});
    for (const std::size_t tile : {3, 1}) begun.find_signs(tile, {});
  }
  Threads alone;
  StageTimes times;
  Stages stages(alone, store, {}, times, {});
  const TileNormalsReport report = orient_tiles(store, tiles.plan, spacings, {}, stages);
  EXPECT_EQ(report.components, whole.report.components);
  for (std::size_t tile = 0; tile < whole.n(); ++tile) {
    const std::string name = "normals/" + std::to_string(tile);
    EXPECT_EQ(bytes_of_piece(store, name), bytes_of_piece(whole.store, name));
    EXPECT_FALSE(store.has("directions/" + std::to_string(tile)));
  }
  // No work is repeated.
  StageTimes none;
  Stages no_stages(alone, store, {}, none, {});
  const TileNormalsReport again = orient_tiles(store, tiles.plan, spacings, {}, no_stages);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(again.points, report.points);
}

TEST(tile_normals, are_those_of_a_tile_that_is_loaded) {
  const PointCloud given = ring_points(5000);
  Oriented made(without_normals(given), 1000);
  const TileScene scene = load_tile(made.store, made.tiles.plan, 1, 0.1, {});
  EXPECT_EQ(scene.normal_neighbors, normal_neighbors(made.store));
  EXPECT_GE(scene.normal_neighbors, 10U);
  ASSERT_EQ(scene.normals.size(), scene.points.size());
  ASSERT_EQ(scene.confidence.size(), scene.points.size());
  EXPECT_GT(scene.points.size(), scene.n_own);
  std::map<Place, Vec3> truth;
  for (std::size_t i = 0; i < given.points.size(); ++i) {
    truth[place_of(given.points[i])] = given.normals[i];
  }
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    EXPECT_NEAR(norm(scene.normals[i]), 1, 1e-12);
    EXPECT_GT(dot(scene.normals[i], truth.at(place_of(scene.points[i]))), 0.9);
  }
}

TEST(tile_normals, of_points_on_a_line_are_refused) {
  PointCloud line;
  for (int i = 0; i < 100000; ++i) line.points.push_back({i / 1024.0, i / 512.0, 0});
  MemoryStore store;
  const Tiles tiles(*points_in_memory(line), store, 20000);
  Threads alone;
  StageTimes times;
  Stages stages(alone, store, {}, times, {});
  const std::vector<double> spacings =
      spacings_of_sample(tiles.found, tiles.plan, tiles.found.n_different);
  expect_error([&] { orient_tiles(store, tiles.plan, spacings, {}, stages); },
               ErrorCode::kInvalidInput, {"one line"});
}

}  // namespace
}  // namespace rholm
