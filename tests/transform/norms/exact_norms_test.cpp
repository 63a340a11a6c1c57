#include "transform/norms/exact_norms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"
#include "support/executor_by.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/sizes.h"
#include "support/targets.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"
#include "transform/norms/exact_norms_rules.h"

namespace rholm {
namespace {

using Long = long double;

struct LongVec {
  Long x, y, z;
};
LongVec operator-(const LongVec& a, const LongVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Long dot(const LongVec& a, const LongVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Long norm(const LongVec& a) { return std::sqrt(dot(a, a)); }
LongVec cross(const LongVec& a, const LongVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct LongNorms {
  Long radius_squared = 0, solid_angle = 0, volume = 0;
};

// Evaluates (M7) in extended precision, triangle by triangle, without cubature.
LongNorms oracle(const MeshView& mesh, const Vec3& center) {
  LongNorms sum;
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    LongVec p[3];
    Long r[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 v = mesh.vertex(mesh.triangle(t)[i]);
      p[i] = LongVec{v.x, v.y, v.z} - LongVec{center.x, center.y, center.z};
      r[i] = norm(p[i]);
    }
    const LongVec n = cross(p[1] - p[0], p[2] - p[0]);
    const Long size = norm(n), d2 = dot(n, p[0]);
    if (size == 0) continue;
    const Long solid = 2 * std::atan2(d2, r[0] * r[1] * r[2] + dot(p[0], p[1]) * r[2] +
                                              dot(p[1], p[2]) * r[0] + dot(p[2], p[0]) * r[1]);
    Long potential = -d2 / size * solid;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const LongVec e = p[j] - p[i];
      const Long length = norm(e);
      potential += dot(n, cross(p[i], e)) / (size * length) *
                   std::log1p(2 * length / (r[i] + r[j] - length));
    }
    sum.radius_squared += d2 / size * potential;
    sum.solid_angle += solid;
    sum.volume += d2 / 6;
  }
  return sum;
}

double relative(double value, Long exact) { return static_cast<double>((value - exact) / exact); }

void expect_exact(const MeshView& mesh, const Vec3& center, const char* name) {
  const LongNorms exact = oracle(mesh, center);
  const ExactNorms norms = exact_norms(mesh, center);
  // Rounding of sums and of corners is measured as about 2e-16.
  EXPECT_LT(std::abs(relative(norms.radius_squared, exact.radius_squared)), 1e-15) << name;
  EXPECT_LT(std::abs(relative(norms.solid_angle, exact.solid_angle)), 1e-15) << name;
  EXPECT_LT(std::abs(relative(norms.volume, exact.volume)), 1e-15) << name;
}

struct Shape {
  const char* name;
  Mesh mesh;
  Vec3 center;
};

std::vector<Shape> shapes(bool nightly) {
  return {{"octahedron", test::random_octahedron(3), {}},
          {"box", box({2, 1, 3}), {0.2, 0.1, -0.5}},
          {"bumps, all sizes of triangles at once", bumpy_sphere(3, 0.6), {0.1, 0.05, 0}},
          {"bumps", bumpy_sphere(5, 0.3), {0.1, 0.05, 0}},
          {"small triangles", bumpy_sphere(nightly ? 7 : 6, 0.1), {0.1, 0.05, 0}},
          {"elongated", ellipsoid({1, 0.33, 0.3}, nightly ? 6 : 4), {0.4, 0.03, 0}},
          {"rod", ellipsoid({1, 0.01, 0.01}, nightly ? 6 : 4), {}},
          {"long needles", latitude_longitude_sphere(4, 5000), {0.1, 0.1, 0.1}},
          {"needles", latitude_longitude_sphere(40, nightly ? 1000 : 300), {0.1, 0.1, 0.1}},
          {"needles along parallels", latitude_longitude_sphere(1000, 6), {0.1, 0.1, 0.1}}};
}

TEST_OF_TWO_SIZES(exact_norms, agree_with_closed_forms_in_extended_precision) {
  for (const Shape& shape : shapes(nightly)) {
    expect_exact(test::packed<float>(shape.mesh).view, shape.center, shape.name);
    if (shape.mesh.faces.size() > 50000) continue;  // the oracle is slow
    expect_exact(test::packed<double>(shape.mesh, 4).view, shape.center, shape.name);
  }
}

TEST(exact_norms, are_as_good_with_every_instruction_set) {
  const Mesh mesh = bumpy_sphere(3, 0.6);
  test::for_each_target([&](const char* target) {
    expect_exact(test::packed<float>(mesh).view, {0.1, 0.05, 0}, target);
    expect_exact(view_of(mesh), {0.1, 0.05, 0}, target);
  });
}

// Partial vectors repeat their last triangle. Here the centre of this triangle is the mesh's, where
// 1/|x| is infinite. It adds nothing, because its plane passes through the centre.
TEST(exact_norms, are_numbers_for_any_number_of_triangles_whatever_the_last_one_is) {
  Mesh mesh = bumpy_sphere(1, 0.3);
  const std::vector<Triangle> triangles = mesh.faces;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{3, 0, 0}, {0, 3, 0}, {-3, -3, 0}});
  test::for_each_target([&](const char* target) {
    double first_power = 0, volume = 0;
    for (std::size_t n = 1; n <= 33; ++n) {
      mesh.faces = {triangles[n - 1]};
      const ExactNorms one = exact_norms(view_of(mesh), {});
      first_power += one.radius_squared, volume += one.volume;
      mesh.faces.assign(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(n));
      for (const bool more : {false, true}) {
        if (more) mesh.faces.push_back({first, first + 1, first + 2});
        const ExactNorms norms = exact_norms(view_of(mesh), {});
        EXPECT_NEAR(norms.radius_squared, first_power, 1e-13) << target << " " << n << more;
        EXPECT_NEAR(norms.volume, volume, 1e-13) << target << " " << n << more;
      }
    }
  });
}

TEST(exact_norms, have_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = bumpy_sphere(6, 0.5);
  const ExactNorms one = exact_norms(view_of(mesh), {}, {.threads = 1, .progress = {}});
  for (const int threads : {2, 4}) {
    const ExactNorms more = exact_norms(view_of(mesh), {}, {.threads = threads, .progress = {}});
    EXPECT_EQ(one.radius_squared, more.radius_squared);
    EXPECT_EQ(one.solid_angle, more.solid_angle);
    EXPECT_EQ(one.volume, more.volume);
  }
}

// A repeated corner makes an area that is only rounding, in any direction.
TEST(exact_norms, know_runs_with_faces_without_area) {
  Mesh mesh = test::rotated(bumpy_sphere(4, 0.3));
  const std::size_t n = mesh.faces.size();
  for (std::size_t k = 0; k < 3; ++k) {
    Triangle twice = mesh.faces[700 * k];
    twice[k] = twice[(k + 1) % 3];
    mesh.faces.push_back(twice);
  }
  test::for_each_target([&](const char* target) {
    FaceSizes sizes;
    exact_norms(view_of(mesh), {}, {}, &sizes);
    ASSERT_EQ(sizes.flat.size(), n / FaceSizes::kRun + 1);
    for (std::size_t run = 0; run < sizes.flat.size(); ++run) {
      EXPECT_EQ(sizes.flat[run], run == n / FaceSizes::kRun ? 1 : 0) << target;
    }
    double area = 0, known = 0;
    for (const Triangle& t : mesh.faces) {
      const Vec3 &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
      area += norm(cross(q - p, r - p)) * sizes.scale * sizes.scale;
    }
    for (std::size_t group = 0; group < sizes.area_bits.size(); ++group) {
      known += sizes.twice_area(group);
    }
    EXPECT_NEAR(known / area, 1, 1e-6) << target;
  });
}

// Another process has the mesh and knows only what the job contains.
TEST(exact_norms, have_the_same_bits_where_another_process_sums_ranges) {
  const auto file = test::packed<float>(bumpy_sphere(8), 9);  // more than a million triangles
  const Vec3 center = {0.05, 0.02, 0.01};
  for (const bool with_sizes : {false, true}) {
    FaceSizes alone_sizes, shared_sizes;
    const ExactNorms alone =
        exact_norms(file.view, center, {}, with_sizes ? &alone_sizes : nullptr);
    std::size_t n = 0;
    test::ExecutorBy executor([&](const Parts& parts, const auto& here, const auto& take) {
      n = parts.count;
      EXPECT_EQ(parts.job, kNormsJob);
      const Executor::Work there = norms_work(file.view, parts.input);
      EXPECT_THROW(take(0, "nonsense"), Error);
      for (std::size_t part = 0; part < n; ++part) {
        take(part, part % 2 == 0 ? there(part, 1) : here(part, 1));
      }
    });
    const ExactNorms shared =
        exact_norms(file.view, center, {}, with_sizes ? &shared_sizes : nullptr, &executor);
    EXPECT_GT(n, 2u);
    EXPECT_EQ(shared.radius_squared, alone.radius_squared);
    EXPECT_EQ(shared.solid_angle, alone.solid_angle);
    EXPECT_EQ(shared.volume, alone.volume);
    EXPECT_EQ(shared_sizes.scale, alone_sizes.scale);
    EXPECT_EQ(shared_sizes.area_bits, alone_sizes.area_bits);
    EXPECT_EQ(shared_sizes.angles2, alone_sizes.angles2);
    EXPECT_EQ(shared_sizes.flat, alone_sizes.flat);
    EXPECT_EQ(alone_sizes.angles2.empty(), !with_sizes);
  }
  EXPECT_THROW(norms_work(file.view, "nonsense"), Error);
}

// <1/|x|> and <1/|x|^3> of single triangles at distance 1: every rule up to its reach, then the
// closed form and pieces. The ratio to the volume excludes the rounding of d2.
TEST(exact_norms, mean_powers_of_a_triangle_of_any_size_shape_and_tilt) {
  const double heights[] = {0.866, 0.1, 0.003};
  std::uint64_t seed = 0;
  for (double size = 1e-3; size < 3; size *= 1.13) {
    for (const double height : heights) {
      for (const double foot : {0.5, 0.02}) {  // position of the apex along the longest edge
        for (const double cosine : {1.0, 0.6, 0.15}) {
          const Vec3 u = test::random_direction(1, ++seed);
          const Vec3 side = normalized(cross(u, test::random_direction(2, seed)));
          const Vec3 along = cosine * side + std::sqrt(1 - cosine * cosine) * u;
          const Vec3 up = cross(u, side);
          Mesh mesh;
          mesh.vertices = {u - 0.5 * size * along, u + 0.5 * size * along,
                           u + size * (foot - 0.5) * along + size * height * up};
          mesh.faces = {{0, 1, 2}};
          const ExactNorms norms = exact_norms(view_of(mesh), {});
          const LongNorms exact = oracle(view_of(mesh), {});
          const double error = std::max(std::abs(relative(norms.radius_squared / norms.volume,
                                                          exact.radius_squared / exact.volume)),
                                        std::abs(relative(norms.solid_angle / norms.volume,
                                                          exact.solid_angle / exact.volume)));
          // The oracle's error is added: 2^-64 of the distance over the triangle's height. Needles
          // of more than 256 pieces keep the closed form, which loses 1/height.
          const double limit = 1e-14 + 1e-19 / (size * height) + (size > 1.2 ? 2e-16 / height : 0);
          EXPECT_LT(error, limit) << size << " " << height << " " << foot << " " << cosine;
        }
      }
    }
  }
}

// Means of monomials over a triangle: 2 a! b! c! / (a + b + c + 2)!.
TEST(exact_norms_rules, are_exact_to_degrees_five_and_eight) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  for (const int degree : {5, 8}) {
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) {
        const int c = degree - a - b;
        double sum = 0, weights = 0;
        const auto add = [&](double x, double y, double z, double w) {
          sum += w * std::pow(x, a) * std::pow(y, b) * std::pow(z, c);
          weights += w;
        };
        const auto add_triple = [&](const TripleOrbit& orbit) {
          const double one = 1 - 2 * orbit.a;
          add(one, orbit.a, orbit.a, orbit.weight);
          add(orbit.a, one, orbit.a, orbit.weight);
          add(orbit.a, orbit.a, one, orbit.weight);
        };
        if (degree == 5) {
          for (const TripleOrbit& orbit : kDegree5) add_triple(orbit);
        } else {
          for (const TripleOrbit& orbit : kDegree8) add_triple(orbit);
          const auto& [x, y, w] = kDegree8Six;
          const double z = 1 - x - y;
          for (const auto& p : {Vec3{x, y, z}, Vec3{y, z, x}, Vec3{z, x, y}, Vec3{x, z, y},
                                Vec3{z, y, x}, Vec3{y, x, z}}) {
            add(p.x, p.y, p.z, w);
          }
        }
        add(1.0 / 3, 1.0 / 3, 1.0 / 3, 1 - weights);
        const double mean = 2 * factorial(a) * factorial(b) * factorial(c) / factorial(degree + 2);
        EXPECT_NEAR(sum, mean, 1e-15 * mean + 2e-17) << a << b << c;
      }
    }
  }
}

