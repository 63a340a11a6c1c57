#include "transform/error/worst_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "support/sizes.h"
#include "support/test_shapes.h"
#include "transform/error/error_points.h"
#include "transform/error/face_scan.h"

namespace rholm {
namespace {

StarChart chart_about_origin(const Mesh& mesh) {
  return make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
}

// Compares with exact values and slopes at all points, for smooth and rough errors. Faces are short
// or long compared with 1/L; functions are radius and gauge; prior knowledge varies.
TEST_OF_TWO_SIZES(worst_points, have_the_largest_errors_of_all) {
  const Mesh smooth = test::rotated(bumpy_sphere(nightly ? 5 : 4, 0.3));
  Mesh rough = smooth;
  for (std::size_t i = 0; i < rough.vertices.size(); ++i) {
    rough.vertices[i] *= 1 + 1e-3 * random_uniform(1, i);
  }
  for (const Mesh& mesh : {smooth, rough}) {
    const StarChart chart = chart_about_origin(mesh);
    const MeshView view = view_of(mesh);
    const FaceScan scan = scan_faces(view, Vec3{}, {});
    for (const Method method : {Method::kEdge, Method::kGauge}) {
      for (const int degree : nightly ? std::vector{0, 6, 40, 170} : std::vector{0, 6, 40, 100}) {
        const Expansion expansion =
            expand(chart, {.degree = degree, .method = method, .precision = 1e-10}).expansion;
        const ErrorPoints all = extreme_points(view, {}, scan, degree);
        const PointErrors exact = point_errors(all, expansion, degree, true, 1e-10, {});
        const double radial = largest(exact.radial);
        const double distance = std::max(largest(exact.to_model), largest(exact.to_shape));
        for (const double known : {0.0, 0.4, 1.0}) {
          const RadialModel model(expansion, degree, 20'000, true, 1e-10, {});
          const WorstPoints worst = worst_points(
              view, scan, expansion, model,
              {.rms = radial / 5, .radial = known * radial, .distance = known * distance}, {});
          EXPECT_EQ(worst.seen, all.size());
          EXPECT_LE(worst.points.size(), std::min(all.size(), all.size() / 2 + 25'000));
          ASSERT_EQ(worst.errors.radial.size(), worst.points.size());
          EXPECT_NEAR(largest(worst.errors.radial), radial, 1e-8);
          EXPECT_NEAR(std::max(largest(worst.errors.to_model), largest(worst.errors.to_shape)),
                      distance, 1e-8)
              << to_string(method) << ' ' << degree << ' ' << known;
        }
      }
    }
  }
}

// A distant vertex without a face is not part of the surface, whatever the number of vertices, and
// however small the other coordinates are.
TEST(worst_points, are_of_faces) {
  const Mesh mesh = bumpy_sphere(5, 0.3);
  const Expansion expansion =
      expand(chart_about_origin(mesh), {.degree = 10, .precision = 1e-8}).expansion;
  const RadialModel model(expansion, 10, 20'000, true, 1e-8, {});
  for (const double far : {5.0, 1e25}) {
    for (const bool usual_number : {false, true}) {
      Mesh with = mesh;
      with.vertices.push_back({far, 0, 0});
      if (usual_number) with.faces.insert(with.faces.end(), {{0, 1, 1}, {0, 2, 2}});
      const MeshView view = view_of(with);
      const FaceScan scan = scan_faces(view, Vec3{}, {});
      const WorstPoints worst = worst_points(view, scan, expansion, model, {.rms = 1e-2}, {});
      EXPECT_LT(largest(worst.errors.radial), 0.5);
      EXPECT_GT(area_points(view, {}, scan, 1000).size(), 990);
    }
  }
}

// A rod is six times as long as thick: at its ends, errors of 1/r count 36 times as much.
TEST(worst_points, of_a_long_gauge_are_at_its_ends_too) {
  Mesh mesh = icosphere(5);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = Vec3{mesh.vertices[i].x, mesh.vertices[i].y, 6 * mesh.vertices[i].z} *
                       (1 + 1e-4 * random_uniform(1, i));
  }
  const Expansion expansion =
      expand(chart_about_origin(mesh), {.degree = 24, .method = Method::kGauge, .precision = 1e-9})
          .expansion;
  const MeshView view = view_of(mesh);
  const FaceScan scan = scan_faces(view, Vec3{}, {});
  const PointErrors exact =
      point_errors(extreme_points(view, {}, scan, 24), expansion, 24, true, 1e-10, {});
  const double radial = largest(exact.radial);
  const RadialModel model(expansion, 24, 20'000, true, 1e-10, {});
  const WorstPoints worst =
      worst_points(view, scan, expansion, model,
                   {.rms = radial / 3, .radial = 0.95 * radial, .distance = 0.9 * radial}, {});
  EXPECT_NEAR(largest(worst.errors.radial), radial, 1e-8);
}

// Compares the mean square of waves over the area with many midpoints on each face.
TEST(area_points, give_a_root_mean_square_to_three_in_a_thousand) {
  for (const int subdivisions : {1, 2, 3}) {
    const Mesh mesh = test::rotated(bumpy_sphere(subdivisions, 0.3));
    const MeshView view = view_of(mesh);
    const ErrorPoints points = area_points(view, {}, scan_faces(view, Vec3{}, {}), 20'000);
    EXPECT_GE(points.size(), 19'990);
    EXPECT_LE(points.size(), 20'000);
    for (const Vec3& k : {Vec3{3, 1, -2}, Vec3{9, -8, 4}, Vec3{20, 15, 18}}) {
      const auto square = [&](const Vec3& x) { return std::pow(std::sin(dot(k, x)), 4); };
      double sum = 0, areas = 0, of_points = 0;
      constexpr int n = 24;
      for (const Triangle& t : mesh.faces) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double area = norm(cross(b - a, c - a)) / (n * n);
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            for (const double third : {1.0 / 3, 2.0 / 3}) {
              if (third > 0.5 && i + j == n - 1) continue;
              const double u = (i + third) / n, v = (j + third) / n;
              sum += area * square(u * a + v * b + (1 - u - v) * c);
              areas += area;
            }
          }
        }
      }
      for (std::size_t i = 0; i < points.size(); ++i) {
        of_points += square(points.radii[i] * points.directions[i]);
      }
      const double found = std::sqrt(of_points / static_cast<double>(points.size()));
      const double exact = std::sqrt(sum / areas);
      EXPECT_NEAR(found, exact, 3e-3 * exact) << subdivisions << ' ' << k.x;
    }
  }
}

// Compares twice the areas of faces, and angular widths of the longest edges of runs, face by face.
TEST(face_sizes, are_what_the_faces_have) {
  for (const std::size_t n : {1, 3, 7, 127, 128, 130, 320}) {
    Mesh mesh = test::rotated(bumpy_sphere(2, 0.3));
    mesh.faces.resize(n);
    const Vec3 center = {0.1, -0.2, 0.05};
    const FaceSizes sizes = scan_faces(view_of(mesh), center, {}).sizes;
    std::vector<double> areas((n + FaceSizes::kGroup - 1) / FaceSizes::kGroup);
    ASSERT_EQ(sizes.area_bits.size(), areas.size());
    ASSERT_EQ(sizes.angles2.size(), (n + FaceSizes::kRun - 1) / FaceSizes::kRun);
    for (std::size_t t = 0; t < n; ++t) {
      Vec3 p[3];
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = sizes.scale * (mesh.vertices[mesh.faces[t][k]] - center);
      }
      areas[t / FaceSizes::kGroup] += norm(cross(p[1] - p[0], p[2] - p[0]));
      const double angle = std::sqrt(sizes.angles2[t / FaceSizes::kRun]);
      for (std::size_t k = 0; k < 3; ++k) {
        const double length = norm(p[k] - p[(k + 1) % 3]);
        const double near = std::min(norm(p[k]), norm(p[(k + 1) % 3]));
        EXPECT_LE(length / near, (1 + 1e-12) * angle);
        EXPECT_GT(length / near, 0.1 * angle);
      }
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
      EXPECT_NEAR(sizes.twice_area(i), areas[i], 1e-6 * areas[i]);
    }
  }
}

}  // namespace
}  // namespace rholm
