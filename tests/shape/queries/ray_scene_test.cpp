#include "shape/queries/ray_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "rholm/context.h"
#include "rholm/error.h"
#include "shape/queries/closest_point.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Shapes drawn here, so that the claims do not rest on other code of the library.
Mesh cube() {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// An octahedron, each triangle cut in n^2, every vertex on the unit sphere; vertices not shared.
Mesh octasphere(int n) {
  Mesh mesh;
  const auto emit = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : {a, b, c}) mesh.vertices.push_back(normalized(p));
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int octant = 0; octant < 8; ++octant) {
    const double sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto at = [&](int i, int j) { return Vec3{sx * (n - i - j), sy * i, sz * j}; };
    const bool keep = sx * sy * sz > 0;
    const auto put = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      keep ? emit(a, b, c) : emit(a, c, b);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        put(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) put(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return mesh;
}

// Also while Embree builds, which comes last: at its last question.
TEST(RayScene, ends_where_the_scope_of_the_thread_says_so) {
  const Mesh mesh = octasphere(100);
  int asked = 0, go_on = 1 << 30;
  const CancelScope scope([&] { return ++asked < go_on; });
  { const RayScene scene(mesh); }
  const int copying = static_cast<int>((mesh.vertices.size() + mesh.triangles.size()) >> 13);
  EXPECT_GT(asked, copying + 1);
  go_on = copying + 2;
  asked = 0;
  try {
    const RayScene scene(mesh);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

Vec3 random_point(std::uint64_t seed, std::uint64_t k) {
  return {2 * random_uniform(seed, 3 * k) - 1, 2 * random_uniform(seed, 3 * k + 1) - 1,
          2 * random_uniform(seed, 3 * k + 2) - 1};
}

// A soup of triangles of very different sizes, every fifth one without area (a needle folded onto
// itself, or a point).
Mesh soup(std::uint64_t seed, std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t t = 0; t < n; ++t) {
    const Vec3 a = random_point(seed, std::uint64_t{3} * t);
    const double size = std::pow(10.0, -3 * random_uniform(seed + 1, t));
    Vec3 b = a + size * random_point(seed, 3 * t + 1);
    Vec3 c = a + size * random_point(seed, 3 * t + 2);
    if (t % 5 == 0) c = a + 0.5 * (b - a);
    if (t % 10 == 0) b = c = a;
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

// Independent of the library's way: the minimum of |x - p| over the triangle by its barycentric
// quadratic form, region by region (inside, three edges), all in long double.
double oracle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  using Real = long double;
  const auto dot3 = [](const Vec3& u, const Vec3& v) {
    return Real(u.x) * v.x + Real(u.y) * v.y + Real(u.z) * v.z;
  };
  const Vec3 e = b - a, f = c - a, w = p - a;
  const Real ee = dot3(e, e), ef = dot3(e, f), ff = dot3(f, f), ew = dot3(e, w), fw = dot3(f, w);
  const auto at = [&](Real s, Real t) {  // squared distance to a + s e + t f
    const Real x = w.x - s * e.x - t * f.x, y = w.y - s * e.y - t * f.y,
               z = w.z - s * e.z - t * f.z;
    return x * x + y * y + z * z;
  };
  const auto clamp = [](Real x) { return x > 0 ? (x < 1 ? x : Real(1)) : Real(0); };
  Real best = at(ee > 0 ? clamp(ew / ee) : 0, 0);
  best = std::min(best, at(0, ff > 0 ? clamp(fw / ff) : 0));
  const Real gg = ee - 2 * ef + ff;  // the third edge: s = 1 - t
  const Real t3 = gg > 0 ? clamp((ee - ef - ew + fw) / gg) : 0;
  best = std::min(best, at(1 - t3, t3));
  const Real determinant = ee * ff - ef * ef;
  if (determinant > 1e-17L * ee * ff) {
    const Real s = (ew * ff - fw * ef) / determinant, t = (fw * ee - ew * ef) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) best = std::min(best, at(s, t));
  }
  return static_cast<double>(std::sqrt(best));
}

double brute_force_distance(const Mesh& mesh, const Vec3& p) {
  double best = kInfinity;
  for (const Triangle& t : mesh.triangles) {
    best = std::min(
        best, oracle_distance(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return best;
}

// --- Closest points ------------------------------------------------------------------------

// Coordinates up to 1: differences, squares and the root leave a few 2^-53. 1e-14 is some 50.
TEST(closest_point, equals_a_brute_force_search_in_extended_precision) {
  const Mesh mesh = soup(7, 2000);
  const RayScene scene(mesh);
  for (int k = 0; k < 3000; ++k) {
    const Vec3 p = (k % 3 == 0 ? 0.01 : 1.5) * random_point(99, k);
    const ClosestPoint found = scene.closest(p);
    ASSERT_NEAR(found.distance, brute_force_distance(mesh, p), 1e-14);
    ASSERT_NEAR(norm(found.point - p), found.distance, 1e-14);
    const Triangle& t = mesh.triangles[found.triangle];
    ASSERT_NEAR(
        0,
        oracle_distance(found.point, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]),
        1e-14);
  }
}

// 500 specks at distances that differ by less than a float can tell: the search must look a little
// further than it has found. Each speck is there 16 times, so that leaves of the tree are points.
TEST(closest_point, is_not_lost_in_the_rounding_of_the_tree) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Mesh mesh;
    for (std::uint32_t k = 0; k < 500; ++k) {
      const double radius = 1 + 1e-8 * random_uniform(seed, k);
      mesh.vertices.push_back(radius * normalized(random_point(seed + 100, k)));
      mesh.triangles.insert(mesh.triangles.end(), 16, {k, k, k});
    }
    const RayScene scene(mesh);
    const Vec3 p = 1e-8 * random_point(seed + 200, 0);
    ASSERT_NEAR(scene.closest(p).distance, brute_force_distance(mesh, p), 1e-15);
  }
}

// Shifted by 1000 the coordinates themselves are good to 1e-13; scales are exact powers of two.
TEST(closest_point, keeps_its_accuracy_at_any_scale_and_place) {
  const Mesh mesh = soup(8, 300);
  const RayScene here(mesh);
  for (const double scale : {0x1p-900, 0x1p-30, 1.0, 0x1p30, 0x1p900}) {
    const Mesh scaled = moved(mesh, scale, {});
    const RayScene scene(scaled);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p = random_point(5, k);
      ASSERT_NEAR(scene.closest(scale * p).distance / scale, here.closest(p).distance, 1e-14);
    }
  }
  const Vec3 offset = {1000, -1000, 1000};
  const Mesh there = moved(mesh, 1, offset);
  const RayScene scene(there);
  for (int k = 0; k < 100; ++k) {
    const Vec3 p = random_point(5, k);
    ASSERT_NEAR(scene.closest(p + offset).distance, here.closest(p).distance, 1e-12);
  }
}

TEST(closest_point, of_far_points_is_exact_or_at_least_finite) {
  const Mesh mesh = cube();
  const RayScene scene(mesh);
  for (const double far : {1e3, 1e8, 1e20, 1e100, 1e200, 1e308}) {
    const ClosestPoint found = scene.closest({far, 0, 0});
    EXPECT_DOUBLE_EQ(found.distance, far - 1) << far;
    if (far > 1e15) continue;  // 2^-53 far hides the mesh
    EXPECT_EQ(found.point.x, 1) << far;
  }
}

TEST(closest_point, ties_go_to_the_smaller_index) {
  const Mesh mesh = cube();
  const RayScene scene(mesh);
  // Triangle 0 and 1 share the diagonal of the bottom; 0, 1, 4, 5, 8, 9 have the corner 0.
  EXPECT_EQ(scene.closest({0.25, 0.25, -3}).triangle, 0u);
  EXPECT_EQ(scene.closest({-2, -2, -2}).triangle, 0u);
  EXPECT_EQ(scene.closest({1.5, 3, 2.25}).triangle, 2u);  // corner 7: 2, 3, 6, 7, 10, 11
  Mesh twice = mesh;
  twice.triangles.insert(twice.triangles.begin(), mesh.triangles.begin(), mesh.triangles.end());
  const RayScene doubled(twice);
  for (int k = 0; k < 200; ++k) EXPECT_LT(doubled.closest(random_point(3, k)).triangle, 12u);
}

TEST(closest_point, of_a_degenerate_triangle_is_that_of_its_edges) {
  EXPECT_EQ(closest_point_of_triangle({0.3, 5, 0}, {{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}}),
            (Vec3{0.3, 0, 0}));
  EXPECT_EQ(closest_point_of_triangle({3, 4, 0}, {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}), Vec3{});
  EXPECT_EQ(closest_point_of_triangle({-1, 0, 0}, {{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}}}), Vec3{});
}

