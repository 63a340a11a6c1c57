#include "shape/queries/ray_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "rholm/context.h"
#include "rholm/error.h"
#include "support/query_meshes.h"

namespace rholm {
namespace {

using test::cube;
using test::random_point;
using test::soup;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns an octahedron, each face cut into n^2, projected to the unit sphere; vertices not shared.
Mesh octasphere(int n) {
  Mesh mesh;
  const auto emit = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : {a, b, c}) mesh.vertices.push_back(normalized(p));
    mesh.faces.push_back({first, first + 1, first + 2});
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

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

// Building the tree can be cancelled, too. It comes last, and asks the last question.
TEST(RayScene, ends_where_the_scope_of_the_thread_says_so) {
  const Mesh mesh = octasphere(100);
  int asked = 0, go_on = 1 << 30;
  const CancelScope scope([&] { return ++asked < go_on; });
  { const RayScene scene(mesh); }
  const int copying = static_cast<int>((mesh.vertices.size() + mesh.faces.size()) >> 13);
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

// --- Rays ----------------------------------------------------------------------------------

TEST(count_hits, sphere_from_inside_is_met_once_through_vertices_edges_and_faces) {
  const Mesh mesh = octasphere(12);
  const RayScene scene(mesh);
  for (const Vec3& origin : {Vec3{}, Vec3{0.3, -0.2, 0.1}}) {
    for (const Triangle& t : mesh.faces) {
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
  // No edge is longer than sqrt(2)/12 * sqrt(3) = 0.21 (projection stretches a face of the
  // octahedron by at most sqrt(3)), so that facets lie outside the ball of radius 1 - 0.21^2 / 2 >
  // 0.97.
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
    for (const Triangle& t : sphere.faces) {
      mesh.faces.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  const RayScene scene(mesh);
  for (int k = 0; k < 500; ++k) {
    EXPECT_EQ(scene.count_hits({0.1, 0.2, 0.3}, normalized(random_point(2, k))), 5);
  }
}

// A hit in single precision is accurate to a few 2^-24 of the size.
TEST(first_hit, is_the_nearest_face_with_its_place_on_the_triangle) {
  const Mesh mesh = cube();
  const RayScene scene(mesh);
  const RayHit hit = scene.first_hit({0.5, 0.25, 4}, {0, 0, -1}, 0, kInfinity);
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.distance, 3, 1e-6);
  const Triangle& t = mesh.faces[hit.triangle];
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

// Random rays at random balls, compared with the closed form.
TEST(rays, meet_balls_about_vertices) {
  constexpr double kRadius = 0.1;
  Mesh mesh;
  for (int k = 0; k < 200; ++k) mesh.vertices.push_back(random_point(5, k));
  const RayScene scene(mesh, {}, kRadius);
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
    if (margin < 1e-5) continue;  // touches a ball: single precision may hit or miss
    const RayHit hit = scene.first_hit(origin, direction, 0, kInfinity);
    ASSERT_EQ(hit.hit, std::isfinite(nearest));
    EXPECT_EQ(scene.occluded(origin, direction, 0, kInfinity), hit.hit);
    if (!hit.hit) continue;
    // Floats near 4, and a chord at a small angle: 1e-6 / sqrt(2 * 1e-5 / 0.1).
    EXPECT_NEAR(hit.distance, nearest, 1e-4);
    EXPECT_LT(norm(origin + nearest * direction - mesh.vertices[hit.triangle]), kRadius + 1e-4);
  }
}

// A slow search in extended precision: all triangles whose plane is met in front of the origin and
// inside their three edges. `margin` is the smallest distance to an edge or to the origin.
struct SlowCrossing {
  std::uint32_t triangle;
  long double distance;
};
std::vector<SlowCrossing> slow_crossings(const Mesh& mesh, const Vec3& o, const Vec3& d,
                                         long double& margin) {
  using Real = long double;
  using Row = std::array<Real, 3>;
  const auto row = [](const Vec3& a) { return Row{a.x, a.y, a.z}; };
  const auto minus = [](const Row& a, const Row& b) {
    return Row{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto product = [](const Row& a, const Row& b, const Row& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  std::vector<SlowCrossing> found;
  for (std::uint32_t k = 0; k < mesh.faces.size(); ++k) {
    const auto& [a, b, c] = mesh.faces[k];
    const Row p = minus(row(mesh.vertices[a]), row(o)), q = minus(row(mesh.vertices[b]), row(o)),
              r = minus(row(mesh.vertices[c]), row(o)), along = row(d);
    const Real u = product(along, q, r), v = product(along, r, p), w = product(along, p, q);
    const Real sum = u + v + w;
    const Real t = product(p, q, r) / sum;
    const Real least = std::min({u / sum, v / sum, w / sum});
    if (t > -1e-2L && least > -1e-2L) margin = std::min({margin, std::abs(least), std::abs(t)});
    if (t > 0 && least > 0) found.push_back({k, t});
  }
  std::sort(found.begin(), found.end(),
            [](const SlowCrossing& x, const SlowCrossing& y) { return x.distance < y.distance; });
  return found;
}

TEST(rays, meet_what_a_search_of_all_triangles_finds) {
  int compared = 0, met = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Mesh mesh = soup(seed, 400);
    const RayScene scene(mesh);
    for (int k = 0; k < 700; ++k) {
      // Origins are inside, nearby and farther away.
      const Vec3 origin = std::array{1.0, 2.0, 4.0}[k % 3] * random_point(20 + seed, k);
      const Vec3 direction = normalized(random_point(30 + seed, k) - origin);
      long double margin = 1;
      const std::vector<SlowCrossing> slow = slow_crossings(mesh, origin, direction, margin);
      if (margin < 1e-2L) continue;  // too near to an edge for single precision
      ++compared, met += !slow.empty();
      const std::vector<RayCrossing> found = scene.crossings(origin, direction);
      ASSERT_EQ(found.size(), slow.size()) << seed << " " << k;
      for (std::size_t i = 0; i < slow.size(); ++i) {
        EXPECT_NEAR(found[i].distance, static_cast<double>(slow[i].distance), 1e-9 * norm(origin));
      }
      const RayHit hit = scene.first_hit(origin, direction, 0, kInfinity);
      ASSERT_EQ(hit.hit, !slow.empty());
      EXPECT_EQ(scene.occluded(origin, direction, 0, kInfinity), hit.hit);
      if (!hit.hit) continue;
      // A float near 4, and a triangle that may be met at a small angle.
      EXPECT_NEAR(hit.distance, static_cast<double>(slow[0].distance), 1e-4);
      if (slow.size() == 1 || slow[1].distance - slow[0].distance > 2e-4L) {
        EXPECT_EQ(hit.triangle, slow[0].triangle);
      }
      const auto just_before = static_cast<double>(slow[0].distance) - 1e-4;
      EXPECT_FALSE(scene.occluded(origin, direction, 0, just_before));
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(met, 500);
}

// Rays from inside a closed mesh hit it in every direction. Embree lets some rays pass between
// triangles.
#ifdef RHOLM_HAS_EMBREE
constexpr int kMostSlips = 20;  // out of 20 000
#else
constexpr int kMostSlips = 0;
#endif
TEST(rays, do_not_slip_through_edges_and_vertices) {
  const Mesh mesh = octasphere(30);
  const RayScene scene(mesh);
  int slips = 0;
  for (int k = 0; k < 20000; ++k) {
    const Triangle& t =
        mesh.faces[std::size_t{7919} * static_cast<std::size_t>(k) % mesh.faces.size()];
    const Vec3 origin = 0.5 * random_point(41, k / 100);
    const double share = k % 4 == 0 ? 0 : random_uniform(42, k);
    const Vec3 target = (1 - share) * mesh.vertices[t[0]] + share * mesh.vertices[t[1]];
    const Vec3 direction = normalized(target - origin);
    const RayHit hit = scene.first_hit(origin, direction, 0, kInfinity);
    EXPECT_EQ(scene.occluded(origin, direction, 0, kInfinity), hit.hit);
    if (!hit.hit) {
      ++slips;
      continue;
    }
    EXPECT_NEAR(hit.distance, norm(target - origin), 1e-4);
  }
  EXPECT_LE(slips, kMostSlips);
}

// Many rays at once are compared with single rays, for trees built in both ways.
TEST(rays, meet_the_same_in_packets) {
  const Mesh mesh = soup(8, 300);
  for (const double radius : {0.0, 0.1}) {
    const RayScene scene(mesh, {}, radius), quick(mesh, {}, radius, RayTree::kQuick);
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
      // A packet rounds differently: a ray that just touches may miss.
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
  EXPECT_FALSE(RayScene(none, {}, 1).first_hit({0, 0, -4}, {0, 0, 1}, 0, kInfinity).hit);
}

}  // namespace
}  // namespace rholm
