// Samples, surveys and plans, compared with slow computations, and for any order of the points.
#include "reconstruct/points/tile_plan.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "parts/memory_store.h"
#include "reconstruct/points/point_sample.h"
#include "reconstruct/test_support.h"
#include "rholm/error.h"
#include "shape/points/isolated_points.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::shuffled;
using testing::sphere_points;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<Vec3> sample_of(const std::vector<Vec3>& points, std::size_t k, double* n = nullptr) {
  PointSample sample(k);
  for (const Vec3& p : points) sample.add(p);
  std::vector<Vec3> taken = sample.take();
  if (n != nullptr) *n = sample.n_different();
  return taken;
}

TEST(PointSample, has_the_smallest_hashes_of_all_different_points) {
  std::vector<Vec3> points = sphere_points(5000).points;
  for (std::size_t i = 0; i < 3000; ++i) points.push_back(points[i % 7]);
  points.push_back({0.0, 1, 2});
  points.push_back({-0.0, 1, 2});
  std::map<std::uint64_t, Vec3> by_hash;
  for (const Vec3& p : points) by_hash[place_hash(p)] = p;
  ASSERT_EQ(by_hash.size(), 5001u);
  for (const std::size_t k : {1, 2, 100, 2500, 5001, 20000}) {
    std::vector<Vec3> wanted;
    for (const auto& [hash, p] : by_hash) {
      if (wanted.size() < k) wanted.push_back(p);
    }
    EXPECT_EQ(sample_of(points, k), wanted);
    EXPECT_EQ(sample_of(shuffled({.points = points}).points, k), wanted);
  }
}

TEST(PointSample, tells_how_many_points_differ) {
  double n = 0;
  const std::vector<Vec3> points = sphere_points(100000).points;
  sample_of(points, 200000, &n);
  EXPECT_EQ(n, 100000);
  sample_of(points, 2500, &n);
  EXPECT_NEAR(n, 100000, 5 * 100000 / std::sqrt(2500));  // five standard deviations
}

TEST(PointSample, grows_with_the_points) {
  const std::vector<Vec3> points = sphere_points(40000).points;
  PointSample growing(500);
  for (std::size_t i = 0; i < points.size(); ++i) {
    growing.add(points[i]);
    growing.grow(i / 40);
  }
  EXPECT_EQ(growing.take(), sample_of(points, 999));
}

// A source of unknown size, like a pipe.
class Unsized final : public PointSource {
 public:
  explicit Unsized(const PointCloud& cloud) : source_(points_in_memory(cloud)) {}
  void rewind() override { source_->rewind(); }
  bool next(PointCloud& piece, const Context& context) override {
    return source_->next(piece, context);
  }
  std::optional<std::uint64_t> size() const override { return std::nullopt; }
  double part_read() const override { return source_->part_read(); }

 private:
  std::unique_ptr<PointSource> source_;
};

PointCloud with_isolated_points() {
  PointCloud cloud = sphere_points(20000);
  cloud.points[5] = {kNan, 0, 0};
  cloud.points[70] = {0, -std::numeric_limits<double>::infinity(), 0};
  cloud.points[100] = {1000, 0, 0};
  cloud.points[101] = {0, -90, 80};
  cloud.points[7000] = {40, 0, 0};  // near enough: nearly all points are in a box of diagonal 3.4
  return cloud;
}

TEST(survey, counts_as_those_do_who_see_all_points) {
  const PointCloud cloud = with_isolated_points();
  const std::vector<std::uint8_t> far = find_far_isolated_points(cloud.points);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < far.size(); ++i) {
    if (far[i] == 0 && is_finite(cloud.points[i])) kept.push_back(cloud.points[i]);
  }
  const Survey found = survey(*points_in_memory(cloud));
  EXPECT_EQ(found.far_isolated, static_cast<std::uint64_t>(std::count(far.begin(), far.end(), 1)));
  EXPECT_EQ(found.far_isolated, 2u);
  EXPECT_EQ(found.not_finite, 2u);
  EXPECT_EQ(found.points, kept.size());
  EXPECT_EQ(found.bounds.min, bounds(kept).min);
  EXPECT_EQ(found.bounds.max, bounds(kept).max);
  EXPECT_EQ(found.n_different, static_cast<double>(kept.size()));
  EXPECT_EQ(found.sample.size(), kept.size());
  const Survey all = survey(*points_in_memory(cloud), {.drop_far_isolated = false});
  EXPECT_EQ(all.far_isolated, 0u);
  EXPECT_EQ(all.bounds.max.x, 1000);
}