// A needle of length 1 and width w: p at height h over its middle has the distance h whatever w.
TEST(closest_point, of_a_sliver_is_as_good_as_its_normal) {
  for (const double width : {1e-2, 1e-6, 1e-10, 1e-14}) {
    const double h = 0.7;
    const Vec3 p = {0.5, width / 4, h};
    const Vec3 q = closest_point_of_triangle(p, {{{0, 0, 0}, {1, 0, 0}, {0.5, width, 0}}});
    EXPECT_NEAR(norm(p - q), h, 1e-15) << width;
  }
}

TEST(closest_point, of_a_mesh_without_triangles_or_to_nan_is_refused) {
  const Mesh none;
  EXPECT_THROW(RayScene(none).closest({0, 0, 0}), Error);
  const Mesh mesh = cube();
  EXPECT_THROW(RayScene(mesh).closest({std::nan(""), 0, 0}), Error);
}

TEST(closest_point, of_a_mesh_that_is_a_single_point_is_that_point) {
  Mesh mesh;
  mesh.vertices = {{1, 2, 3}};
  mesh.triangles = {{0, 0, 0}};
  const ClosestPoint found = RayScene(mesh).closest({1, 2, 5});
  EXPECT_EQ(found.distance, 2);
  EXPECT_EQ(found.point, (Vec3{1, 2, 3}));
}