TEST(exact_norms, tell_how_often_the_centre_is_surrounded) {
  const Mesh sphere = bumpy_sphere(3), small = test::moved(sphere, {.scale = 0.5, .shift = {}});
  EXPECT_TRUE(covers_once(exact_norms(view_of(sphere), {0.1, 0, 0})));
  const ExactNorms twice = exact_norms(view_of(test::joined(sphere, small)), {});
  EXPECT_NEAR(twice.solid_angle, 8 * std::numbers::pi, 1e-13);
  EXPECT_FALSE(covers_once(twice));
  EXPECT_FALSE(covers_once(exact_norms(view_of(sphere), {3, 0, 0})));
}

TEST(exact_norms, count_nothing_without_area_or_seen_edge_on) {
  const Mesh solid = box({2, 2, 2});
  Mesh dirty = solid;
  dirty.vertices.push_back({1, 0, 0});
  dirty.faces.push_back({0, 0, 1});
  dirty.faces.push_back({2, 2, 2});
  dirty.vertices.push_back({0.5, 0, 0});
  dirty.vertices.push_back({0, 0.5, 0});
  const auto n = static_cast<std::uint32_t>(dirty.vertices.size());
  dirty.faces.push_back({n - 3, n - 2, n - 1});  // in the plane z = 0
  const ExactNorms clean = exact_norms(view_of(solid), {}), same = exact_norms(view_of(dirty), {});
  EXPECT_NEAR(same.radius_squared, clean.radius_squared, 1e-14);
  EXPECT_NEAR(same.solid_angle, clean.solid_angle, 1e-14);
  EXPECT_NEAR(same.volume, clean.volume, 1e-14);
}

