#include "rholm/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using test::random_coefficients;
using test::random_directions;
using test::relative_difference;

constexpr double kPi = std::numbers::pi;

std::vector<Window> all_windows() {
  std::vector<Window> all;
  for (const WindowInfo& info : windows()) all.push_back(info.window);
  return all;
}

template <typename Call>
void expect_refused(Call call) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
  }
}

// Expands the step independently: Gauss quadrature over [1/2, 1], where the step is 1.
Coefficients step(int degree) {
  Coefficients f(degree);
  const GaussRule rule = gauss_legendre(degree / 2 + 2);
  std::vector<Vec3> directions;
  std::vector<double> weights;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = 0.75 + 0.25 * rule.nodes[i];
    directions.push_back({std::sqrt(1 - x * x), 0, x});
    weights.push_back(2 * kPi * 0.25 * rule.weights[i]);
  }
  add_adjoint({.directions = directions, .weights = weights}, f, {.engine = Engine::kDirect});
  for (int l = 0; l <= degree; ++l) {
    for (int m = 1; m <= l; ++m) f.c(l, m) = f.s(l, m) = 0;  // constant in phi
  }
  return f;
}

// Returns the largest value - 1 and minus the smallest value of a filtered step on a meridian.
Overshoot direct_overshoot(std::span<const double> gains) {
  const int degree = static_cast<int>(gains.size()) - 1;
  const Coefficients f = filter(step(degree), gains);
  std::vector<Vec3> meridian;
  for (int i = 0; i <= 20000; ++i) {
    const double theta = kPi * i / 20000;
    meridian.push_back({std::sin(theta), 0, std::cos(theta)});
  }
  double high = 0, low = 0;
  for (const double value : evaluate(f, meridian, {.engine = Engine::kDirect})) {
    high = std::max(high, value - 1);
    low = std::max(low, -value);
  }
  return {high, low};
}

// Known overshoots of filters on the sphere, each to a fifth. Gibbs' constant is 8.949 % of the
// step.
TEST(filter, overshoot_of_a_spherical_step_is_the_known_one) {
  EXPECT_NEAR(overshoot(Window::kIdeal, 64).above, 0.089, 0.089 / 5);
  EXPECT_NEAR(overshoot(Window::kLanczos, 64).above, 0.014, 0.014 / 5);
  EXPECT_NEAR(overshoot(Window::kLanczos2, 64).above, 0.0046, 0.0046 / 5);
  EXPECT_NEAR(overshoot(Window::kGaussian, 64).above, 0.0026, 0.0026 / 5);
}

TEST(windows, the_overshoot_in_the_table_is_that_of_a_filtered_step) {
  for (const WindowInfo& info : windows()) {
    EXPECT_EQ(fmt::format("{:.2g}", info.overshoot),
              fmt::format("{:.2g}", overshoot(info.window, 64).above))
        << info.name;
  }
}

TEST(windows, each_has_a_name_of_its_own_that_is_read_back) {
  std::set<std::string> names;
  for (const WindowInfo& info : windows()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(parse_window(info.name), info.window);
    EXPECT_EQ(&window_info(info.window), &info);
  }
  EXPECT_TRUE(names.contains("plateau"));  // the table has a row for the last enumerator, too
}

TEST(windows, both_ends_of_a_parameter_are_in_its_range_and_nothing_beyond) {
  for (const WindowInfo& info : windows()) {
    for (const WindowParameter& one : info.parameters) {
      const auto with = [&](double value) {
        WindowOptions options = {.window = info.window};
        one.set(options, value);
        return options;
      };
      for (const double end : {one.min, one.max}) {
        EXPECT_EQ(one.value(with(end)), end) << one.name;
        EXPECT_NO_THROW(low_pass(4, 4, with(end))) << one.name;
      }
      expect_refused([&] { with(one.min - 1); });
      expect_refused([&] { with(one.max + 1); });
      if (one.whole()) expect_refused([&] { with(one.min + 0.5); });
    }
  }
}

TEST(filter, heat_does_not_overshoot) {
  for (const int degree : {4, 64, 100}) {
    EXPECT_EQ(overshoot(Window::kHeat, degree).above, 0) << degree;
    EXPECT_EQ(overshoot(Window::kHeat, degree).below, 0) << degree;
  }
}

TEST(filter, overshoot_is_that_of_the_filtered_values) {
  for (const Window window : all_windows()) {
    for (const int degree : {1, 8, 64}) {
      const std::vector<double> gains = low_pass(degree, 64, {.window = window});
      const Overshoot series = overshoot(gains), direct = direct_overshoot(gains);
      // The parabola between points is exact to a part in a thousand.
      EXPECT_NEAR(series.above, direct.above, 1e-3 * direct.above + 2e-12) << to_string(window);
      EXPECT_NEAR(series.below, direct.below, 1e-3 * direct.below + 2e-12) << to_string(window);
    }
  }
}

