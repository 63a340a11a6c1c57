// Nearest neighbours. The oracle is the sorted list of all distances.
#include "shape/points/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;

struct Cloud {
  std::string name;
  std::vector<Vec3> points;
};

Vec3 random_point(std::uint64_t seed, std::uint64_t i) {
  return {random_in(-1, 1, seed, 3 * i), random_in(-1, 1, seed, 3 * i + 1),
          random_in(-1, 1, seed, 3 * i + 2)};
}

std::vector<Cloud> clouds() {
  std::vector<Cloud> all = {{"one", {{1, 2, 3}}}, {"two", {{0, 0, 0}, {1, 0, 0}}}};
  Cloud cube{"cube", {}}, sphere{"sphere", {}}, line{"line", {}}, same{"same", {}};
  Cloud isolated{"sphere among isolated points",
                 {}};  // leaves with an isolated point are almost empty
  Cloud lattice{"lattice", {}}, twice{"every place nine times", {}}, uneven{"uneven", {}};
  for (std::uint64_t i = 0; i < 700; ++i) {
    cube.points.push_back(random_point(1, i));
    sphere.points.push_back(random_direction(2, i));
    isolated.points.push_back(i % 10 == 0 ? random_point(8, i) : 0.3 * random_direction(8, i));
    line.points.push_back(random_in(0, 1, 3, i) * Vec3{1, 2, 3});
    same.points.push_back({0.1, 0.2, 0.3});
    const std::uint64_t row = i / 9, layer = i / 81;
    lattice.points.push_back(
        {static_cast<double>(i % 9), static_cast<double>(row % 9), static_cast<double>(layer)});
    twice.points.push_back(random_point(4, i / 9));
    // Clusters have all sizes.
    uneven.points.push_back(std::pow(10.0, -static_cast<double>(i % 5)) * random_point(5, i));
  }
  for (Cloud* cloud : {&cube, &sphere, &isolated, &line, &same, &lattice, &twice, &uneven}) {
    all.push_back(std::move(*cloud));
  }
  for (std::size_t n : {15, 16, 17, 31, 33, 255, 256, 257, 258}) {
    Cloud some{std::to_string(n), {}};
    for (std::uint64_t i = 0; i < n; ++i) some.points.push_back(random_point(6, i));
    all.push_back(std::move(some));
  }
  for (const double scale : {1e-12, 1e12}) {
    Cloud scaled{"times " + std::to_string(scale), {}};
    for (std::uint64_t i = 0; i < 300; ++i) scaled.points.push_back(scale * random_point(7, i));
    all.push_back(std::move(scaled));
  }
  Cloud far{"far away", {}};
  for (std::uint64_t i = 0; i < 300; ++i)
    far.points.push_back(random_point(8, i) + Vec3{1e6, 0, 0});
  all.push_back(std::move(far));
  return all;
}

double extent(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, norm(p - points[0]));
  return 2 * largest;
}

// Returns the k smallest of all distances, sorted.
std::vector<double> sorted_distances(const std::vector<Vec3>& points, const Vec3& x) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Vec3& p : points) distances.push_back(norm(p - x));
  std::sort(distances.begin(), distances.end());
  return distances;
}

// Checks that points are sorted by distance and distinct, and that the distances are correct.
void expect_sound(const PointTree& tree, const std::vector<Vec3>& points, const Vec3& x,
                  const std::vector<Neighbor>& found, double tolerance) {
  std::vector<std::uint32_t> indices;
  for (std::size_t j = 0; j < found.size(); ++j) {
    ASSERT_LT(found[j].index, points.size());
    indices.push_back(found[j].index);
    EXPECT_NEAR(std::sqrt(static_cast<double>(found[j].distance2)),
                norm(points[tree.order()[found[j].index]] - x), tolerance);
    if (j == 0) continue;
    EXPECT_LE(found[j - 1].distance2, found[j].distance2);
    // Points at the same place are sorted by index.
    const Vec3 before = tree.point(found[j - 1].index), own = tree.point(found[j].index);
    if (before == own) {
      EXPECT_LT(found[j - 1].index, found[j].index);
    }
  }
  std::sort(indices.begin(), indices.end());
  EXPECT_EQ(std::unique(indices.begin(), indices.end()), indices.end());
}

