// Harmonics of low degree in lanes, compared with the sums at scattered directions of harmonic.h.
#include "harmonic/legendre/low_harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/legendre/low_harmonics_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "harmonic/legendre/low_harmonics-inl.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"
#include "support/targets.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

// Puts one direction into all lanes.
LowDirection<V> Towards(const double* u) {
  const D d;
  LowDirection<V> at;
  at.x = hn::Set(d, u[0]), at.y = hn::Set(d, u[1]), at.z = hn::Set(d, u[2]);
  at.s1 = hn::Set(d, u[0] / (1 + u[2])), at.s2 = hn::Set(d, u[1] / (1 + u[2]));
  return at;
}

// Returns value and slopes of lane 0.
void SumAt(int degree, bool even, const double* c, const double* u, double* out) {
  const LowSum<V> sum = SumLowHarmonics(D(), degree, even, c, Towards(u));
  out[0] = hn::GetLane(sum.value), out[1] = hn::GetLane(sum.d1), out[2] = hn::GetLane(sum.d2);
}

void SumPowersAt(int degree, const double* powers, const double* u, double* out) {
  const LowDirection<V> at = Towards(u);
  const LowSum<V> sum = degree == 0   ? SumPowers<0>(D(), powers, at)
                        : degree == 1 ? SumPowers<1>(D(), powers, at)
                        : degree == 3 ? SumPowers<3>(D(), powers, at)
                                      : SumPowers<kMaxPowersDegree>(D(), powers, at);
  out[0] = hn::GetLane(sum.value), out[1] = hn::GetLane(sum.d1), out[2] = hn::GetLane(sum.d2);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(SumAt);
HWY_EXPORT(SumPowersAt);

struct Sum {
  double value = 0, d1 = 0, d2 = 0;
};
Sum sum_at(int degree, bool even, const std::vector<double>& c, const Vec3& u) {
  const double direction[3] = {u.x, u.y, u.z};
  double out[3];
  HWY_DYNAMIC_DISPATCH(SumAt)(degree, even, c.data(), direction, out);
  return {out[0], out[1], out[2]};
}

// Lists coefficients in the order of atlas.h.
std::vector<double> listed(const Coefficients& f, bool even) {
  std::vector<double> c;
  for (int l = 0; l <= f.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      if (even && (l + m) % 2 != 0) continue;
      c.push_back(f.c(l, m));
      if (m > 0) c.push_back(f.s(l, m));
    }
  }
  return c;
}

// Returns directions away from the south pole, which has no place in the plane.
std::vector<Vec3> directions() {
  std::vector<Vec3> all = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {1e-9, 0, 1}};
  for (std::uint64_t i = 0; all.size() < 60; ++i) {
    const Vec3 u = test::random_direction(3, i);
    if (u.z > -0.95) all.push_back(u);
  }
  return all;
}

Coefficients random_even(int degree, bool even) {
  Coefficients f = test::random_coefficients(degree, 5);
  for (int l = 0; l <= degree && even; ++l) {
    for (int m = (l + 1) % 2; m <= l; m += 2) f.c(l, m) = f.s(l, m) = 0;
  }
  return f;
}

// Returns e_i - s_i (u + e_3), the unit tangents along the axes of the stereographic plane.
Vec3 tangent(const Vec3& u, int axis) {
  const double s = (axis == 0 ? u.x : u.y) / (1 + u.z);
  const Vec3 e = axis == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return e - s * (u + Vec3{0, 0, 1});
}

TEST(LowHarmonics, indices_count_up_in_the_order_of_the_atlas) {
  std::size_t next = 0, next_even = 0;
  for (int l = 0; l <= kMaxLowDegree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const std::size_t width = m == 0 ? 1 : 2;
      EXPECT_EQ(low_index(l, m), next);
      next += width;
      if ((l + m) % 2 != 0) continue;
      EXPECT_EQ(even_index(l, m), next_even);
      next_even += width;
    }
  }
}

