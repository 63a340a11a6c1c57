#include "rholm/length_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "rholm/error.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

TEST(LengthUnit, symbols_and_words_of_one_unit_are_equal) {
  for (const char* name : {"km", "KM", "Km", "kilometre", "Kilometers", "kilometer"}) {
    EXPECT_EQ(metres_of(name), 1000.0) << name;
  }
  for (const char* name : {"um", "\u00b5m", "\u03bcm", "micron", "microns", "micrometre"}) {
    EXPECT_EQ(metres_of(name), 1e-6) << name;
  }
  EXPECT_EQ(metres_of("feet"), 0.3048);  // exact by definition, since 1959
  EXPECT_EQ(metres_of("in"), metres_of("inches"));
}

TEST(LengthUnit, capitals_of_symbols_count) {
  EXPECT_EQ(metres_of("mm"), 1e-3);
  EXPECT_EQ(metres_of("Mm"), 1e6);
  EXPECT_EQ(metres_of("M"), std::nullopt);
}

TEST(LengthUnit, other_texts_are_none) {
  for (const char* name : {"", "s", "parsec", "km ", "m2", "voxel"}) {
    EXPECT_EQ(metres_of(name), std::nullopt) << name;
  }
}

Expansion some_expansion(RadialFunction function) {
  Expansion e;
  e.coefficients = Coefficients(2);
  e.function = function;
  e.center = {1, -2, 3};
  e.coefficients.c(0, 0) = 5 * std::sqrt(4 * std::numbers::pi);
  e.coefficients.c(2, 1) = 0.25;
  e.coefficients.s(2, 2) = -0.5;
  e.norm_squared = 320;
  e.tail_strength = 2;
  TruncationErrors& errors = e.errors.emplace();
  errors.rms = 0.1;
  errors.measured_max = 0.5;
  errors.max_bound = 0.625;
  errors.points = 7;
  errors.diagonal = 20;
  return e;
}

TEST(LengthUnit, a_scaled_surface_has_scaled_points) {
  const std::vector<Vec3> u = {{1, 0, 0}, {0, 0.6, -0.8}, {0, 0, 1}};
  for (const RadialFunction function : {RadialFunction::kRadius, RadialFunction::kGauge}) {
    const Expansion before = some_expansion(function), after = scaled(before, 1000);
    const auto f = evaluate(before.coefficients, u), g = evaluate(after.coefficients, u);
    const bool gauge = function == RadialFunction::kGauge;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double r = gauge ? 1 / f[i] : f[i], s = gauge ? 1 / g[i] : g[i];
      EXPECT_NEAR(s, 1000 * r, 1e-12 * s);
    }
    EXPECT_EQ(after.center, (Vec3{1000, -2000, 3000}));
    // The integral of f^2 is the integral of (k f)^2 divided by k^2.
    const double k = gauge ? 1e-3 : 1e3;
    EXPECT_DOUBLE_EQ(*after.norm_squared, 320 * k * k);
    EXPECT_DOUBLE_EQ(*after.tail_strength, 2 * k * k);
    EXPECT_DOUBLE_EQ(*after.errors->rms, 100);  // a length for radius and gauge
    EXPECT_DOUBLE_EQ(*after.errors->measured_max, 500);
    EXPECT_DOUBLE_EQ(*after.errors->max_bound, 625);
    EXPECT_EQ(after.errors->predicted_max, std::nullopt);
    EXPECT_EQ(after.errors->points, 7u);
    EXPECT_DOUBLE_EQ(after.errors->diagonal, 20000);
  }
}

TEST(LengthUnit, numbers_of_no_surface_stay) {
  const Expansion before = some_expansion(RadialFunction::kOther);
  EXPECT_EQ(scaled(before, 1000).coefficients.c(2, 1), before.coefficients.c(2, 1));
}

TEST(LengthUnit, factors_that_are_none_are_refused) {
  const Expansion e = some_expansion(RadialFunction::kRadius);
  for (const double factor : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(scaled(e, factor), Error) << factor;
  }
}

}  // namespace
}  // namespace rholm