TEST(exact_norms, are_finite_for_a_centre_on_the_surface) {
  const Mesh solid = box({2, 2, 2});
  for (const Vec3& center : {Vec3{1, 1, 1}, Vec3{1, 1, 0}, Vec3{1, 0.3, 0.2}, Vec3{1, 0, 0},
                             Vec3{1, 1 - 1e-16, 1e-17}}) {
    const ExactNorms norms = exact_norms(view_of(solid), center);
    EXPECT_TRUE(std::isfinite(norms.radius_squared));
    EXPECT_TRUE(std::isfinite(norms.solid_angle));
    EXPECT_NEAR(norms.volume, 8, 1e-13);
  }
}

TEST(exact_norms, scale_with_the_shape) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const double unit = exact_norms(view_of(mesh), {}).radius_squared;
  for (const double scale : {0x1p-480, 0x1p-20, 0x1p480}) {
    const Mesh scaled = test::moved(mesh, {.scale = scale, .shift = {}});
    EXPECT_EQ(exact_norms(view_of(scaled), {}).radius_squared, unit * scale * scale);
  }
}

TEST(exact_norms, refuse_what_is_not_a_mesh) {
  const auto expect_refused = [](const Mesh& mesh) {
    EXPECT_THROW(exact_norms(view_of(mesh), {}), Error);
    EXPECT_THROW(vertex_error_strengths(view_of(mesh), {}), Error);
  };
  Mesh mesh = bumpy_sphere(2);
  mesh.faces[17][1] = 100000;
  expect_refused(mesh);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    mesh = bumpy_sphere(2);
    mesh.vertices[5].y = bad;
    expect_refused(mesh);
  }
  expect_refused({});
}

}  // namespace
}  // namespace rholm