TEST(survey, does_not_depend_on_the_order) {
  const PointCloud cloud = with_isolated_points();
  const SurveyOptions options{.points_per_tile = 100, .least_sample = 300};
  const Survey a = survey(*points_in_memory(cloud), options);
  const PointCloud other = shuffled(cloud);
  const Survey b = survey(*points_in_memory(other), options);
  EXPECT_EQ(a.sample, b.sample);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.bounds.min, b.bounds.min);
  EXPECT_EQ(a.bounds.max, b.bounds.max);
  EXPECT_EQ(a.ball.middle, b.ball.middle);
  EXPECT_EQ(a.ball.radius, b.ball.radius);
  EXPECT_EQ(a.n_different, b.n_different);
  EXPECT_EQ(a.layout, b.layout);
  EXPECT_GE(a.sample.size(), 64 * 20000 / 100u - 2);
}

TEST(survey, does_not_depend_on_what_is_known_before) {
  PointCloud cloud = sphere_points(200000);
  for (std::size_t i = 0; i < 70000; ++i) cloud.points[2 * i].x = kNan;
  const SurveyOptions options{.points_per_tile = 1000, .least_sample = 1000};
  Unsized other(cloud);
  const Survey a = survey(*points_in_memory(cloud), options), b = survey(other, options);
  EXPECT_EQ(a.sample.size(), 64u * 130);
  EXPECT_EQ(a.sample, b.sample);
  EXPECT_EQ(a.n_different, b.n_different);
}

TEST(survey, knows_the_narrowest_layout) {
  PointCloud cloud = sphere_points(40000);
  Survey found = survey(*points_in_memory(cloud));
  EXPECT_TRUE(found.layout.normals);
  EXPECT_EQ(found.layout.row_bytes(), 12u + 12 + 4 + 1);
  cloud.points[39999].x = 0.1;
  cloud.attributes[1].values[20000] = 300;
  found = survey(*points_in_memory(cloud));
  EXPECT_EQ(found.layout.row_bytes(), 24u + 12 + 4 + 8);
  EXPECT_EQ(found.layout.columns[1].type, ScalarType::kUint8);
  // Normals without a direction count as missing.
  for (Vec3& normal : cloud.normals) normal = {};
  cloud.normals[17] = {kNan, 1, 0};
  EXPECT_FALSE(survey(*points_in_memory(cloud)).layout.normals);
  cloud.normals[18] = {0, 0, 1e-300};
  EXPECT_TRUE(survey(*points_in_memory(cloud)).layout.normals);
}

TEST(survey, is_kept_in_a_store) {
  MemoryStore store;
  EXPECT_FALSE(read_survey(store));
  const PointCloud cloud = with_isolated_points();
  const Survey found = survey(*points_in_memory(cloud));
  write_survey(found, store);
  const std::optional<Survey> again = read_survey(store);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sample, found.sample);
  EXPECT_EQ(again->layout, found.layout);
  EXPECT_EQ(again->points, found.points);
  EXPECT_EQ(again->not_finite, found.not_finite);
  EXPECT_EQ(again->far_isolated, found.far_isolated);
  EXPECT_EQ(again->ball.radius, found.ball.radius);
  EXPECT_EQ(again->ball.middle, found.ball.middle);
  EXPECT_EQ(again->bounds.min, found.bounds.min);
  EXPECT_EQ(again->bounds.max, found.bounds.max);
  EXPECT_EQ(again->n_different, found.n_different);
  store.write("survey", std::vector<std::vector<std::byte>>{{}, {}, {}});
  expect_error([&] { read_survey(store); }, ErrorCode::kInvalidInput, {"survey"});
}

