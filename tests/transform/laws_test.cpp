// Closed forms and identities of docs/method.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rholm/transform.h"
#include "support/oracle.h"
#include "support/random_data.h"
#include "support/test_shapes.h"
#include "transform/geometry/star_geometry.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

using test::chart_about;

constexpr double kPi = std::numbers::pi;

std::array<Vec3, 3> random_triangle(std::uint64_t seed) {
  std::array<Vec3, 3> p;
  do {
    for (std::uint64_t i = 0; i < 3; ++i) {
      p[i] = (0.5 + random_uniform(seed, 100 + i)) * test::random_direction(seed, i);
    }
    ++seed;
  } while (dot(p[0], cross(p[1], p[2])) < 0.05);
  return p;
}

// Returns the angle of a spherical triangle at p between the arcs to q and r.
double corner_angle(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 a = cross(p, q), b = cross(p, r);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

TEST(solid_angle, is_the_spherical_excess) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto p = random_triangle(1000 * seed);
    double excess = -kPi;
    for (int i = 0; i < 3; ++i) excess += corner_angle(p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
    EXPECT_NEAR(solid_angle(p), excess, 1e-13);
    EXPECT_NEAR(solid_angle({p[0], p[2], p[1]}), -excess, 1e-13);
  }
}

TEST(solid_angle, of_a_closed_mesh_is_4_pi_from_inside_and_0_from_outside) {
  for (const double shift : {0.0, 0.7, 3.0}) {
    double sum = 0;
    const Mesh mesh = bumpy_sphere(3);
    for (const Triangle& t : mesh.faces) {
      const Vec3 c = {shift, 0, 0};
      sum +=
          solid_angle({mesh.vertices[t[0]] - c, mesh.vertices[t[1]] - c, mesh.vertices[t[2]] - c});
    }
    EXPECT_NEAR(sum, shift < 1 ? 4 * kPi : 0, 1e-12);
  }
}

// Lambert: int_T u dOmega is half the sum over edges of angle times inward normal of the arc.
TEST(visit_triangle, integrates_u_over_a_spherical_triangle_as_lambert_says) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto p = random_triangle(1000 * seed);
    Vec3 expected;
    for (int i = 0; i < 3; ++i) {
      const Vec3 n = cross(p[i], p[(i + 1) % 3]);
      expected += 0.5 * std::atan2(norm(n), dot(p[i], p[(i + 1) % 3])) * normalized(n);
    }
    // dOmega = d dS / |x|^3. The bound is for 1/|x|^2, so that 100 times the precision is
    // requested.
    const double volume = dot(p[0], cross(p[1], p[2]));
    Vec3 sum;
    visit_triangle(p, {.allowed = 1e-14, .degree = 1, .growth = Growth::kFlatInverseSquare},
                   [&](const Vec3& x, double w) {
                     const double r = norm(x);
                     sum += w * volume / 2 / (r * r * r) * (x / r);
                   });
    EXPECT_LT(norm(sum - expected), 1e-12) << seed;
  }
}

