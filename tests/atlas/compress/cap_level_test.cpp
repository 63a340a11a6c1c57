// Expected values are measured distances to the surface of full degree.
#include "atlas/compress/cap_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_fit.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "chart/cap/cap_frame.h"

namespace rholm {
namespace {

constexpr double kOpened = 88 * std::numbers::pi / 180;

Atlas one_cap() {
  Atlas atlas;
  Cap cap;
  cap.frame = cap_frame({0, 0, 1}, {0, 0, 1}, 0.5, std::numbers::pi / 6, kOpened);
  set_support(cap, 0.5);
  cap.basis = CapBasis::kEven;
  cap.degree = 8;
  atlas.caps.push_back(cap);
  atlas.band = 1e-6;
  return atlas;
}

// Returns offsets from the seed in the plane of the support.
CapPoints plane() {
  CapPoints points;
  for (double x = -0.48; x <= 0.5; x += 0.04) {
    for (double y = -0.48; y <= 0.5; y += 0.04) {
      if (x * x + y * y < 0.25) points.add({x, y, 0}, {0, 0, 1}, 1);
    }
  }
  points.pad();
  return points;
}

// Returns an atlas with one cap, fitted to waves over a plane.
Atlas wavy_cap() {
  Atlas atlas = one_cap();
  CapPoints points;
  const CapPoints flat = plane();
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double x = flat.offset(i).x, y = flat.offset(i).y;
    const double height = 0.05 * std::cos(12 * x) * std::cos(9 * y);
    points.add({x, y, height},
               normalized({0.6 * std::sin(12 * x) * std::cos(9 * y),
                           0.45 * std::cos(12 * x) * std::sin(9 * y), 1}),
               1);
  }
  points.pad();
  CapFitScratch scratch;
  CapFit fit;
  EXPECT_TRUE(fit_cap(atlas.caps[0].frame, points, {CapBasis::kEven, 8, 0.1, 2e-9}, scratch, fit));
  atlas.coefficients = fit.coefficients;
  return atlas;
}

// Returns the rms distance between the only caps of two atlases within the support.
double distance(const Atlas& from, const Atlas& to) {
  const CapPoints flat = plane();
  const std::size_t stride = flat.padded();
  std::vector<double> at(3 * stride), normals(3 * stride), distances(stride);
  cap_surface(to.caps[0], to.coefficients_of(to.caps[0]), flat, at, normals);
  CapPoints points;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    points.add({at[i], at[stride + i], at[2 * stride + i]}, {0, 0, 1}, 1);
  }
  points.pad();
  cap_distances(from.caps[0], from.coefficients_of(from.caps[0]), points, distances);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += distances[i] * distances[i];
  return std::sqrt(sum / static_cast<double>(points.size()));
}

TEST(at_degree, leaves_caps_of_lower_degrees_alone) {
  const Atlas atlas = wavy_cap();
  const Atlas level = at_degree(atlas, 8);
  EXPECT_EQ(level.caps[0].degree, 8);
  EXPECT_EQ(level.band, atlas.band);
}

// The band grows by three standard deviations of the difference between truncated caps.
TEST(at_degree, widens_the_band_by_what_caps_lose) {
  const Atlas atlas = wavy_cap();
  for (const int degree : {0, 2, 4}) {
    const Atlas level = at_degree(atlas, degree);
    EXPECT_EQ(level.caps[0].degree, degree);
    const double lost = level.band / (3 * std::sqrt(2.0));
    // One mean is over the opened hemisphere, the other over the cap: equal areas do not
    // correspond.
    EXPECT_NEAR(lost / distance(level, atlas), 1, 0.35) << degree;
  }
}

}  // namespace
}  // namespace rholm
