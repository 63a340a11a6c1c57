#include "rholm/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/executor_by.h"
#include "surface/star/area_samples.h"
#include "surface/star/compare_samples.h"

namespace rholm {
namespace {

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

double triangle_area(const Mesh& mesh, const Triangle& t) {
  const std::vector<Vec3>& v = mesh.vertices;
  return norm(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]])) / 2;
}

// --- Samples -------------------------------------------------------------------------------

// A triangle that has a of n shares of area gets between a - 2 and a + 2 samples: only the shares
// at its two ends are uncertain.
TEST(sample_by_area, gives_every_triangle_its_share) {
  const Mesh mesh = bumpy_sphere(2, 0.5);
  const std::size_t n = 20000;
  const AreaSamples samples = sample_by_area(mesh, n, 3);
  ASSERT_EQ(samples.points.size(), n);
  double area = 0;
  for (const Triangle& t : mesh.faces) area += triangle_area(mesh, t);
  std::vector<int> count(mesh.faces.size());
  for (const std::uint32_t t : samples.faces) ++count[t];
  for (std::size_t t = 0; t < count.size(); ++t) {
    EXPECT_NEAR(count[t], n * triangle_area(mesh, mesh.faces[t]) / area, 2);
  }
}

// In one triangle samples are uniform. Mean, squares and products of barycentric coordinates have
// the means 1/3, 1/6 and 1/12, with deviations below 1/4. The bound is six deviations.
TEST(sample_by_area, is_uniform_within_a_triangle) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}};
  const std::size_t n = 100000;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Vec3& p : sample_by_area(mesh, n, 1).points) {
    ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 + 1e-15);
    x += p.x / n;
    y += p.y / n;
    xx += p.x * p.x / n;
    xy += p.x * p.y / n;
  }
  const double tolerance = 6 * 0.25 / std::sqrt(1.0 * n);
  EXPECT_NEAR(x, 1 / 3.0, tolerance);
  EXPECT_NEAR(y, 1 / 3.0, tolerance);
  EXPECT_NEAR(xx, 1 / 6.0, tolerance);
  EXPECT_NEAR(xy, 1 / 12.0, tolerance);
}

TEST(sample_by_area, passes_over_triangles_without_area) {
  Mesh mesh = box({1, 1, 1});
  mesh.faces.insert(mesh.faces.begin(), {0, 0, 1});
  mesh.faces.push_back({2, 3, 3});
  const auto last = static_cast<std::uint32_t>(mesh.faces.size() - 1);
  for (const std::uint32_t t : sample_by_area(mesh, 5000, 1).faces) {
    ASSERT_TRUE(t != 0 && t != last);
  }
}

TEST(AreaSampling, gives_any_range_of_the_samples_by_itself) {
  Mesh mesh = bumpy_sphere(2, 0.5);
  for (std::size_t t = 0; t < 40; ++t) mesh.faces[t] = {0, 0, 1};  // without area
  for (const std::size_t n : {1u, 5u, 3000u}) {
    const AreaSamples all = sample_by_area(mesh, n, 3);
    AreaSum sum(unit_frame(bounds(mesh.vertices)).scale);
    const std::vector<double> sums = sum.add(mesh);
    const AreaSampling sampling{sum.value(), n, 3};
    for (const std::size_t count : {1u, 7u, 1000u}) {
      for (std::size_t first = 0; first < n; first += count) {
        const std::size_t here = std::min(count, n - first);
        const AreaSamples range = sampling.draw(mesh, sums, first, here);
        ASSERT_EQ(range.points.size(), here);
        for (std::size_t k = 0; k < here; ++k) {
          EXPECT_EQ(range.points[k], all.points[first + k]);
          EXPECT_EQ(range.faces[k], all.faces[first + k]);
        }
      }
    }
  }
}

// --- Comparison ----------------------------------------------------------------------------