// --- Rays ----------------------------------------------------------------------------------

TEST(count_hits, sphere_from_inside_is_met_once_through_vertices_edges_and_faces) {
  const Mesh mesh = octasphere(12);
  const RayScene scene(mesh);
  for (const Vec3& origin : {Vec3{}, Vec3{0.3, -0.2, 0.1}}) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      for (const Vec3& target : {a, 0.5 * (a + b), 0.7 * b + 0.3 * c, (a + b + c) / 3.0}) {
        ASSERT_EQ(scene.count_hits(origin, normalized(target - origin)), 1);
      }
    }
  }
}

TEST(count_hits, sphere_from_outside_is_met_twice_or_never) {
  const Mesh mesh = octasphere(12);
  const RayScene scene(mesh);
  // No edge is longer than sqrt(2)/12 * sqrt(3) = 0.21 (projecting an octahedron's face stretches
  // by at most sqrt(3)), so the facets stay outside the ball of radius 1 - 0.21^2 / 2 > 0.97.
  for (int k = 0; k < 2000; ++k) {
    const Vec3 axis = normalized(random_point(11, k));
    const Vec3 side = normalized(cross(axis, {0.3, 0.5, 0.8}));
    EXPECT_EQ(scene.count_hits(3.0 * axis + 0.9 * side, -axis), 2);
    EXPECT_EQ(scene.count_hits(3.0 * axis + 1.01 * side, -axis), 0);
    EXPECT_EQ(scene.count_hits(3.0 * axis, axis), 0);
  }
}

TEST(count_hits, box_is_met_once_from_the_centre_through_corners_edges_and_diagonals) {
  const Mesh mesh = cube();
  const RayScene scene(mesh);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 direction = normalized({double(x), double(y), double(z)});
        EXPECT_EQ(scene.count_hits({}, direction), 1) << x << y << z;
        EXPECT_EQ(scene.count_hits(-3.0 * direction, direction), 2) << x << y << z;
      }
    }
  }
}

TEST(count_hits, does_not_depend_on_scale_and_place) {
  for (const double scale : {1e-200, 1e-6, 1.0, 1e6, 1e200}) {
    const Vec3 offset = {100 * scale, 0, -50 * scale};
    const Mesh mesh = moved(octasphere(6), scale, offset);
    const RayScene scene(mesh);
    for (const Vec3& vertex : mesh.vertices) {
      const Vec3 direction = normalized((vertex - offset) / scale);
      ASSERT_EQ(scene.count_hits(offset, direction), 1) << scale;
      ASSERT_EQ(scene.count_hits(offset - 3 * scale * direction, direction), 2) << scale;
    }
  }
}

TEST(count_hits, of_nested_shells_counts_every_shell) {
  Mesh mesh;
  for (int shell = 1; shell <= 5; ++shell) {
    const Mesh sphere = moved(octasphere(8), shell, {});
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), sphere.vertices.begin(), sphere.vertices.end());
    for (const Triangle& t : sphere.triangles) {
      mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  const RayScene scene(mesh);
  for (int k = 0; k < 500; ++k) {
    EXPECT_EQ(scene.count_hits({0.1, 0.2, 0.3}, normalized(random_point(2, k))), 5);
  }
}

// A float hit is good to a few 2^-24 of the size.
TEST(first_hit, is_the_nearest_face_with_its_place_on_the_triangle) {
  const Mesh mesh = cube();
  const RayScene scene(mesh);
  const RayHit hit = scene.first_hit({0.5, 0.25, 4}, {0, 0, -1}, 0, kInfinity);
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.distance, 3, 1e-6);
  const Triangle& t = mesh.triangles[hit.triangle];
  const Vec3 place = (1.0 - hit.u - hit.v) * mesh.vertices[t[0]] +
                     double(hit.u) * mesh.vertices[t[1]] + double(hit.v) * mesh.vertices[t[2]];
  EXPECT_NEAR(norm(place - Vec3{0.5, 0.25, 1}), 0, 1e-6);
  EXPECT_NEAR(scene.first_hit({0.5, 0.25, 4}, {0, 0, -1}, 3.5, kInfinity).distance, 5, 1e-6);
  EXPECT_FALSE(scene.first_hit({0.5, 0.25, 4}, {0, 0, -1}, 0, 2.5).hit);
  EXPECT_FALSE(scene.first_hit({0.5, 0.25, 4}, {0, 0, 1}, 0, kInfinity).hit);
}

