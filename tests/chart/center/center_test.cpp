// Centres with a known answer, and laws that centres obey.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "support/random_data.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using test::l_prism;
using test::moved;
using test::prism;
using test::random_direction;
using test::rotation;
using test::tetrahedron;

StarReport center_of(const Mesh& mesh, CenterKind kind, int threads = 1) {
  return find_center(mesh, {.kind = kind, .point = {}, .rays = 0},
                     {.threads = threads, .progress = {}});
}

double min_d(const Mesh& mesh, const Vec3& center) {
  return check_star(mesh, center, 0, {.threads = 1, .progress = {}}).min_d;
}

double min_cos(const Mesh& mesh, const Vec3& center) {
  return check_star(mesh, center, 0, {.threads = 1, .progress = {}}).min_cos_gamma;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// The search ends with bounds 1e-12 apart in the unit frame; two units are a diagonal.
constexpr double kGap = 4e-12;

TEST(kernel_center, of_a_box_is_its_middle_with_half_the_shortest_edge) {
  for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{4, 2, 1}, Vec3{0.1, 3, 0.1}}) {
    for (const int n : {1, 6}) {
      const StarReport report = center_of(box(size, n), CenterKind::kKernel);
      EXPECT_NEAR(report.min_d, 0.5 * std::min({size.x, size.y, size.z}), kGap);
      expect_near(report.center, {0, 0, 0}, 1e-9);
      EXPECT_TRUE(report.star_shaped);
    }
  }
}

TEST(kernel_center, of_a_turned_box_is_still_its_middle) {
  const Mesh mesh = moved(box({4, 2, 1}, 3), rotation({1, 2, 3}, 0.7));
  expect_near(center_of(mesh, CenterKind::kKernel).center, {0, 0, 0}, 1e-9);
}

// The inradius is 3 volume / area.
TEST(kernel_center, of_a_tetrahedron_is_the_centre_of_its_inscribed_ball) {
  const double r = 0.5 / (1.5 + std::sqrt(3) / 2);
  const StarReport report = center_of(tetrahedron(), CenterKind::kKernel);
  EXPECT_NEAR(report.min_d, r, kGap);
  expect_near(report.center, {r, r, r}, 10 * kGap);
}

TEST(kernel_center, of_an_l_is_the_middle_of_its_corner_though_the_centroid_is_outside_the_kernel) {
  for (const double height : {0.5, 1.0, 6.0}) {
    const Mesh mesh = l_prism(height);
    const StarReport report = center_of(mesh, CenterKind::kKernel);
    EXPECT_NEAR(report.min_d, 0.5 * std::min(height, 1.0), kGap);
    expect_near(report.center, {0.5, 0.5, 0}, 1e-9);
    EXPECT_TRUE(report.star_shaped);
    EXPECT_FALSE(report.center_fell_back);
    // Two arms of 4 and 3 unit squares: both coordinates of the centroid are (4 * 2 + 3 * 0.5) / 7.
    const Vec3 centroid = inspect(mesh).volume_centroid;
    expect_near(centroid, {9.5 / 7, 9.5 / 7, 0}, 1e-14);
    EXPECT_NEAR(min_d(mesh, centroid), 1 - 9.5 / 7, 1e-14);
  }
}

// The kernel of a five-pointed star is bounded by the lines of its edges.
TEST(kernel_center, of_a_star_prism_has_the_distance_of_the_edges_lines) {
  const double outer = 1, inner = 0.5, step = std::numbers::pi / 5;
  std::vector<test::Point2> polygon;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? outer : inner;
    polygon.push_back({r * std::cos(i * step), r * std::sin(i * step)});
  }
  const double distance =
      outer * inner * std::sin(step) /
      std::sqrt(outer * outer + inner * inner - 2 * outer * inner * std::cos(step));
  const StarReport report = center_of(prism(polygon, {0, 0}, 2), CenterKind::kKernel);
  EXPECT_NEAR(report.min_d, distance, kGap);
  expect_near(report.center, {0, 0, 0}, 1e-9);
}