// Polyhedra between the spheres of radius inner R and R have distances between 1.1 inner - 1 and
// 1.1 - inner from each other, from any point.
TEST(compare, concentric_spheres_differ_by_their_radii) {
  const Mesh a = icosphere(5), b = moved(a, 1.1, {});
  double inner = 1;
  for (const Triangle& t : a.faces) {
    const Vec3& p = a.vertices[t[0]];
    const Vec3 normal = normalized(cross(a.vertices[t[1]] - p, a.vertices[t[2]] - p));
    inner = std::min(inner, dot(normal, p));
  }
  ASSERT_GT(inner, 0.9997);
  const Comparison result = compare(a, b, {.samples = 40000});
  for (const Distances& d : {result.a_to_b, result.b_to_a}) {
    for (const double value : {d.rms, d.mean, d.max}) {
      EXPECT_GE(value, 1.1 * inner - 1);
      EXPECT_LE(value, 1.1 - inner);
    }
  }
  // A facet's normal is within acos(inner) of the radius at each of its points. Three angles of
  // this size lie between two normals: at the sample, at the closest point, and between their
  // radii.
  const double facet = std::acos(inner) * 180 / std::numbers::pi;
  EXPECT_LE(result.normal_mean_degrees, 3 * facet);
}

// A cube of edge 2 moved by s along x. Its face x = 1 + s is at distance s. Its face x = -1 + s is
// at min(s, distance from the square's border), whose level sets are squares. The strips beyond x =
// 1 of the other four faces are at x - 1; all other points touch. The bound is 6 standard
// deviations of distances within 0 ... s, each at most s / 2.
TEST(compare, shifted_cubes_have_the_distances_of_the_closed_form) {
  const double s = 0.2;
  const Mesh a = box({2, 2, 2}), b = moved(a, 1, {s, 0, 0});
  CompareOptions options;
  const double t = 0.15;  // threshold
  options.threshold = t / std::sqrt(12.0);
  const Comparison result = compare(a, b, options);
  const double mean = (4 * s + 4 / 3.0 * (1 - std::pow(1 - s, 3)) + 4 * s * s) / 24;
  const double square =
      (4 * s * s + 8 * (s * s / 2 - 2 * s * s * s / 3 + s * s * s * s / 4) + 8 * s * s * s / 3) /
      24;
  const double within = (4 * 2 * (2 - s + t) + 4 - std::pow(2 - 2 * t, 2)) / 24;
  const double n = static_cast<double>(options.samples);
  for (const Distances& d : {result.a_to_b, result.b_to_a}) {
    EXPECT_NEAR(d.mean, mean, 3 * s / std::sqrt(n));
    EXPECT_NEAR(d.rms * d.rms, square, 3 * s * s / std::sqrt(n));
    EXPECT_NEAR(d.max, s, 1e-14);
  }
  EXPECT_NEAR(result.hausdorff, s, 1e-14);
  EXPECT_NEAR(result.diagonal, std::sqrt(12.0), 1e-14);
  EXPECT_NEAR(result.threshold, t, 1e-14);
  EXPECT_NEAR(result.precision, within, 3 / std::sqrt(n));
  EXPECT_NEAR(result.recall, within, 3 / std::sqrt(n));
  EXPECT_NEAR(result.f_score, within, 6 / std::sqrt(n));
  EXPECT_EQ(result.normal_median_degrees, 0);
}

// A consists of two equal cubes, B of one of them: all of B is found in A, half of A in B.
// Stratified samples fall on the right half, except for one or two.
TEST(compare, precision_is_the_share_of_b_and_recall_that_of_a) {
  const Mesh b = box({2, 2, 2}), other = moved(b, 1, {10, 0, 0});
  Mesh a = b;
  const auto n = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : b.faces) a.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  const Comparison result = compare(a, b, {.samples = 10000});
  EXPECT_EQ(result.precision, 1);
  EXPECT_NEAR(result.recall, 0.5, 2.0 / 10000);
  EXPECT_NEAR(result.f_score, 2 / 3.0, 4.0 / 10000);
  EXPECT_LT(result.b_to_a.max, 1e-15);
  EXPECT_GT(result.a_to_b.max, 8);
}

