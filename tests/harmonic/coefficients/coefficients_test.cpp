#include "rholm/coefficients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "harmonic/coefficients/laplacian.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

Coefficients random_coefficients(int degree) {
  Coefficients result(degree);
  std::uint64_t counter = 0;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      result.c(l, m) = random_uniform(1, counter++) - 0.5;
      if (m > 0) result.s(l, m) = random_uniform(1, counter++) - 0.5;
    }
  }
  return result;
}

const Convention kAllConventions[] = {
    {Normalization::kOrthonormal, 1}, {Normalization::kOrthonormal, -1},
    {Normalization::kFourPi, 1},      {Normalization::kFourPi, -1},
    {Normalization::kSchmidt, 1},     {Normalization::kSchmidt, -1}};

template <typename Call>
ErrorCode code_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "no error";
  return ErrorCode::kCancelled;
}

TEST(coefficients, are_an_array_of_two_square_planes) {
  Coefficients coefficients(2);
  ASSERT_EQ(coefficients.values().size(), 18u);
  for (const double value : coefficients.values()) EXPECT_EQ(value, 0);
  coefficients.c(2, 1) = 7;
  coefficients.s(1, 1) = 8;
  EXPECT_EQ(coefficients.values()[2 * 3 + 1], 7);
  EXPECT_EQ(coefficients.values()[9 + 1 * 3 + 1], 8);
  EXPECT_EQ(Coefficients().degree(), 0);
}

