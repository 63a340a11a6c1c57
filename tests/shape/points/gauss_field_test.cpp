// Gauss's integral over points, with its adjoint and its gradient.
#include "shape/points/gauss_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/random_data.h"
#include "support/targets.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::random_direction;
using test::random_in;

// Random points in a cube, in the order of their tree, with normals and widths of all sizes.
struct Scene {
  explicit Scene(std::size_t n) : tree(make_points(n)) {
    const std::vector<Vec3> given = make_points(n);
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back(given[tree.order()[i]]);
      normals.push_back(random_in(0.5, 1, 2, i) * random_direction(3, i));
      charges.push_back(random_in(-1, 1, 4, i));
      widths.push_back(0.05);
    }
    areas.assign(n, 1.0);
  }
  static std::vector<Vec3> make_points(std::size_t n) {
    std::vector<Vec3> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back({random_in(-1, 1, 1, 3 * i), random_in(-1, 1, 1, 3 * i + 1),
                        random_in(-1, 1, 1, 3 * i + 2)});
    }
    return points;
  }
  GaussField field() const {
    GaussField result(tree, points, areas, {});
    result.set_widths(widths);
    return result;
  }
  // Returns w by its definition.
  double winding(const Vec3& x) const {
    double sum = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Vec3 r = points[j] - x;
      sum += dot(normals[j], r) / std::pow(std::max(norm(r), widths[j]), 3);
    }
    return sum / (4 * pi);
  }
  Vec3 adjoint(std::size_t j) const {
    Vec3 sum;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 r = points[j] - points[i];
      sum += charges[i] / std::pow(std::max(norm(r), widths[j]), 3) * r;
    }
    return sum / (4 * pi);
  }

  PointTree tree;
  std::vector<Vec3> points, normals;
  std::vector<double> charges, widths, areas;
};

// Returns the largest absolute value. Errors of single precision and of far sets are relative to
// it.
template <typename Value>
double largest(const std::vector<Value>& values) {
  double most = 0;
  for (const Value& v : values) {
    if constexpr (std::is_same_v<Value, Vec3>) {
      most = std::max(most, norm(v));
    } else {
      most = std::max(most, std::abs(v));
    }
  }
  return most;
}

TEST(GaussField, is_the_direct_sum_in_one_leaf_with_every_instruction_set) {
  for (const std::size_t n : {1u, 2u, 3u, 7u, 13u}) {
    const Scene scene(n);
    test::for_each_target([&](const char* target) {
      const GaussField field = scene.field();
      const std::vector<double> w = field.winding(scene.normals, {});
      const std::vector<Vec3> g = field.adjoint(scene.charges, {});
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(w[i], scene.winding(scene.points[i]), 1e-5 * largest(w) + 1e-12) << target;
        EXPECT_LT(norm(g[i] - scene.adjoint(i)), 1e-5 * largest(g) + 1e-12) << target;
      }
    });
  }
}

// The bound has a margin for sets that are combined: their first moments are omitted.
TEST(GaussField, is_near_the_direct_sum_of_many_points) {
  const Scene scene(3001);
  const GaussField field = scene.field();
  const std::vector<double> w = field.winding(scene.normals, {});
  const std::vector<Vec3> g = field.adjoint(scene.charges, {});
  double off = 0, off_adjoint = 0, size = 0, size_adjoint = 0;
  for (std::size_t i = 0; i < w.size(); i += 7) {
    const double expected = scene.winding(scene.points[i]);
    const Vec3 adjoint = scene.adjoint(i);
    off += std::pow(w[i] - expected, 2), size += expected * expected;
    off_adjoint += std::pow(norm(g[i] - adjoint), 2), size_adjoint += dot(adjoint, adjoint);
  }
  EXPECT_LT(std::sqrt(off / size), 0.05);
  EXPECT_LT(std::sqrt(off_adjoint / size_adjoint), 0.05);
}

TEST(GaussField, adjoint_is_adjoint) {
  for (const std::size_t n : {9u, 700u}) {
    const Scene scene(n);
    const GaussField field = scene.field();
    const std::vector<double> w = field.winding(scene.normals, {});
    const std::vector<Vec3> g = field.adjoint(scene.charges, {});
    double left = 0, right = 0, scale = 0;
    for (std::size_t i = 0; i < n; ++i) {
      left += scene.charges[i] * w[i];
      right += dot(g[i], scene.normals[i]);
      scale += std::abs(scene.charges[i] * w[i]);
    }
    EXPECT_NEAR(left, right, (n < 16 ? 1e-5 : 0.02) * scale);
  }
}

TEST(GaussField, fall_is_minus_the_gradient) {
  const Scene scene(11);
  std::vector<Vec3> places;
  for (std::size_t i = 0; places.size() < 40; ++i) {
    const Vec3 x = 1.5 * random_direction(8, i);
    const bool clear = std::all_of(scene.points.begin(), scene.points.end(),
                                   [&](const Vec3& p) { return norm(p - x) > 0.3; });
    if (clear) places.push_back(x);
  }
  const PointTree tree(places);
  std::vector<Vec3> ordered;
  for (const std::uint32_t i : tree.order()) ordered.push_back(places[i]);
  const std::vector<double> widths(places.size(), 0.05);
  test::for_each_target([&](const char* target) {
    const std::vector<Vec3> fall = scene.field().fall_at(tree, ordered, widths, scene.normals, {});
    const double h = 1e-5;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
      const auto along = [&](const Vec3& u) {
        return (scene.winding(ordered[i] - h * u) - scene.winding(ordered[i] + h * u)) / (2 * h);
      };
      const Vec3 expected = {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
      EXPECT_LT(norm(fall[i] - expected), 1e-4 * largest(fall)) << target;
    }
  });
}

TEST(GaussField, of_a_sphere_is_a_half_at_its_points_and_falls_outwards) {
  const std::size_t n = 4000;
  const PointCloud cloud = test::sphere_points(n);
  const PointTree tree(cloud.points);
  std::vector<Vec3> points, area_normals;
  for (const std::uint32_t i : tree.order()) {
    points.push_back(cloud.points[i]);
    area_normals.push_back(4 * pi / n * cloud.points[i]);
  }
  GaussField field(tree, points, std::vector<double>(n, 4 * pi / n), {});
  field.set_widths(std::vector<double>(n, 2 * std::sqrt(4 * pi / n)));
  double mean = 0;
  for (const double w : field.winding(area_normals, {})) mean += w / n;
  // Within s = 2 spacings = 0.112 the sphere contributes 1 / (2 r) to the sum, s / 4 of w, of which
  // patches of that width keep a quarter. A point's own patch, spacing / (4 sqrt(pi)), contributes
  // nothing.
  EXPECT_NEAR(mean, 0.5 - 0.75 * 0.112 / 4 - 0.056 / (4 * std::sqrt(pi)), 0.01);
  const std::vector<Vec3> fall = field.fall(area_normals, {});
  for (std::size_t i = 0; i < n; ++i) EXPECT_GT(dot(normalized(fall[i]), points[i]), 0.95);
}

TEST(GaussField, is_the_same_for_any_number_of_threads) {
  const Scene scene(5000);
  const GaussField field = scene.field();
  EXPECT_EQ(field.winding(scene.normals, {.threads = 1}),
            field.winding(scene.normals, {.threads = 3}));
  EXPECT_EQ(field.adjoint(scene.charges, {.threads = 1}),
            field.adjoint(scene.charges, {.threads = 3}));
  EXPECT_EQ(field.fall(scene.normals, {.threads = 1}), field.fall(scene.normals, {.threads = 3}));
}

}  // namespace
}  // namespace rholm