// Compares the bound E(p; l) with the true error of the mean of all 2l+1 harmonics.
TEST(quadrature_error, bounds_the_error_on_random_segments_and_triangles) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const auto big = random_triangle(1000 * seed);
    const double shrink = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 0.3 : 0.05;
    std::array<Vec3, 3> p = big;
    for (int i = 1; i < 3; ++i) p[i] = big[0] + shrink * (big[i] - big[0]);
    double longest = 0;
    for (int i = 0; i < 3; ++i) longest = std::max(longest, norm(p[(i + 1) % 3] - p[i]));
    for (const int l : {1, 5, 20, 60}) {
      const auto mean_of = [&](const std::vector<Vec3>& x, const std::vector<double>& w) {
        Coefficients sum(l);
        std::vector<Vec3> u;
        u.reserve(x.size());
        for (const Vec3& v : x) u.push_back(normalized(v));
        add_adjoint({.directions = u, .weights = w}, sum, {.engine = Engine::kDirect});
        return sum;
      };
      const auto error_of = [&](const Coefficients& a, const Coefficients& b) {
        double square = 0;
        for (int m = 0; m <= l; ++m) {
          square += std::pow(a.c(l, m) - b.c(l, m), 2) + std::pow(a.s(l, m) - b.s(l, m), 2);
        }
        return std::sqrt(square / ((2 * l + 1) / (4 * kPi)));
      };
      const auto segment = [&](const GaussRule& rule) {
        std::vector<Vec3> x;
        x.reserve(rule.nodes.size());
        for (const double t : rule.nodes) x.push_back(p[0] + t * (p[1] - p[0]));
        return mean_of(x, rule.weights);
      };
      GaussRule fine = gauss_legendre(200);
      for (double& x : fine.nodes) x = (1 + x) / 2;
      for (double& w : fine.weights) w /= 2;
      const Coefficients exact = segment(fine);
      const double half = norm(p[1] - p[0]) / 2, away = segment_distance(p[0], p[1]);
      for (int exactness = 1; exactness <= kMaxExactness; exactness += 2) {
        EXPECT_LE(error_of(segment(segment_rule(exactness)), exact),
                  quadrature_error(exactness, half, away, l, Growth::kFlat) + 1e-13)
            << seed << " " << l << " " << exactness;
      }
      const auto triangle = [&](int exactness) {
        std::vector<Vec3> x;
        std::vector<double> w;
        visit_triangle_rule(exactness, [&](double a, double b, double c, double weight) {
          x.push_back(a * p[0] + b * p[1] + c * p[2]);
          w.push_back(weight);
        });
        return mean_of(x, w);
      };
      const Coefficients exact_face = triangle(kMaxExactness);
      const double face_away = triangle_distance(p);
      if (quadrature_error(kMaxExactness, longest / 2, face_away, l, Growth::kFlat) > 1e-13) {
        continue;  // no reference: these triangles are halved first
      }
      for (const int exactness : {1, 2, 3, 4, 5, 6, 7, 8, 10, 15, 20, 30, 40}) {
        EXPECT_LE(error_of(triangle(exactness), exact_face),
                  quadrature_error(exactness, longest / 2, face_away, l, Growth::kFlat) + 1e-13)
            << seed << " " << l << " " << exactness;
      }
    }
  }
}

// int over the unit triangle of x^i y^j = i! j! / (i+j+2)!, times 2 for the mean.
TEST(visit_triangle_rule, is_exact_to_its_degree) {
  for (int exactness = 1; exactness <= 24; ++exactness) {
    for (int i = 0; i <= exactness; ++i) {
      for (int j = 0; i + j <= exactness; ++j) {
        double sum = 0;
        visit_triangle_rule(exactness, [&](double, double x, double y, double weight) {
          EXPECT_GT(weight, 0);
          sum += weight * std::pow(x, i) * std::pow(y, j);
        });
        const double expected =
            2 * std::exp(std::lgamma(i + 1) + std::lgamma(j + 1) - std::lgamma(i + j + 3));
        EXPECT_NEAR(sum, expected, 1e-14 * (1 + expected)) << exactness << " " << i << " " << j;
      }
    }
  }
}

TEST(expand_chart, ellipsoid_has_even_degrees_and_orders_only) {
  const StarChart chart = chart_about(ellipsoid({1, 0.8, 0.5}, 3), {0, 0, 0});
  for (const Method method : {Method::kEdge, Method::kGauge, Method::kCurl, Method::kArea}) {
    const Coefficients c =
        expand(chart, {.degree = 12, .method = method, .precision = 1e-12}).expansion.coefficients;
    EXPECT_GT(std::abs(c.c(2, 2)), 0.01);
    for (int l = 0; l <= 12; ++l) {
      for (int m = 0; m <= l; ++m) {
        if (l % 2 || m % 2) {
          EXPECT_NEAR(c.c(l, m), 0, 1e-12) << to_string(method);
        }
        EXPECT_NEAR(c.s(l, m), 0, 1e-12) << to_string(method);
      }
    }
  }
}