TEST(coefficients, degree_out_of_range_is_refused) {
  for (const int degree :
       {-1, std::numeric_limits<int>::min(), kMaxDegree + 1, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(code_of([&] { Coefficients{degree}; }), ErrorCode::kInvalidInput);
  }
}

TEST(coefficients, resized_cuts_off_or_fills_with_zeros) {
  const Coefficients four = random_coefficients(4);
  for (const int degree : {0, 2, 4, 7}) {
    const Coefficients resized = four.resized(degree);
    ASSERT_EQ(resized.degree(), degree);
    for (int l = 0; l <= degree; ++l) {
      for (int m = 0; m <= l; ++m) {
        EXPECT_EQ(resized.c(l, m), l <= 4 ? four.c(l, m) : 0);
        EXPECT_EQ(resized.s(l, m), l <= 4 ? four.s(l, m) : 0);
      }
    }
  }
}

// The constant function 1 has the coefficient sqrt(4 pi) in the orthonormal basis, where Y_00 is
// 1/sqrt(4 pi). It has the coefficient 1 where Y_00 = 1. The function z is cos theta, or sqrt(4 pi
// / 3) Y_10. Its coefficient is 1/sqrt(3) where Y_10 = sqrt(3) z (mean square 1), and 1 where Y_10
// = z (mean square 1/3). For x and C_11, y and S_11 the sign changes if the basis has the phase.
TEST(conventions, constant_and_coordinates_have_their_textbook_coefficients) {
  Coefficients f(1);
  f.c(0, 0) = std::sqrt(4 * kPi);
  f.c(1, 0) = std::sqrt(4 * kPi / 3);
  f.c(1, 1) = 2 * std::sqrt(4 * kPi / 3);
  f.s(1, 1) = 3 * std::sqrt(4 * kPi / 3);
  for (const int csphase : {1, -1}) {
    const Coefficients four_pi = to_convention(f, {Normalization::kFourPi, csphase});
    EXPECT_DOUBLE_EQ(four_pi.c(0, 0), 1);
    EXPECT_DOUBLE_EQ(four_pi.c(1, 0), 1 / std::sqrt(3));
    EXPECT_DOUBLE_EQ(four_pi.c(1, 1), csphase * 2 / std::sqrt(3));
    EXPECT_DOUBLE_EQ(four_pi.s(1, 1), csphase * 3 / std::sqrt(3));
    const Coefficients schmidt = to_convention(f, {Normalization::kSchmidt, csphase});
    EXPECT_DOUBLE_EQ(schmidt.c(0, 0), 1);
    EXPECT_DOUBLE_EQ(schmidt.c(1, 0), 1);
    EXPECT_DOUBLE_EQ(schmidt.c(1, 1), csphase * 2);
    EXPECT_DOUBLE_EQ(schmidt.s(1, 1), csphase * 3);
  }
}

// The mean square of f is (1/4 pi) sum C^2 = sum C_4pi^2 = sum C_S^2 / (2l+1).
TEST(conventions, mean_square_is_the_same_in_all_of_them) {
  const Coefficients f = random_coefficients(20);
  for (const Convention& convention : kAllConventions) {
    const auto internal = power_spectrum(f);
    const auto external = power_spectrum(to_convention(f, convention));
    for (int l = 0; l <= 20; ++l) {
      const double mean_square =
          convention.normalization == Normalization::kOrthonormal ? external[l] / (4 * kPi)
          : convention.normalization == Normalization::kFourPi    ? external[l]
                                                                  : external[l] / (2 * l + 1);
      EXPECT_NEAR(mean_square, internal[l] / (4 * kPi), 1e-15 * (2 * l + 1));
    }
  }
}

TEST(conventions, phase_turns_the_sign_of_odd_orders_only) {
  const Coefficients f = random_coefficients(5);
  const Coefficients turned = to_convention(f, {Normalization::kOrthonormal, -1});
  for (int l = 0; l <= 5; ++l) {
    for (int m = 0; m <= l; ++m) {
      const int sign = m % 2 == 0 ? 1 : -1;
      EXPECT_EQ(turned.c(l, m), sign * f.c(l, m));
      EXPECT_EQ(turned.s(l, m), sign * f.s(l, m));
    }
  }
}

// x / k * k, with both results rounded: the quotient has the relative error 2^-53. Its product with
// k differs from x by less than one unit in the last place. The rounded product is therefore x or
// one of its neighbours.
TEST(conventions, there_and_back_is_within_one_unit_in_the_last_place) {
  const Coefficients f = random_coefficients(40);
  for (const Convention& convention : kAllConventions) {
    const Coefficients back = from_convention(to_convention(f, convention), convention);
    for (std::size_t i = 0; i < f.values().size(); ++i) {
      const double x = f.values()[i], y = back.values()[i];
      EXPECT_TRUE(y == x || y == std::nextafter(x, INFINITY) || y == std::nextafter(x, -INFINITY));
      if (convention.normalization == Normalization::kOrthonormal) {
        EXPECT_EQ(y, x);
      }
    }
  }
}

TEST(conventions, unit_sphere_is_exactly_one) {
  Coefficients f(0);
  f.c(0, 0) = std::sqrt(4 * kPi);
  EXPECT_EQ(to_convention(f, {Normalization::kFourPi, 1}).c(0, 0), 1);
  EXPECT_EQ(to_convention(f, {Normalization::kSchmidt, -1}).c(0, 0), 1);
}

TEST(conventions, other_phases_are_refused) {
  for (const int csphase : {0, 2, -2}) {
    EXPECT_EQ(code_of([&] {
                to_convention({}, {Normalization::kFourPi, csphase});
              }),
              ErrorCode::kInvalidInput);
    EXPECT_EQ(code_of([&] {
                from_convention({}, {Normalization::kFourPi, csphase});
              }),
              ErrorCode::kInvalidInput);
  }
}

TEST(conventions, names_read_back) {
  for (const auto normalization :
       {Normalization::kOrthonormal, Normalization::kFourPi, Normalization::kSchmidt}) {
    EXPECT_EQ(parse_name<Normalization>(to_string(normalization)), normalization);
  }
  for (const auto function : {RadialFunction::kRadius, RadialFunction::kGauge}) {
    EXPECT_EQ(parse_name<RadialFunction>(to_string(function)), function);
  }
  EXPECT_EQ(code_of([] { parse_name<Normalization>("4PI "); }), ErrorCode::kInvalidInput);
  EXPECT_EQ(code_of([] { parse_name<RadialFunction>(""); }), ErrorCode::kInvalidInput);
}

TEST(power_spectrum, is_the_energy_of_each_degree) {
  Coefficients f(3);
  f.c(1, 0) = 3;
  f.c(1, 1) = -4;
  f.c(3, 2) = 1;
  f.s(3, 3) = 2;
  EXPECT_EQ(power_spectrum(f), (std::vector<double>{0, 25, 0, 5}));
}

TEST(divide_by_eigenvalue, undoes_the_laplacian_but_for_the_mean_which_it_has_lost) {
  const Coefficients given = random_coefficients(9);
  Coefficients c = given;
  divide_by_eigenvalue(c);
  EXPECT_EQ(c.c(0, 0), 0);
  for (int l = 1; l <= c.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      EXPECT_DOUBLE_EQ(c.c(l, m) * (l * (l + 1)), given.c(l, m));
      EXPECT_DOUBLE_EQ(c.s(l, m) * (l * (l + 1)), given.s(l, m));
    }
  }
}

}  // namespace
}  // namespace rholm