// The smallest d_T is a concave function of the centre: a local maximum is the global maximum.
TEST(kernel_center, cannot_be_improved_by_moving_it) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = bumpy_sphere(4, 0.3, seed);
    const StarReport report = center_of(mesh, CenterKind::kKernel);
    ASSERT_TRUE(report.star_shaped);
    for (const double step : {1e-6, 1e-3, 0.1}) {
      for (int i = 0; i < 60; ++i) {
        const Vec3 other = report.center + step * random_direction(seed, i);
        EXPECT_LE(min_d(mesh, other), report.min_d + kGap);
      }
    }
  }
}

// For s > 0 the centres with cos gamma > s form a convex set: a local maximum is the global one.
void expect_best_cosine_nearby(const Mesh& mesh, const StarReport& report) {
  for (const double step : {1e-5, 1e-3, 0.1}) {
    for (int i = 0; i < 60; ++i) {
      const Vec3 other = report.center + step * random_direction(1, i);
      EXPECT_LE(min_cos(mesh, other), report.min_cos_gamma * (1 + 2e-6));
    }
  }
}

TEST(cosine_center, cannot_be_improved_by_moving_it) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = bumpy_sphere(4, 0.3, seed);
    const StarReport report = center_of(mesh, CenterKind::kCosine);
    ASSERT_GT(report.min_cos_gamma, 0);
    EXPECT_GE(report.min_cos_gamma, center_of(mesh, CenterKind::kKernel).min_cos_gamma);
    expect_best_cosine_nearby(mesh, report);
  }
}

// By symmetry the centre is the middle. The cosine at corners is (half shortest) / (half diagonal).
TEST(cosine_center, of_a_box_is_its_middle) {
  for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{4, 2, 1}, Vec3{1, 1, 20}}) {
    const StarReport report = center_of(box(size, 2), CenterKind::kCosine);
    EXPECT_NEAR(report.min_cos_gamma, std::min({size.x, size.y, size.z}) / norm(size), 1e-6);
  }
}

// An exhaustive search on ever finer grids around the best point so far. Each grid is moved until
// its middle is the best point.
double best_cosine_by_grid(const Mesh& mesh, Vec3 center, double reach) {
  double best = min_cos(mesh, center);
  while (reach > 1e-6) {
    const Vec3 middle = center;
    for (int i = -5; i <= 5; ++i) {
      for (int j = -5; j <= 5; ++j) {
        for (int k = -5; k <= 5; ++k) {
          const Vec3 other = middle + reach / 5 * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
          const double value = min_cos(mesh, other);
          if (value > best) {
            best = value;
            center = other;
          }
        }
      }
    }
    if (center == middle) reach *= 0.5;
  }
  return best;
}

TEST(cosine_center, is_not_beaten_by_an_exhaustive_search) {
  const Mesh shapes[] = {l_prism(2), moved(tetrahedron(), rotation({1, 1, 0}, 1)),
                         prism({{0, 0}, {6, 0}, {1, 1}, {0, 2}}, {0.5, 0.5}, 3),
                         bumpy_sphere(1, 0.4, 3)};
  for (const Mesh& mesh : shapes) {
    const StarReport report = center_of(mesh, CenterKind::kCosine);
    const Vec3 start = center_of(mesh, CenterKind::kKernel).center;
    const double grid = best_cosine_by_grid(mesh, start, 1);
    EXPECT_GE(report.min_cos_gamma, grid * (1 - 2e-6));
    expect_best_cosine_nearby(mesh, report);  // the grid may stop on a ridge slightly below
  }
}