TEST(filter, windows_fall_from_one_to_nothing_above_their_degree) {
  for (const Window window : all_windows()) {
    const std::vector<double> gains = low_pass(20, 40, {.window = window});
    ASSERT_EQ(gains.size(), 41u);
    EXPECT_EQ(gains[0], 1) << to_string(window);
    for (int l = 1; l <= 40; ++l) {
      EXPECT_LE(gains[l], gains[l - 1]) << to_string(window) << l;
      EXPECT_GE(gains[l], 0);
      if (window == Window::kHeat) continue;
      if (l > 20) {
        EXPECT_EQ(gains[l], 0) << to_string(window) << l;
      }
    }
    EXPECT_EQ(parse_window(to_string(window)), window);
  }
}

TEST(filter, windows_have_their_closed_forms) {
  const auto at = [](WindowOptions options, int l) { return low_pass(63, 100, options)[l]; };
  EXPECT_EQ(at({.window = Window::kIdeal}, 63), 1);
  EXPECT_NEAR(at({.window = Window::kLanczos}, 32), 2 / kPi, 1e-15);  // sin(pi/2)/(pi/2)
  EXPECT_NEAR(at({.window = Window::kLanczos2}, 32), 4 / (kPi * kPi), 1e-15);
  EXPECT_NEAR(at({.window = Window::kGaussian}, 63), std::exp(-2.4), 1e-15);
  EXPECT_NEAR(at({.window = Window::kHeat}, 63), 0.5, 1e-15);
  EXPECT_NEAR(at({.window = Window::kHeat, .time = 0.01}, 9), std::exp(-0.9), 1e-15);
  EXPECT_NEAR(at({.window = Window::kExponential, .order = 2}, 32), std::exp(-9.0), 1e-18);
  EXPECT_EQ(at({.window = Window::kPlateau}, 32), 1);
  EXPECT_NEAR(at({.window = Window::kPlateau}, 48), 0.5, 1e-15);
}

TEST(filter, low_and_high_pass_add_up_to_the_whole) {
  for (const Window window : all_windows()) {
    const std::vector<double> low = low_pass(9, 30, {.window = window}),
                              high = high_pass(10, 30, {.window = window});
    for (int l = 0; l <= 30; ++l) EXPECT_EQ(low[l] + high[l], 1) << to_string(window) << l;
    EXPECT_EQ(high[0], 0);
  }
}