// Coordinates have single precision: of two distances closer than it, either may come first. Three
// coordinates of two points have errors of half a unit in 2^24 of half the extent.
double rounding(const std::vector<Vec3>& points, const Vec3& x) {
  return 0x1p-22 * (extent(points) + norm(x - points[0]));
}

TEST(PointTree, nearest_points_are_those_of_brute_force) {
  test::for_each_target([](const char* target) {
    for (const Cloud& cloud : clouds()) {
      SCOPED_TRACE(std::string(target) + " " + cloud.name);
      const PointTree tree(cloud.points);
      const double size = extent(cloud.points);
      std::vector<Neighbor> found;
      for (std::uint64_t i = 0; i < 12; ++i) {
        // Query points are at a point, near one, among the points, and far away.
        const Vec3 at = cloud.points[i * 7 % cloud.points.size()];
        const double away = i % 4 == 0 ? 0 : i % 4 == 1 ? 1e-3 : i % 4 == 2 ? 0.3 : 50;
        const Vec3 x = at + away * size * random_point(9, i);
        const double tolerance = rounding(cloud.points, x);
        const std::vector<double> expected = sorted_distances(cloud.points, x);
        for (const std::size_t k : {1, 2, 8, 24, 100, 5000}) {
          tree.nearest(x, k, found);
          ASSERT_EQ(found.size(), std::min<std::size_t>(k, cloud.points.size()));
          expect_sound(tree, cloud.points, x, found, tolerance);
          EXPECT_NEAR(std::sqrt(static_cast<double>(found.back().distance2)),
                      expected[found.size() - 1], tolerance);
        }
      }
    }
  });
}

TEST(PointTree, of_any_number_of_points_finds_those_of_brute_force) {
  test::for_each_target([](const char* target) {
    std::vector<Vec3> points;
    std::vector<Neighbor> found;
    for (std::uint64_t n = 1; n <= 33; ++n) {
      SCOPED_TRACE(std::string(target) + " " + std::to_string(n));
      points.push_back(random_point(5, n));
      const PointTree tree(points);
      const Vec3 x = random_point(6, n);
      const double tolerance = n == 1 ? 1e-6 : rounding(points, x);
      const std::vector<double> expected = sorted_distances(points, x);
      for (std::size_t k = 1; k <= n; ++k) {
        tree.nearest(x, k, found);
        ASSERT_EQ(found.size(), k);
        expect_sound(tree, points, x, found, tolerance);
        EXPECT_NEAR(std::sqrt(static_cast<double>(found.back().distance2)), expected[k - 1],
                    tolerance);
        // The radius lies between this distance and the next.
        if (k == n || expected[k] - expected[k - 1] < 4 * tolerance) continue;
        tree.within(x, (expected[k - 1] + expected[k]) / 2, found);
        EXPECT_EQ(found.size(), k);
      }
    }
  });
}

TEST(PointTree, the_nearest_within_a_radius_is_the_first_of_the_nearest) {
  for (const Cloud& cloud : clouds()) {
    const PointTree tree(cloud.points);
    Vec3 lower = cloud.points[0], upper = lower;
    for (const Vec3& p : cloud.points) {
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    test::for_each_target([&](const char* target) {
      SCOPED_TRACE(cloud.name + " " + target);
      std::vector<Neighbor> nearest;
      for (std::uint64_t i = 0; i < 50; ++i) {
        const Vec3 part = random_point(9, i), size = upper - lower;
        const Vec3 x =
            0.5 * (lower + upper) + Vec3{part.x * size.x, part.y * size.y, part.z * size.z};
        tree.nearest(x, 1, nearest);
        const double away = std::sqrt(double{nearest[0].distance2});
        Neighbor found{};
        ASSERT_TRUE(tree.nearest_within(x, 1.001 * away + 1e-6 * norm(size), found));
        EXPECT_EQ(found.index, nearest[0].index);
        EXPECT_EQ(found.distance2, nearest[0].distance2);
        if (away > 1e-3 * norm(size)) {
          EXPECT_FALSE(tree.nearest_within(x, 0.999 * away, found));
        }
      }
    });
  }
}

TEST(PointTree, nearest_to_a_point_starts_with_its_place) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const PointTree tree(cloud.points);
    std::vector<Neighbor> found, same;
    for (std::size_t i = 0; i < cloud.points.size(); i += 13) {
      const Vec3 x = cloud.points[tree.order()[i]];
      const double tolerance = rounding(cloud.points, x);
      const std::vector<double> expected = sorted_distances(cloud.points, x);
      for (const std::size_t k : {1, 9, 24, 300}) {
        tree.nearest_to(i, k, found);
        ASSERT_EQ(found.size(), std::min<std::size_t>(k, cloud.points.size()));
        EXPECT_EQ(found[0].distance2, 0);
        expect_sound(tree, cloud.points, x, found, tolerance);
        EXPECT_NEAR(std::sqrt(static_cast<double>(found.back().distance2)),
                    expected[found.size() - 1], tolerance);
      }
    }
  }
}