// Computes int |grad_S r|^2 dOmega as a sum over the middles of small parts of the faces.
double slope_by_pieces(const Mesh& mesh, const Vec3& center) {
  constexpr int kPieces = 12;  // per edge
  double sum = 0;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const Triangle& corners = mesh.faces[t];
    const Vec3 a = mesh.vertices[corners[0]], b = mesh.vertices[corners[1]];
    const Vec3 c = mesh.vertices[corners[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double area = norm(normal) / 2 / (kPieces * kPieces);
    for (int i = 0; i < kPieces; ++i) {
      for (int j = 0; j < kPieces - i; ++j) {
        for (const double third : {1.0, 2.0}) {  // upright parts, and parts upside down
          if (third == 2 && i + j + 1 >= kPieces) continue;
          const double u = (i + third / 3) / kPieces, v = (j + third / 3) / kPieces;
          const Vec3 m = a + u * (b - a) + v * (c - a) - center;
          const double cosine = dot(normalized(normal), m) / norm(m);
          sum += area * (1 / cosine - cosine);
        }
      }
    }
  }
  return sum;
}

TEST(slope_center, keeps_the_symmetries_of_the_body) {
  for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{4, 2, 1}}) {
    expect_near(center_of(box(size, 2), CenterKind::kSlope).center, {0, 0, 0}, 1e-9);
  }
  const Vec3 of_tetrahedron = center_of(tetrahedron(), CenterKind::kSlope).center;
  expect_near(of_tetrahedron, Vec3{1, 1, 1} * of_tetrahedron.x, 1e-12);
  const Vec3 of_l = center_of(l_prism(2), CenterKind::kSlope).center;
  expect_near(of_l, {of_l.x, of_l.x, 0}, 1e-9);
}

// On the line from the centre of the kernel through the centroid no other point has less slope.
TEST(slope_center, has_the_least_slope_on_its_line) {
  for (const Mesh& mesh : {tetrahedron(), l_prism(2), test::random_octahedron(4)}) {
    const StarReport kernel = center_of(mesh, CenterKind::kKernel);
    ASSERT_TRUE(kernel.star_shaped);
    const StarReport found = center_of(mesh, CenterKind::kSlope);
    const Vec3 way = inspect(mesh).volume_centroid - kernel.center;
    EXPECT_LT(norm(cross(found.center - kernel.center, way)), 1e-9);
    // The sums use so few points on so few faces that they are not exact.
    const double least = slope_by_pieces(mesh, found.center);
    for (double t = -1; t <= 2; t += 0.1) {
      const Vec3 other = kernel.center + t * way;
      if (min_d(mesh, other) < 0.25 * kernel.min_d) continue;
      EXPECT_LT(least, 1.02 * slope_by_pieces(mesh, other)) << t;
    }
  }
  // The arms of an L are seen at small angles from the centre of its kernel.
  const Mesh l = l_prism(2);
  EXPECT_LT(slope_by_pieces(l, center_of(l, CenterKind::kSlope).center),
            0.99 * slope_by_pieces(l, center_of(l, CenterKind::kKernel).center));
}

// The search starts with a sample of the faces, which depends on the order of the faces.
TEST(slope_center, does_not_depend_on_the_order_of_faces_and_corners) {
  Mesh drawn_out = bumpy_sphere(5, 0.3, 3);  // its centre is at the end of the allowed segment
  for (Vec3& v : drawn_out.vertices) v = (1 + 5 * std::pow(std::max(0.0, v.x), 6)) * v;
  Mesh lopsided = bumpy_sphere(5, 0.3, 3);  // centroid and centre of the kernel are far apart
  for (Vec3& v : lopsided.vertices) v = (1 + std::pow(std::max(0.0, v.x), 3)) * v;
  for (const Mesh& mesh : {bumpy_sphere(6, 0.3), lopsided, drawn_out}) {
    const StarReport in_order = center_of(mesh, CenterKind::kSlope);
    EXPECT_GT(norm(in_order.center - center_of(mesh, CenterKind::kKernel).center), 1e-3);
    for (const std::uint64_t seed : {1, 2, 3}) {
      Mesh other = mesh;
      for (std::size_t i = other.faces.size() - 1; i > 0; --i) {
        std::swap(other.faces[i], other.faces[random_bits(seed, i) % (i + 1)]);
      }
      for (std::size_t i = 0; i < other.faces.size(); i += 2) {
        Triangle& t = other.faces[i];
        t = {t[1], t[2], t[0]};
      }
      expect_near(center_of(other, CenterKind::kSlope).center, in_order.center, 1e-8);
      const test::Motion turn = rotation({1, -2, 0.5}, 0.3 + static_cast<double>(seed));
      expect_near(center_of(moved(other, turn), CenterKind::kSlope).center, turn(in_order.center),
                  1e-8);
    }
  }
}