TEST(filter, ideal_band_keeps_both_its_ends) {
  const std::vector<double> gains = band_pass(3, 5, 8, {.window = Window::kIdeal});
  EXPECT_EQ(gains, (std::vector<double>{0, 0, 0, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(band_pass(0, 5, 8), low_pass(5, 8));
}

TEST(filter, sharpening_undoes_a_mild_blur_to_first_order) {
  // (1 + (1 - g)) g = 1 - (1 - g)^2.
  const std::vector<double> low = low_pass(50, 20, {.window = Window::kHeat});
  const std::vector<double> sharp = sharpened(low, 1);
  for (int l = 0; l <= 20; ++l) {
    EXPECT_NEAR(sharp[l] * low[l], 1 - std::pow(1 - low[l], 2), 1e-15);
  }
  EXPECT_EQ(sharp[0], 1);
}

TEST(filter, coefficients_are_multiplied_and_cut_off) {
  const Coefficients f = random_coefficients(12, 1);
  const std::vector<double> gains = {1, 0.5, -2, 0.25, 0, 0};
  const Coefficients g = filter(f, gains);
  EXPECT_EQ(g.degree(), 3);
  for (int l = 0; l <= 3; ++l) {
    for (int m = 0; m <= l; ++m) {
      EXPECT_EQ(g.c(l, m), gains[l] * f.c(l, m));
      EXPECT_EQ(g.s(l, m), gains[l] * f.s(l, m));
    }
  }
  EXPECT_EQ(filter(f, std::vector<double>{}).degree(), 0);
  EXPECT_EQ(filter(f, std::vector<double>{}).c(0, 0), 0);
  EXPECT_EQ(relative_difference(filter(f, std::vector<double>(40, 1.0)), f), 0);
}

TEST(filter, heat_of_a_positive_function_stays_positive) {
  // A spike on a small sphere, r = 0.01 + exp(40 (z - 1)), has a negative ideal low pass.
  const int degree = 60;
  const GaussRule rule = gauss_legendre(120);
  Coefficients f(degree);
  std::vector<Vec3> nodes;
  std::vector<double> weights;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = rule.nodes[i];
    nodes.push_back({std::sqrt(1 - x * x), 0, x});
    weights.push_back(2 * kPi * rule.weights[i] * (0.01 + std::exp(40 * (x - 1))));
  }
  add_adjoint({.directions = nodes, .weights = weights}, f, {.engine = Engine::kDirect});
  for (int l = 0; l <= degree; ++l) {
    for (int m = 1; m <= l; ++m) f.c(l, m) = f.s(l, m) = 0;
  }
  const auto smallest = [&](const std::vector<double>& gains) {
    const auto values = evaluate(filter(f, gains), random_directions(5000, 1));
    return *std::min_element(values.begin(), values.end());
  };
  EXPECT_LT(smallest(low_pass(6, degree, {.window = Window::kIdeal})), 0);
  for (const double time : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    EXPECT_GT(smallest(low_pass(0, degree, {.window = Window::kHeat, .time = time})), 0.0099);
  }
}

TEST(filter, of_an_expansion_says_so_and_forgets_what_no_longer_holds) {
  Expansion e;
  e.coefficients = random_coefficients(4, 1);
  e.method = "edge";
  e.unit = "km";
  e.center = {1, 2, 3};
  e.norm_squared = 2;
  e.tail_strength = 1;
  e.errors.emplace();
  const Expansion filtered = filter(e, low_pass(2, 4), "low-pass 2 lanczos");
  EXPECT_EQ(filtered.method, "edge, low-pass 2 lanczos");
  EXPECT_EQ(filtered.unit, "km");
  EXPECT_EQ(filtered.center, e.center);
  EXPECT_FALSE(filtered.norm_squared || filtered.tail_strength);
  e.method = std::string(250, 'x');  // leaves no room for more text
  EXPECT_EQ(filter(e, low_pass(2, 4), "low-pass 2 lanczos").method, "low-pass 2 lanczos");
}

// A function of degree 8 that is expanded to degree 6 has all its errors in closed form.
TEST(filter, of_an_expansion_keeps_what_follows_of_the_errors) {
  const Coefficients whole = random_coefficients(8, 2);
  const auto rms_to_whole = [&](const Coefficients& c) {
    const Coefficients all = c.resized(8);
    double sum = 0;
    for (std::size_t i = 0; i < all.values().size(); ++i) {
      sum += std::pow(whole.values()[i] - all.values()[i], 2);
    }
    return std::sqrt(sum / (4 * std::numbers::pi));
  };
  Expansion e;
  e.coefficients = whole.resized(6);
  e.norm_squared = 2;
  e.errors.emplace();
  e.errors->rms = rms_to_whole(e.coefficients);
  e.errors->rms_is_exact = true;
  e.errors->measured_max = 1;
  e.errors->diagonal = 3;
  const auto check = [&](const Expansion& after) {
    ASSERT_TRUE(after.errors && after.errors->rms);
    EXPECT_NEAR(*after.errors->rms, rms_to_whole(after.coefficients), 1e-14);
    EXPECT_TRUE(after.errors->rms_is_exact);
    EXPECT_FALSE(after.errors->measured_max);
    EXPECT_EQ(after.errors->diagonal, 3);
  };
  check(filter(e, low_pass(4, 6), "a"));
  check(filter(e, std::vector<double>{1, 2, -1}, "b"));
  for (const int degree : {0, 3, 5}) {
    const Expansion cut = truncated(e, degree);
    check(cut);
    EXPECT_EQ(cut.coefficients.degree(), degree);
    EXPECT_EQ(cut.norm_squared, e.norm_squared);
  }
  EXPECT_EQ(truncated(e, 6).errors->measured_max, 1);  // nothing is cut off or added
  EXPECT_EQ(truncated(e, 500).coefficients.degree(), 6);
  EXPECT_THROW(truncated(e, -1), Error);
  e.function = RadialFunction::kGauge;
  EXPECT_FALSE(truncated(e, 3).errors->rms);
  e.errors.reset();
  EXPECT_FALSE(truncated(e, 3).errors);
}

TEST(filter, what_is_out_of_range_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([] { low_pass(-1, 4); });
  expect_refused([] { low_pass(4, kMaxDegree + 1); });
  expect_refused([] { low_pass(4, 4, {.order = 0}); });
  expect_refused([] { low_pass(4, 4, {.time = 0.0}); });
  expect_refused([&] { low_pass(4, 4, {.time = nan}); });
  expect_refused([] { high_pass(0, 4); });
  expect_refused([] { band_pass(5, 4, 8); });
  expect_refused([] { band_pass(2, 4, 8, {.window = Window::kHeat, .time = 0.5}); });
  expect_refused([] { overshoot(Window::kLanczos, -1); });
  expect_refused([] { overshoot(Window::kLanczos, kMaxDegree + 1); });
  expect_refused([&] { sharpened(low_pass(4, 4), nan); });
  expect_refused([&] { filter(Coefficients(2), std::vector<double>{1, nan}); });
  expect_refused([] { parse_window("round"); });
  expect_refused([] { to_string(static_cast<Window>(1000)); });
  expect_refused([] { low_pass(4, 4, {.window = static_cast<Window>(-1)}); });
}

}  // namespace
}  // namespace rholm