TEST(PointTree, within_a_radius_is_everything_within_it) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const PointTree tree(cloud.points);
    const double size = extent(cloud.points);
    std::vector<Neighbor> found;
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Vec3 x = cloud.points[i * 11 % cloud.points.size()] + 0.1 * size * random_point(10, i);
      const double tolerance = rounding(cloud.points, x);
      const double radius = (0.02 + 0.1 * static_cast<double>(i)) * size + 2 * tolerance;
      tree.within(x, radius, found);
      std::vector<char> is_found(cloud.points.size(), 0);
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (j > 0) {
          EXPECT_LT(found[j - 1].index, found[j].index);
        }
        is_found[tree.order()[found[j].index]] = 1;
      }
      for (std::size_t p = 0; p < cloud.points.size(); ++p) {
        const double d = norm(cloud.points[p] - x);
        if (std::abs(d - radius) > tolerance) {
          EXPECT_EQ(is_found[p] != 0, d < radius);
        }
      }
    }
  }
}

TEST(PointTree, order_is_a_permutation_and_leaves_cut_it) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const PointTree tree(cloud.points);
    std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
    ASSERT_EQ(tree.size(), cloud.points.size());
    EXPECT_EQ(tree.leaf_begin(0), 0U);
    EXPECT_EQ(tree.leaf_begin(tree.n_leaves()), tree.size());
    for (std::size_t i = 0; i < tree.size(); ++i) {
      EXPECT_LE(norm(tree.point(i) - cloud.points[tree.order()[i]]),
                rounding(cloud.points, cloud.points[0]));
    }
  }
}

TEST(PointTree, of_nothing_finds_nothing) {
  Neighbor none{};
  EXPECT_FALSE(PointTree(std::vector<Vec3>()).nearest_within({0, 0, 0}, 1, none));
  const PointTree tree(std::span<const Vec3>{});
  std::vector<Neighbor> found(3);
  tree.nearest({1, 2, 3}, 5, found);
  EXPECT_TRUE(found.empty());
  tree.within({1, 2, 3}, 5, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(tree.size(), 0U);
}

TEST(PointTree, finds_the_nearest_points_of_places_however_far) {
  const std::vector<Vec3> points = {{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}};
  const PointTree tree(points);
  std::vector<Neighbor> found;
  for (const double far : {1e7, 1e20, 1e150, 1e308}) {
    tree.nearest({0, -far, 0}, 2, found);
    ASSERT_EQ(found.size(), 2U) << far;
    tree.nearest({far, 0, far}, 4, found);
    EXPECT_EQ(found.size(), 4U) << far;
  }
}

TEST(PointTree, is_the_same_for_every_number_of_threads) {
  std::vector<Vec3> points;
  points.reserve(20000);
  for (std::uint64_t i = 0; i < 20000; ++i) points.push_back(random_direction(11, i));
  const PointTree one(points, {.threads = 1}), two(points, {.threads = 2});
  EXPECT_TRUE(std::equal(one.order().begin(), one.order().end(), two.order().begin()));
}

}  // namespace
}  // namespace rholm
