#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"

namespace rholm {
namespace {

const SumOptions kDirect{.engine = Engine::kDirect};

using test::inner;
using test::norm_of;
using test::random_coefficients;
using test::random_directions;
using test::random_values;
using test::relative_difference;

constexpr double kPi = std::numbers::pi;

// Returns Y^c_lm or Y^s_lm, by the standard library's associated Legendre function: slow,
// independent.
double slow_harmonic(int l, int m, bool sine, const Vec3& u) {
  const double theta = std::atan2(std::hypot(u.x, u.y), u.z), phi = std::atan2(u.y, u.x);
  const double p = std::sph_legendre(l, m, theta) * (m % 2 ? -1 : 1);  // without its phase
  if (m == 0) return p;
  return std::sqrt(2.0) * p * (sine ? std::sin(m * phi) : std::cos(m * phi));
}

TEST(evaluate, each_harmonic_agrees_with_the_standard_library) {
  // Directions near the poles are left out: the standard library's sqrt(1 - cos^2) loses digits
  // there.
  auto directions = random_directions(40, 1);
  std::erase_if(directions, [](const Vec3& u) { return std::hypot(u.x, u.y) < 0.05; });
  ASSERT_GT(directions.size(), 30u);
  for (int l = 0; l <= 12; ++l) {
    for (int m = 0; m <= l; ++m) {
      for (const bool sine : {false, true}) {
        if (sine && m == 0) continue;
        Coefficients f(12);
        (sine ? f.s(l, m) : f.c(l, m)) = 1;
        const auto values = evaluate(f, directions, kDirect);
        for (std::size_t j = 0; j < directions.size(); ++j) {
          EXPECT_NEAR(values[j], slow_harmonic(l, m, sine, directions[j]), 2e-14);
        }
      }
    }
  }
}

TEST(add_adjoint, is_the_transpose_of_evaluate) {
  for (const int L : {0, 1, 5, 40, 200}) {
    for (const std::size_t n : {1u, 31u, 32u, 33u, 1000u}) {
      const auto directions = random_directions(n, 2);
      const auto weights = random_values(n, 3);
      const Coefficients f = random_coefficients(L, 4);
      Coefficients adjoint(L);
      add_adjoint({.directions = directions, .weights = weights}, adjoint, kDirect);
      const auto values = evaluate(f, directions, kDirect);
      const double scale = norm_of(values) * norm_of(weights);
      EXPECT_NEAR(inner(values, weights), inner(f.values(), adjoint.values()),
                  1e-15 * (10 + L) * scale)
          << L << " " << n;
    }
  }
}

TEST(add_adjoint_gradient, is_the_transpose_of_the_gradient) {
  for (const int L : {0, 1, 2, 5, 64}) {
    const auto directions = random_directions(300, 5);
    std::vector<Vec3> vectors;
    vectors.reserve(directions.size());
    for (std::size_t j = 0; j < directions.size(); ++j) {
      vectors.push_back(cross(directions[j], test::random_direction(6, j)));
    }
    const Coefficients f = random_coefficients(L, 7);
    Coefficients adjoint(L);
    add_adjoint({.directions = directions, .gradients = vectors}, adjoint, kDirect);
    const ValuesAndGradients g = evaluate_with_gradient(f, directions, kDirect);
    double product = 0, scale = 1;
    for (std::size_t j = 0; j < vectors.size(); ++j) {
      product += dot(g.gradients[j], vectors[j]);
      scale += norm(g.gradients[j]);
    }
    EXPECT_NEAR(product, inner(f.values(), adjoint.values()), 1e-15 * (10 + L) * scale) << L;
  }
}

// Directions and weights of a Gauss grid that integrates degree 2L exactly.
struct Grid {
  std::vector<Vec3> directions;
  std::vector<double> weights;
};
Grid gauss_grid(int L) {
  const GaussRule rule = gauss_legendre(L + 1);
  const int n_phi = 2 * L + 1;
  Grid grid;
  for (int i = 0; i <= L; ++i) {
    const double z = rule.nodes[i], s = std::sqrt(1 - z * z);
    for (int k = 0; k < n_phi; ++k) {
      const double phi = 2 * kPi * k / n_phi;
      grid.directions.push_back({s * std::cos(phi), s * std::sin(phi), z});
      grid.weights.push_back(rule.weights[i] * 2 * kPi / n_phi);
    }
  }
  return grid;
}

// On a Gauss grid exact to degree 2L, weights times values give the coefficients again.
TEST(add_adjoint, recovers_the_coefficients_from_a_gauss_grid) {
  for (const int L : {0, 3, 30, 150}) {
    const Coefficients f = random_coefficients(L, 8);
    const auto [directions, weights] = gauss_grid(L);
    std::vector<double> values = evaluate(f, directions, kDirect);
    for (std::size_t j = 0; j < values.size(); ++j) values[j] *= weights[j];
    Coefficients back(L);
    add_adjoint({.directions = directions, .weights = values}, back, kDirect);
    EXPECT_LT(relative_difference(back, f), 1e-15 * (10 + L)) << L;
  }
}

TEST(evaluate_with_gradient, of_z_is_its_tangential_part_poles_included) {
  Coefficients f(1);
  f.c(1, 0) = std::sqrt(4 * kPi / 3);  // f = z
  const auto directions = random_directions(50, 9);
  const ValuesAndGradients g = evaluate_with_gradient(f, directions, kDirect);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const Vec3 expected = Vec3{0, 0, 1} - directions[j].z * directions[j];
    EXPECT_NEAR(g.values[j], directions[j].z, 1e-15);
    EXPECT_LT(norm(g.gradients[j] - expected), 3e-15);
  }
}

// Central differences along two tangents with step h have the error h^2 L^3 / 6 of the amplitude,
// and rounding eps L / h.
TEST(evaluate_with_gradient, agrees_with_central_differences) {
  constexpr int L = 20;
  constexpr double h = 1e-5;
  const Coefficients f = random_coefficients(L, 10);
  const auto directions = random_directions(60, 11);
  const ValuesAndGradients g = evaluate_with_gradient(f, directions, kDirect);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const Vec3 u = directions[j];
    const Vec3 t = normalized(cross(u, std::abs(u.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    EXPECT_NEAR(dot(g.gradients[j], u), 0, 1e-12);
    for (const Vec3& tangent : {t, cross(u, t)}) {
      const std::array<Vec3, 2> ends = {normalized(u + h * tangent), normalized(u - h * tangent)};
      const auto values = evaluate(f, ends, kDirect);
      EXPECT_NEAR(dot(g.gradients[j], tangent), (values[0] - values[1]) / (2 * h), 2e-6);
    }
  }
}

// This also holds where sums of this precision use floats, which end at 3e38. There are many
// directions, so that the fast engine is cheaper.
TEST(evaluate, of_a_function_times_a_power_of_two_is_that_times_its_values) {
  const Coefficients f = random_coefficients(40, 5);
  const auto directions = random_directions(100000, 6);
  for (const double precision : {1e-3, 1e-9}) {
    const SumOptions options{.precision = precision};
    const auto expected = evaluate_with_gradient(f, directions, options);
    for (const double unit : {0x1p-500, 0x1p-140, 0x1p140, 0x1p500}) {
      Coefficients scaled = f;
      for (double& c : scaled.values()) c *= unit;
      const auto found = evaluate_with_gradient(scaled, directions, options);
      const auto values = evaluate(scaled, directions, options);
      double worst = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        worst = std::max({worst, std::abs(found.values[i] / unit - expected.values[i]),
                          std::abs(values[i] / unit - expected.values[i]),
                          norm(found.gradients[i] / unit - expected.gradients[i]) / 40});
      }
      EXPECT_LE(worst, precision * norm_of(f.values())) << unit;
    }
  }
}

TEST(evaluate_rings, agrees_with_scattered_directions) {
  const Coefficients f = random_coefficients(25, 12);
  const std::vector<double> colatitudes = {0, 1e-8, 0.4, kPi / 2, 3, kPi};
  for (const int n_phi : {1, 2, 7, 51, 200}) {
    const auto values = evaluate_rings(f, colatitudes, n_phi);
    std::vector<Vec3> directions;
    for (const double theta : colatitudes) {
      for (int k = 0; k < n_phi; ++k) {
        const double phi = 2 * kPi * k / n_phi;
        directions.push_back(
            {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      }
    }
    const auto expected = evaluate(f, directions, kDirect);
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t j = 0; j < values.size(); ++j) EXPECT_NEAR(values[j], expected[j], 2e-13);
  }
}

TEST(transforms, give_the_same_bits_for_any_number_of_threads) {
  const auto directions = random_directions(3000, 13);
  const auto weights = random_values(3000, 14);
  const Coefficients f = random_coefficients(70, 15);
  const auto values = evaluate(f, directions, kDirect, {.threads = 1});
  Coefficients adjoint(70);
  add_adjoint({.directions = directions, .weights = weights}, adjoint, kDirect, {.threads = 1});
  for (const int threads : {2, 4}) {
    EXPECT_EQ(values, evaluate(f, directions, kDirect, {.threads = threads}));
    Coefficients again(70);
    add_adjoint({.directions = directions, .weights = weights}, again, kDirect,
                {.threads = threads});
    EXPECT_TRUE(
        std::equal(adjoint.values().begin(), adjoint.values().end(), again.values().begin()));
  }
}

// A rotation mixes the orders of a degree by an orthogonal matrix: the energy per degree is
// constant.
TEST(power_spectrum, does_not_change_under_rotation) {
  constexpr int L = 24;
  const Coefficients f = random_coefficients(L, 16);
  const double a = 0.7, b = 1.9;
  const auto rotate = [&](const Vec3& u) {
    const Vec3 v = {std::cos(a) * u.x - std::sin(a) * u.y, std::sin(a) * u.x + std::cos(a) * u.y,
                    u.z};
    return Vec3{v.x, std::cos(b) * v.y - std::sin(b) * v.z, std::sin(b) * v.y + std::cos(b) * v.z};
  };
  const auto [directions, weights] = gauss_grid(L);
  std::vector<Vec3> rotated;
  rotated.reserve(directions.size());
  for (const Vec3& u : directions) rotated.push_back(rotate(u));
  std::vector<double> values = evaluate(f, rotated, kDirect);
  for (std::size_t j = 0; j < values.size(); ++j) values[j] *= weights[j];
  Coefficients turned(L);
  add_adjoint({.directions = directions, .weights = values}, turned, kDirect);
  EXPECT_GT(relative_difference(turned, f), 0.5);
  const auto before = power_spectrum(f), after = power_spectrum(turned);
  for (int l = 0; l <= L; ++l) EXPECT_NEAR(after[l], before[l], 1e-13 * (1 + before[l])) << l;
}

TEST(transforms, can_be_cancelled) {
  const Context context{.threads = 1, .progress = [](std::string_view, double) { return false; }};
  const auto directions = random_directions(100, 17);
  EXPECT_THROW(evaluate(random_coefficients(10, 1), directions, kDirect, context), Error);
}

TEST(transforms, refuse_weights_that_do_not_match_the_directions) {
  Coefficients sum(3);
  EXPECT_THROW(add_adjoint({.directions = random_directions(10, 1), .weights = random_values(9, 1)},
                           sum, kDirect),
               Error);
  EXPECT_THROW(
      add_adjoint({.directions = random_directions(10, 1), .gradients = std::vector<Vec3>(11)}, sum,
                  kDirect),
      Error);
  EXPECT_THROW(evaluate_rings(sum, std::vector<double>{1.0}, 0), Error);
  EXPECT_THROW(gauss_legendre(0), Error);
}

TEST(transforms, refuse_precisions_and_engines_that_there_are_not) {
  const auto directions = random_directions(10, 1);
  for (const double precision : {0.0, 1e-15, 0.2, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(evaluate(Coefficients(3), directions, {.precision = precision}), Error);
  }
  for (const Engine engine : {Engine::kFast, Engine::kDirect}) {
    EXPECT_EQ(parse_name<Engine>(to_string(engine)), engine);
  }
  EXPECT_THROW(parse_name<Engine>("slow"), Error);
}

}  // namespace
}  // namespace rholm