TEST(LowHarmonics, tangents_of_the_plane_are_orthonormal) {
  for (const Vec3& u : directions()) {
    const Vec3 a = tangent(u, 0), b = tangent(u, 1);
    EXPECT_NEAR(dot(a, a), 1, 1e-14);
    EXPECT_NEAR(dot(b, b), 1, 1e-14);
    EXPECT_NEAR(dot(a, b), 0, 1e-14);
    EXPECT_NEAR(dot(a, u), 0, 1e-14);
  }
}

TEST(LowHarmonics, sums_and_slopes_are_those_of_scattered_directions) {
  test::for_each_target([](const char* target) {
    for (const int degree : {0, 1, 2, 3, 6, 14, kMaxLowDegree}) {
      for (const bool even : {false, true}) {
        SCOPED_TRACE(std::string(target) + " " + std::to_string(degree));
        const Coefficients f = random_even(degree, even);
        const std::vector<double> c = listed(f, even);
        const std::vector<Vec3> at = directions();
        const ValuesAndGradients expected =
            evaluate_with_gradient(f, at, {.engine = Engine::kDirect});
        // There are (L+1)^2 coefficients of at most 1. A recurrence of l steps loses at most l^2
        // roundings.
        const double size = (degree + 1.0) * (degree + 1.0), eps = 1e-15 * size * (degree + 1);
        for (std::size_t i = 0; i < at.size(); ++i) {
          const Sum sum = sum_at(degree, even, c, at[i]);
          EXPECT_NEAR(sum.value, expected.values[i], eps);
          EXPECT_NEAR(sum.d1, dot(expected.gradients[i], tangent(at[i], 0)), (degree + 1) * eps);
          EXPECT_NEAR(sum.d2, dot(expected.gradients[i], tangent(at[i], 1)), (degree + 1) * eps);
        }
      }
    }
  });
}

TEST(LowHarmonics, powers_sum_to_the_same) {
  test::for_each_target([](const char* target) {
    for (const int degree : {0, 1, 3, kMaxPowersDegree}) {
      SCOPED_TRACE(std::string(target) + " " + std::to_string(degree));
      const std::vector<double> c = listed(test::random_coefficients(degree, 9), false);
      std::vector<double> powers(c.size(), NAN);
      to_powers(degree, c.data(), powers.data());
      // The sum has (L+1)^2 terms, which grow by the factor (1 + sqrt(2))^L.
      const double eps = 1e-15 * (degree + 1) * (degree + 1) * std::pow(1 + std::sqrt(2), degree);
      for (const Vec3& u : directions()) {
        const double direction[3] = {u.x, u.y, u.z};
        double out[3];
        HWY_DYNAMIC_DISPATCH(SumPowersAt)(degree, powers.data(), direction, out);
        const Sum sum = sum_at(degree, false, c, u);
        EXPECT_NEAR(out[0], sum.value, eps);
        EXPECT_NEAR(out[1], sum.d1, (degree + 1) * eps);
        EXPECT_NEAR(out[2], sum.d2, (degree + 1) * eps);
      }
    }
  });
}

TEST(LowHarmonics, slopes_are_differences_of_values) {
  const int degree = 6;
  constexpr double h = 1e-5;
  const std::vector<double> c = listed(test::random_coefficients(degree, 8), false);
  for (const Vec3& u : directions()) {
    const Sum sum = sum_at(degree, false, c, u);
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 t = tangent(u, axis);
      const double ahead = sum_at(degree, false, c, normalized(u + h * t)).value;
      const double behind = sum_at(degree, false, c, normalized(u - h * t)).value;
      // Differences lose h^2 / 6 of third derivatives, at most L^3 times the sum, and rounding over
      // h.
      EXPECT_NEAR((ahead - behind) / (2 * h), axis == 0 ? sum.d1 : sum.d2, 1e-7);
    }
  }
}

}  // namespace
}  // namespace rholm
#endif