// A long bump moves the centroid to the border of the kernel or beyond it.
TEST(slope_center, stays_a_quarter_of_the_kernel_within_it) {
  std::vector<Mesh> shapes = {l_prism(0.5), l_prism(6)};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    shapes.push_back(bumpy_sphere(3, 0.3, seed));
    for (Vec3& v : shapes.back().vertices) v = (1 + 5 * std::pow(std::max(0.0, v.x), 6)) * v;
  }
  int at_margin = 0;
  for (const Mesh& mesh : shapes) {
    const StarReport kernel = center_of(mesh, CenterKind::kKernel);
    ASSERT_TRUE(kernel.star_shaped);
    for (const CenterKind kind : {CenterKind::kSlope, CenterKind::kVolume}) {
      const StarReport found = center_of(mesh, kind);
      EXPECT_TRUE(found.star_shaped);
      const bool is_centroid = norm(found.center - inspect(mesh).volume_centroid) < 1e-12;
      if (kind == CenterKind::kVolume && is_centroid) continue;
      EXPECT_GE(found.min_d, 0.25 * kernel.min_d - kGap);
      at_margin += found.min_d < 0.2501 * kernel.min_d;
    }
  }
  EXPECT_GT(at_margin, 0);
}

TEST(volume_center, of_an_l_is_within_the_kernel_as_the_centroid_is_not) {
  for (const double height : {0.5, 1.0, 6.0}) {
    const StarReport report = center_of(l_prism(height), CenterKind::kVolume);
    EXPECT_TRUE(report.star_shaped);
    EXPECT_FALSE(report.center_fell_back);
    EXPECT_EQ(report.center, center_of(l_prism(height), CenterKind::kSlope).center);
  }
}

TEST(volume_center, is_the_centroid_itself_where_all_faces_show_their_front) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = bumpy_sphere(3, 0.3, seed);
    const Vec3 centroid = inspect(mesh).volume_centroid;
    const StarReport report = center_of(mesh, CenterKind::kVolume);
    ASSERT_TRUE(report.star_shaped);
    if (min_d(mesh, centroid) > 0) {
      expect_near(report.center, centroid, 1e-13);
    } else {
      ++apart;
      EXPECT_EQ(report.center, center_of(mesh, CenterKind::kSlope).center);
    }
  }
  EXPECT_LT(apart, 6);
}

TEST(centers, move_turn_and_grow_with_the_shape) {
  const Mesh mesh = bumpy_sphere(3, 0.3, 2);
  for (const CenterKind kind : {CenterKind::kSlope, CenterKind::kKernel, CenterKind::kCosine,
                                CenterKind::kCentroid, CenterKind::kVolume}) {
    const StarReport report = center_of(mesh, kind);
    for (const double scale : {1e-30, 0.3, 1e30}) {
      test::Motion motion = rotation({1, -2, 0.5}, 2.5);
      motion.scale = scale;
      motion.shift = scale * Vec3{3, -4, 5};
      const StarReport other = center_of(moved(mesh, motion), kind);
      // The cosine is promised to 1e-6. Its maximum is sharp here, so that the centre is as
      // accurate.
      const double tolerance = kind == CenterKind::kCosine ? 1e-5 : 1e-10;
      expect_near(other.center / scale, motion(report.center) / scale, tolerance);
      EXPECT_NEAR(other.min_d / scale, report.min_d, tolerance);
      EXPECT_NEAR(other.min_cos_gamma, report.min_cos_gamma, tolerance);
    }
  }
}