TEST(occluded, says_whether_something_is_within_the_range) {
  const Mesh mesh = moved(cube(), 1e-5, {7, 7, 7});
  const RayScene scene(mesh);
  const Vec3 above = {7, 7, 7 + 4e-5};
  EXPECT_TRUE(scene.occluded(above, {0, 0, -1}, 0, kInfinity));
  EXPECT_TRUE(scene.occluded(above, {0, 0, -1}, 0, 3.1e-5));
  EXPECT_FALSE(scene.occluded(above, {0, 0, -1}, 0, 2.9e-5));
  EXPECT_FALSE(scene.occluded(above, {0, 0, 1}, 0, kInfinity));
}

// Against the closed form, by random rays at random balls.
TEST(rays, meet_balls_about_vertices) {
  constexpr double kRadius = 0.1;
  Mesh mesh;
  for (int k = 0; k < 200; ++k) mesh.vertices.push_back(random_point(5, k));
  const RayScene scene(mesh, kRadius);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 origin = 4.0 * normalized(random_point(6, k));
    const Vec3 direction = normalized(random_point(7, k) - origin);
    double nearest = kInfinity, margin = kInfinity;
    for (const Vec3& center : mesh.vertices) {
      const double along = dot(center - origin, direction);
      const double off = norm(origin + along * direction - center);
      margin = std::min(margin, std::abs(off - kRadius));
      if (off < kRadius) {
        nearest = std::min(nearest, along - std::sqrt(kRadius * kRadius - off * off));
      }
    }
    if (margin < 1e-5) continue;  // it just touches one: floats may see it or not
    const RayHit hit = scene.first_hit(origin, direction, 0, kInfinity);
    ASSERT_EQ(hit.hit, std::isfinite(nearest));
    EXPECT_EQ(scene.occluded(origin, direction, 0, kInfinity), hit.hit);
    if (!hit.hit) continue;
    // Floats of 4, and a chord that may be flat: 1e-6 / sqrt(2 * 1e-5 / 0.1).
    EXPECT_NEAR(hit.distance, nearest, 1e-4);
    EXPECT_LT(norm(origin + nearest * direction - mesh.vertices[hit.triangle]), kRadius + 1e-4);
  }
}

// Many rays at once, or one after the other; of a tree built in either way.
TEST(rays, meet_the_same_in_packets) {
  const Mesh mesh = soup(8, 300);
  for (const double radius : {0.0, 0.1}) {
    const RayScene scene(mesh, radius), quick(mesh, radius, RayTree::kQuick);
    std::vector<Ray> rays;
    for (int k = 0; k < 1003; ++k) {
      const Vec3 origin = 4.0 * normalized(random_point(9, k));
      rays.push_back({origin, normalized(random_point(10, k) - origin)});
    }
    const std::vector<RayHit> hits = quick.first_hits(rays);
    const std::vector<bool> occluded = quick.occluded(rays);
    ASSERT_EQ(hits.size(), rays.size());
    int differences = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const RayHit hit = scene.first_hit(rays[k].origin, rays[k].direction, 0, kInfinity);
      EXPECT_EQ(occluded[k], hits[k].hit);
      // The arithmetic of a packet rounds otherwise: a ray that just touches may miss.
      differences += hit.hit != hits[k].hit || hit.triangle != hits[k].triangle;
      if (hit.hit && hits[k].hit && hit.triangle == hits[k].triangle) {
        EXPECT_NEAR(hits[k].distance, hit.distance, 1e-4);
      }
    }
    EXPECT_LE(differences, 2);
  }
  EXPECT_TRUE(RayScene(mesh).first_hits({}).empty());
}

TEST(rays, meet_nothing_in_an_empty_mesh) {
  const Mesh none;
  const RayScene scene(none);
  EXPECT_EQ(scene.count_hits({}, {0, 0, 1}), 0);
  EXPECT_FALSE(scene.first_hit({}, {0, 0, 1}, 0, kInfinity).hit);
  EXPECT_FALSE(scene.occluded({}, {0, 0, 1}, 0, kInfinity));
  EXPECT_FALSE(RayScene(none, 1).first_hit({0, 0, -4}, {0, 0, 1}, 0, kInfinity).hit);
}

}  // namespace
}  // namespace rholm