// Samples lie on their triangle up to rounding of some 2^-53.
TEST(compare, a_mesh_with_itself_has_no_distance) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const Comparison result = compare(mesh, mesh, {.samples = 50000});
  EXPECT_LT(result.hausdorff, 1e-15);
  EXPECT_EQ(result.f_score, 1);
  EXPECT_EQ(result.normal_median_degrees, 0);
  EXPECT_LT(result.normal_mean_degrees, 1e-6);
}

TEST(compare, a_flipped_mesh_has_opposite_normals_and_no_distance) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  Mesh flipped = mesh;
  flip(flipped);
  const Comparison result = compare(mesh, flipped, {.samples = 50000});
  EXPECT_LT(result.hausdorff, 1e-15);
  EXPECT_EQ(result.normal_median_degrees, 180);
}

// A cube whose top has a tent of height h on four squares of edge 1. The apex is h from the cube. A
// sample within a distance d of the apex is at least h (1 - d) from the cube. There are 200 000
// samples on an area near 24. They lie closer than 0.05 together (a disc of that radius is 65
// shares of area).
TEST(compare, finds_a_bump_from_the_side_that_has_it) {
  const double h = 0.5;
  const Mesh plain = box({2, 2, 2}, 2);
  Mesh bumped = plain;
  for (Vec3& v : bumped.vertices) {
    if (v == Vec3{0, 0, 1}) v.z += h;
  }
  const Comparison result = compare(bumped, plain);
  EXPECT_GE(result.a_to_b.max, h * (1 - 0.05));
  EXPECT_LE(result.a_to_b.max, h);
  EXPECT_LT(result.b_to_a.max, h * 0.9);  // points of the cube are near the tent's slopes
  EXPECT_EQ(result.hausdorff, result.a_to_b.max);
}

void expect_same(const Comparison& a, const Comparison& b, double scale = 1) {
  for (const auto member : {&Comparison::a_to_b, &Comparison::b_to_a}) {
    EXPECT_EQ((a.*member).rms * scale, (b.*member).rms);
    EXPECT_EQ((a.*member).mean * scale, (b.*member).mean);
    EXPECT_EQ((a.*member).max * scale, (b.*member).max);
  }
  EXPECT_EQ(a.hausdorff * scale, b.hausdorff);
  EXPECT_EQ(a.f_score, b.f_score);
  EXPECT_EQ(a.normal_median_degrees, b.normal_median_degrees);
  EXPECT_EQ(a.normal_mean_degrees, b.normal_mean_degrees);
}

TEST(compare, gives_the_same_bits_for_any_number_of_threads) {
  const Mesh a = bumpy_sphere(4, 0.3), b = bumpy_sphere(3, 0.3);
  const Comparison one = compare(a, b, {.samples = 20000}, {.threads = 1});
  for (const int threads : {2, 4, 7}) {
    expect_same(one, compare(a, b, {.samples = 20000}, {.threads = threads}));
  }
}

// Other processes take their own samples of the same surfaces.
TEST(compare, gives_the_same_bits_where_other_processes_measure_parts) {
  const Mesh a = bumpy_sphere(4), b = moved(icosphere(3), 1.05, {0.01, 0, 0});
  for (const std::size_t samples : {1u, 8192u, 20000u}) {
    const CompareOptions options{.samples = samples, .seed = 5};
    const Comparison alone = compare(a, b, options);
    std::vector<std::unique_ptr<CompareSamples>> processes;
    processes.reserve(3);
    for (int i = 0; i < 3; ++i)
      processes.push_back(std::make_unique<CompareSamples>(a, b, options));
    test::ExecutorBy executor([&](const Parts& parts, const auto& here, const auto& take) {
      EXPECT_THROW(take(0, "nonsense"), Error);
      for (std::size_t p = 0; p < parts.count; ++p) {
        const std::size_t who = p * 3 / parts.count;
        take(p, who == 0 ? here(p, 1) : processes[who]->work(p));
      }
    });
    const Comparison shared = compare(*processes[0], {}, &executor);
    for (const auto member : {&Comparison::a_to_b, &Comparison::b_to_a}) {
      EXPECT_EQ((shared.*member).rms, (alone.*member).rms);
      EXPECT_EQ((shared.*member).mean, (alone.*member).mean);
      EXPECT_EQ((shared.*member).max, (alone.*member).max);
    }
    EXPECT_EQ(shared.f_score, alone.f_score);
    EXPECT_EQ(shared.diagonal, alone.diagonal);
    EXPECT_EQ(shared.threshold, alone.threshold);
    EXPECT_EQ(shared.normal_mean_degrees, alone.normal_mean_degrees);
    EXPECT_EQ(shared.normal_median_degrees, alone.normal_median_degrees);
  }
}