TEST(survey, refuses_nothing) {
  expect_error([] { survey(*points_in_memory({})); }, ErrorCode::kInvalidInput, {"no points"});
  const PointCloud bad{.points = {{kNan, 0, 0}, {0, kNan, 0}}};
  expect_error([&] { survey(*points_in_memory(bad)); }, ErrorCode::kInvalidInput, {"finite"});
}

bool has(const Bounds& cell, const Vec3& p) {
  return p.x >= cell.min.x && p.y >= cell.min.y && p.z >= cell.min.z && p.x < cell.max.x &&
         p.y < cell.max.y && p.z < cell.max.z;
}

std::vector<std::size_t> counts_of(const TilePlan& plan, const std::vector<Vec3>& points) {
  std::vector<std::size_t> counts(plan.n_tiles());
  for (const Vec3& p : points) ++counts[plan.tile_of(p)];
  return counts;
}

TilePlan plan_of(const std::vector<Vec3>& points, std::uint64_t most) {
  const PointCloud cloud{.points = points};
  return make_plan(survey(*points_in_memory(cloud), {.points_per_tile = most}), most);
}

TEST(TilePlan, cells_fill_space_once) {
  const TilePlan plan = plan_of(sphere_points(20000).points, 300);
  EXPECT_GE(plan.n_tiles(), 20000u / 300);
  for (std::size_t i = 0; i < 3000; ++i) {
    Vec3 p;
    p.x = 3 * random_uniform(7, 3 * i) - 1.5;
    p.y = 3 * random_uniform(7, 3 * i + 1) - 1.5;
    p.z = 3 * random_uniform(7, 3 * i + 2) - 1.5;
    std::size_t in = 0;
    for (std::size_t k = 0; k < plan.n_tiles(); ++k) {
      const bool is_in = has(plan.cell(k), p);
      in += is_in ? 1 : 0;
      EXPECT_EQ(is_in, plan.tile_of(p) == k);
    }
    EXPECT_EQ(in, 1u);
  }
}

// All points are in the sample: no tile has more than wanted, and cuts leave at least a quarter.
TEST(TilePlan, tiles_have_as_many_points_as_wanted) {
  const std::vector<Vec3> points = sphere_points(50000).points;
  for (const std::uint64_t most : {100, 3000, 30000}) {
    for (const std::size_t n : counts_of(plan_of(points, most), points)) {
      EXPECT_LE(n, most);
      EXPECT_GE(n, most / 4);
    }
  }
}

// With 64 or more samples, the share of a tile has a standard deviation of an eighth.
TEST(TilePlan, tiles_by_a_sample_have_about_as_many) {
  const std::vector<Vec3> points = sphere_points(200000).points;
  const PointCloud cloud{.points = points};
  const Survey found =
      survey(*points_in_memory(cloud), {.points_per_tile = 4000, .least_sample = 1});
  EXPECT_EQ(found.sample.size(), 64u * 50);
  for (const std::size_t n : counts_of(make_plan(found, 4000), points)) EXPECT_LE(n, 4000 * 13 / 8);
}

TEST(TilePlan, is_one_tile_where_that_suffices) {
  const std::vector<Vec3> points = sphere_points(1000).points;
  const TilePlan plan = plan_of(points, 1000);
  EXPECT_EQ(plan.n_tiles(), 1u);
  EXPECT_EQ(plan.tile_of({kNan, 0, 0}), 0u);
  EXPECT_EQ(plan.cell(0).max.x, std::numeric_limits<double>::infinity());
  EXPECT_GT(plan_of(points, 999).n_tiles(), 1u);
}

TEST(TilePlan, depends_on_the_set_of_points_only) {
  const PointCloud cloud = sphere_points(30000);
  const TilePlan a = plan_of(cloud.points, 500);
  const TilePlan b = plan_of(shuffled(cloud).points, 500);
  ASSERT_EQ(a.n_tiles(), b.n_tiles());
  for (std::size_t k = 0; k < a.n_tiles(); ++k) {
    EXPECT_EQ(a.cell(k).min, b.cell(k).min);
    EXPECT_EQ(a.cell(k).max, b.cell(k).max);
  }
}