TEST(centers, are_found_at_the_ends_of_the_range_of_doubles) {
  for (const double scale : {1e-300, 1e300}) {
    const Mesh mesh = moved(tetrahedron(), {.scale = scale, .shift = {}});
    for (const CenterKind kind : {CenterKind::kSlope, CenterKind::kKernel, CenterKind::kCosine}) {
      const StarReport report = center_of(mesh, kind);
      EXPECT_TRUE(report.star_shaped) << scale;
      const double expected = center_of(tetrahedron(), kind).min_d;
      EXPECT_NEAR(report.min_d / scale, expected, 1e-5);
    }
  }
}

TEST(centers, are_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = bumpy_sphere(5, 0.3, 4);
  for (const CenterKind kind : {CenterKind::kSlope, CenterKind::kKernel, CenterKind::kCosine}) {
    const StarReport one = center_of(mesh, kind, 1);
    for (const int threads : {2, 4}) {
      const StarReport other = center_of(mesh, kind, threads);
      EXPECT_EQ(one.center, other.center);
      EXPECT_EQ(one.min_d, other.min_d);
      EXPECT_EQ(one.min_cos_gamma, other.min_cos_gamma);
    }
  }
}

TEST(centers, kinds_name_the_point_they_mean) {
  const Mesh mesh = moved(tetrahedron(), {.shift = {1, 2, 3}});
  expect_near(center_of(mesh, CenterKind::kNone).center, {0, 0, 0}, 0);
  expect_near(center_of(mesh, CenterKind::kVolume).center, {1.25, 2.25, 3.25}, 1e-15);
  // Three right triangles of area 1/2 have centroids at 1/3, one of sqrt(3)/2 at (1, 1, 1)/3.
  const double c = (2 * 0.5 + std::sqrt(3) / 2) / 3 / (1.5 + std::sqrt(3) / 2);
  expect_near(center_of(mesh, CenterKind::kCentroid).center, {1 + c, 2 + c, 3 + c}, 1e-15);
  const CenterOptions given{.kind = CenterKind::kGiven, .point = {1.1, 2.2, 3.3}, .rays = 0};
  EXPECT_EQ(find_center(mesh, given).center, (Vec3{1.1, 2.2, 3.3}));
}

TEST(parse_center, reads_names_and_points) {
  EXPECT_EQ(parse_center("auto").kind, CenterKind::kAuto);
  EXPECT_EQ(parse_center("slope").kind, CenterKind::kSlope);
  EXPECT_EQ(parse_center("kernel").kind, CenterKind::kKernel);
  EXPECT_EQ(parse_center("cosine").kind, CenterKind::kCosine);
  EXPECT_EQ(parse_center("none").kind, CenterKind::kNone);
  EXPECT_EQ(parse_center("centroid").kind, CenterKind::kCentroid);
  EXPECT_EQ(parse_center("volume").kind, CenterKind::kVolume);
  const CenterOptions given = parse_center("1,-2.5e3, +.5");
  EXPECT_EQ(given.kind, CenterKind::kGiven);
  EXPECT_EQ(given.point, (Vec3{1, -2500, 0.5}));
  for (const CenterKind kind :
       {CenterKind::kSlope, CenterKind::kKernel, CenterKind::kCosine, CenterKind::kVolume}) {
    EXPECT_EQ(parse_center(to_string(kind)).kind, kind);
  }
}

TEST(parse_center, refuses_everything_else) {
  for (const char* text : {"", "Auto", "1,2", "1,2,3,4", "1,2,", "1;2;3", "nan,0,0", "0,inf,0",
                           "1e999,0,0", "1,2,3 ", ",,", "+-1,2,3"}) {
    try {
      parse_center(text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    }
  }
}

}  // namespace
}  // namespace rholm