TEST(compare, scales_with_the_unit) {
  const Mesh a = bumpy_sphere(3, 0.3), b = bumpy_sphere(2, 0.3);
  const Comparison one = compare(a, b, {.samples = 5000});
  for (const double scale : {0x1p-900, 0x1p-20, 0x1p40, 0x1p900}) {
    expect_same(one, compare(moved(a, scale, {}), moved(b, scale, {}), {.samples = 5000}), scale);
  }
}

// Two independent estimates differ by sampling only. The bound is 6 standard deviations of
// distances within 0 ... max.
TEST(compare, seeds_change_the_samples_and_little_else) {
  const Mesh a = bumpy_sphere(3, 0.3), b = bumpy_sphere(2, 0.3);
  const Comparison one = compare(a, b, {.samples = 20000, .seed = 1});
  const Comparison two = compare(a, b, {.samples = 20000, .seed = 2});
  EXPECT_EQ(two.seed, 2u);
  EXPECT_NE(one.a_to_b.mean, two.a_to_b.mean);
  EXPECT_NEAR(one.a_to_b.mean, two.a_to_b.mean, 6 * one.a_to_b.max / std::sqrt(20000.0));
}

TEST(compare, survives_degenerate_triangles_in_both_meshes) {
  Mesh mesh = box({1, 1, 1}, 2);
  for (std::uint32_t k = 0; k < 10; ++k) mesh.faces.insert(mesh.faces.begin(), {k, k, 5});
  const Comparison result = compare(mesh, mesh, {.samples = 5000});
  EXPECT_LT(result.hausdorff, 1e-15);
  EXPECT_TRUE(std::isfinite(result.normal_mean_degrees));
}

TEST(compare, refuses_what_it_cannot_mean) {
  const Mesh good = box({1, 1, 1});
  Mesh flat = good, broken = good;
  for (Vec3& v : flat.vertices) v = {v.x, 0, 0};
  broken.vertices[0].x = std::nan("");
  EXPECT_THROW(compare(good, Mesh{}), Error);
  EXPECT_THROW(compare(Mesh{}, good), Error);
  EXPECT_THROW(compare(good, flat), Error);
  EXPECT_THROW(compare(good, broken), Error);
  EXPECT_THROW(compare(good, good, {.samples = 0}), Error);
  EXPECT_THROW(compare(good, good, {.samples = kMaxSamples + 1}), Error);
  for (const double threshold : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_THROW(compare(good, good, {.threshold = threshold}), Error);
  }
}

TEST(compare, can_be_cancelled) {
  const Mesh mesh = icosphere(3);
  const Context context = {.progress = [](std::string_view, double part) { return part < 0.3; }};
  try {
    compare(mesh, mesh, {}, context);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(distances_to_surface, of_points_about_a_box_are_the_closed_form) {
  const Mesh mesh = box({2, 2, 2}, 3);
  const std::vector<double> d = distances_to_surface(
      {{0, 0, 0}, {0.9, 0, 0}, {3, 0, 0}, {2, 2, 0.5}, {2, 2, 2}, {1, 1, 1}}, mesh);
  const std::vector<double> expected = {1, 0.1, 2, std::sqrt(2), std::sqrt(3), 0};
  ASSERT_EQ(d.size(), expected.size());
  for (std::size_t k = 0; k < d.size(); ++k) EXPECT_NEAR(d[k], expected[k], 1e-15);
  EXPECT_THROW(distances_to_surface({{0, 0, 0}}, Mesh{}), Error);
  EXPECT_THROW(distances_to_surface({{std::nan(""), 0, 0}}, mesh), Error);
}

}  // namespace
}  // namespace rholm