TEST(TilePlan, points_at_one_place_stay_together) {
  // Half of the points are twins, at most a millionth of the diagonal apart.
  std::vector<Vec3> points = sphere_points(20000).points;
  for (std::size_t i = 0; i < 20000; ++i) {
    Vec3 step;
    step.x = 3e-7 * (random_uniform(8, 3 * i) - 0.5);
    step.y = 3e-7 * (random_uniform(8, 3 * i + 1) - 0.5);
    step.z = 3e-7 * (random_uniform(8, 3 * i + 2) - 0.5);
    points.push_back(points[i] + step);
  }
  const TilePlan plan = plan_of(points, 50);
  const PlaceLattice lattice(bounds(points));
  std::map<std::tuple<double, double, double>, std::size_t> tile_of_place;
  std::size_t shared = 0;
  for (const Vec3& p : points) {
    const Vec3 cell = lattice.cell_of(p);
    const auto [at, is_new] = tile_of_place.insert({{cell.x, cell.y, cell.z}, plan.tile_of(p)});
    if (is_new) continue;
    ++shared;
    EXPECT_EQ(at->second, plan.tile_of(p));
  }
  EXPECT_GT(shared, 3000u);
}

TEST(TilePlan, takes_points_with_equal_coordinates) {
  // A stack of seven dense planes: cuts across it go between planes.
  std::vector<Vec3> planes;
  planes.reserve(7000);
  for (std::size_t i = 0; i < 7000; ++i) {
    planes.push_back({random_uniform(1, i), random_uniform(2, i), static_cast<double>(i % 7)});
  }
  for (const std::size_t n : counts_of(plan_of(planes, 300), planes)) EXPECT_LE(n, 300u);
  // Points on a line, at several places, and at one place.
  std::vector<Vec3> line, places;
  line.reserve(1000), places.reserve(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    line.push_back({0, 0, static_cast<double>(i)});
    places.push_back({static_cast<double>(i % 2), static_cast<double>(i % 3), 0});
  }
  for (const std::size_t n : counts_of(plan_of(line, 10), line)) EXPECT_LE(n, 10u);
  EXPECT_EQ(plan_of(places, 1).n_tiles(), 6u);
  EXPECT_EQ(plan_of(std::vector<Vec3>(100, {1, 2, 3}), 1).n_tiles(), 1u);
  const double huge = 1e308;
  EXPECT_EQ(plan_of({{-huge, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {0, -huge, 0}}, 1).n_tiles(), 4u);
}

TEST(TilePlan, knows_which_tiles_a_box_meets) {
  const TilePlan plan = plan_of(sphere_points(20000).points, 300);
  for (std::size_t i = 0; i < 200; ++i) {
    const auto at = [&](std::size_t k) { return 2.4 * random_uniform(9, 6 * i + k) - 1.2; };
    const Vec3 a{at(0), at(1), at(2)}, b = a + 0.3 * Vec3{at(3) + 1.2, at(4) + 1.2, at(5) + 1.2};
    std::vector<std::size_t> wanted;
    for (std::size_t k = 0; k < plan.n_tiles(); ++k) {
      const Bounds& cell = plan.cell(k);
      if (a.x < cell.max.x && a.y < cell.max.y && a.z < cell.max.z && b.x >= cell.min.x &&
          b.y >= cell.min.y && b.z >= cell.min.z) {
        wanted.push_back(k);
      }
    }
    EXPECT_EQ(plan.tiles_meeting({a, b}), wanted);
  }
}

TEST(PlaceLattice, cells_begin_where_they_say) {
  for (const Vec3& middle : {Vec3{0, 0, 0}, Vec3{1e6, -1e9, 1e-3}}) {
    const PlaceLattice lattice({middle - Vec3{1, 2, 3}, middle + Vec3{1, 2, 3}});
    for (std::size_t i = 0; i < 300; ++i) {
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const double c = middle.*axis + 2 * random_uniform(4, i) - 1;
        const double begin = lattice.begin_of_cell(c, axis);
        EXPECT_LE(begin, c);
        EXPECT_EQ(lattice.cell_of(begin, axis), lattice.cell_of(c, axis));
        EXPECT_LT(lattice.cell_of(std::nextafter(begin, -1e300), axis), lattice.cell_of(c, axis));
      }
    }
  }
}

}  // namespace
}  // namespace rholm