TEST(expand_chart, cube_has_even_degrees_and_orders_that_are_multiples_of_4_only) {
  const StarChart chart = chart_about(box({2, 2, 2}), {0, 0, 0});
  for (const Method method : {Method::kEdge, Method::kGauge, Method::kCurl, Method::kArea}) {
    const Coefficients c =
        expand(chart, {.degree = 16, .method = method, .precision = 1e-12}).expansion.coefficients;
    EXPECT_GT(std::abs(c.c(4, 4)), 0.01);
    for (int l = 0; l <= 16; ++l) {
      for (int m = 0; m <= l; ++m) {
        if (l % 2 || m % 4) {
          EXPECT_NEAR(c.c(l, m), 0, 1e-12) << to_string(method);
        }
        EXPECT_NEAR(c.s(l, m), 0, 1e-12) << to_string(method);
      }
    }
    // The cube has no quadrupole moment.
    EXPECT_NEAR(c.c(2, 0), 0, 1e-12);
  }
}

// r(u) = 1/|u - d| has the coefficients 4 pi/(2l+1) |d|^l Y_lm(d/|d|). A mesh through its points at
// spacing h differs by O(h^2): each subdivision divides the error by four.
TEST(expand_chart, sampled_inverse_distance_converges_to_its_closed_form) {
  const Vec3 d = {0.2, -0.3, 0.25};
  constexpr int L = 10;
  Coefficients expected(L);
  const std::array<Vec3, 1> direction = {normalized(d)};
  const std::array<double, 1> one = {1};
  add_adjoint({.directions = direction, .weights = one}, expected, {.engine = Engine::kDirect});
  for (int l = 0; l <= L; ++l) {
    for (int m = 0; m <= l; ++m) {
      expected.c(l, m) *= 4 * kPi / (2 * l + 1) * std::pow(norm(d), l);
      expected.s(l, m) *= 4 * kPi / (2 * l + 1) * std::pow(norm(d), l);
    }
  }
  double last = 0;
  for (const int subdivisions : {3, 4, 5}) {
    Mesh mesh = icosphere(subdivisions);
    for (Vec3& v : mesh.vertices) v *= 1 / norm(v - d);
    const Coefficients c = expand(chart_about(mesh, {0, 0, 0}), {.degree = L, .precision = 1e-6})
                               .expansion.coefficients;
    const double error = test::relative_error(c, expected);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.2);
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(norm_squared, closed_forms_agree_with_cubature) {
  for (const auto& [mesh, center] :
       {std::pair{test::rotated(bumpy_sphere(1)), Vec3{0.1, -0.1, 0.2}},
        std::pair{test::random_octahedron(7), Vec3{0, 0, 0}},
        std::pair{box({2, 1, 3}), Vec3{0.2, 0.1, -0.5}}}) {
    const StarChart chart = chart_about(mesh, center);
    double radius = 0, gauge = 0;
    test::visit_oracle_nodes(chart.mesh, 60, [&](const Vec3& x, double solid) {
      radius += dot(x, x) * solid;
      gauge += solid / dot(x, x);
    });
    EXPECT_NEAR(radius_norm_squared(chart) / radius, 1, 1e-11);
    EXPECT_NEAR(gauge_norm_squared(chart) / gauge, 1, 1e-11);
  }
}

// Parseval: the remainder of (M7) after L degrees is the tail, about S/(3 pi (L+1/2)^3).
TEST(expand_chart, truncation_error_is_the_predicted_tail_on_a_coarse_mesh) {
  const StarChart chart = chart_about(test::rotated(bumpy_sphere(0, 0.3)), {0.1, 0.05, -0.2});
  for (const Method method : {Method::kEdge, Method::kGauge}) {
    for (const int L : {32, 64, 128}) {
      const Transform a = expand(chart, {.degree = L, .method = method, .precision = 1e-12});
      const double tail = *a.expansion.tail_strength / (3 * kPi * std::pow(L + 0.5, 3));
      EXPECT_NEAR(4 * kPi * std::pow(*a.truncation_rms, 2) / tail, 1, 0.1)
          << to_string(method) << " " << L;
    }
  }
}

// On a closed mesh, degree 1 of the edge sums vanishes identically; a missing edge breaks this.
TEST(closure_residual, is_rounding_for_closed_meshes_and_large_for_a_broken_one) {
  StarChart chart = chart_about(bumpy_sphere(3), {0.1, 0.2, 0});
  EXPECT_LT(closure_residual(star_geometry(chart)), 1e-14);
  chart.edges.pop_back();
  EXPECT_GT(closure_residual(star_geometry(chart)), 1e-7);
}

}  // namespace
}  // namespace rholm
