// Expected values are derivatives of shares by differences, and the disagreement of two caps before
// and after, measured from their potentials.
#include "atlas/compress/cap_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "chart/cap/cap_frame.h"

namespace rholm {
namespace {

constexpr double kOpened = 88 * std::numbers::pi / 180;
constexpr double kSupport = 0.5, kApart = 0.6;

// Waves over the plane z = 0 that a cap of degree 6 cannot represent.
double height(double x, double y) { return 0.01 * std::cos(28 * x + 1) * std::cos(22 * y); }

SampleLevels wavy_samples() {
  std::vector<Vec3> points, normals;
  for (double x = -0.6; x <= 1.2; x += 0.02) {
    for (double y = -0.6; y <= 0.6; y += 0.02) {
      points.push_back({x, y, height(x, y)});
      normals.push_back(normalized({0.28 * std::sin(28 * x + 1) * std::cos(22 * y),
                                    0.22 * std::cos(28 * x + 1) * std::sin(22 * y), 1}));
    }
  }
  return make_levels(points, normals, {});
}

// Returns two caps side by side, each fitted to its own samples.
Atlas two_caps(const SampleLevel& samples) {
  Atlas atlas;
  for (const double x : {0.0, kApart}) {
    Cap cap;
    cap.frame = cap_frame({x, 0, 0}, {0, 0, 1}, kSupport, std::numbers::pi / 6, kOpened);
    set_support(cap, kSupport);
    cap.basis = CapBasis::kEven;
    cap.degree = 6;
    cap.first = atlas.coefficients.size();
    CapPoints points;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      const Vec3 offset = samples.points[i] - cap.frame.seed();
      if (norm(offset) < kSupport) points.add(offset, samples.normals[i], 1);
    }
    points.pad();
    CapFitScratch scratch;
    CapFit fit;
    EXPECT_TRUE(fit_cap(cap.frame, points, share_fit(cap.basis, cap.degree), scratch, fit));
    atlas.coefficients.insert(atlas.coefficients.end(), fit.coefficients.begin(),
                              fit.coefficients.end());
    atlas.caps.push_back(cap);
  }
  atlas.band = 1;
  return atlas;
}

// Returns the share of cap `index`, without the factors of the band.
double share(const Atlas& atlas, std::size_t index, const Vec3& x) {
  double all = 0, own = 0;
  for (std::size_t c = 0; c < atlas.caps.size(); ++c) {
    const double rest = 1 - place(atlas.caps[c], x - atlas.caps[c].frame.seed());
    const double w = atlas.caps[c].weight * std::pow(std::max(0.0, rest), 3);
    all += w;
    if (c == index) own = w;
  }
  return own / all;
}

// Returns the rms slope of the steps between caps: sum grad p e, for two caps |grad p| |e_1 - e_2|.
// Where both caps end at one place, slopes have no bound.
constexpr float kMostSlope = 50;  // square of the slope
double ledges(const Atlas& atlas, const SampleLevel& samples) {
  const CapShares shares = shares_of(atlas, samples, atlas.band, {});
  std::vector<double> first(samples.points.size(), NAN);
  for (std::size_t i = 0; i < shares.blend.caps[0].samples.size(); ++i)
    first[shares.blend.caps[0].samples[i]] = shares.blend.caps[0].distances[i];
  double sum = 0;
  std::size_t n = 0;
  const CapWeights& second = shares.blend.caps[1];
  for (std::size_t i = 0; i < second.samples.size(); ++i) {
    const double apart = second.distances[i] - first[second.samples[i]];
    if (std::isnan(apart)) continue;
    sum += std::min(kMostSlope, shares.slopes[1][i]) * apart * apart, ++n;
  }
  return std::sqrt(sum / static_cast<double>(n));
}

TEST(shares_of, slopes_are_those_of_shares_along_the_surface) {
  const SampleLevels levels = wavy_samples();
  const SampleLevel& samples = levels.finest();
  Atlas atlas = two_caps(samples);
  atlas.caps[1].weight = 2;
  atlas.band = 1e3;  // the band's factors are 1
  const CapShares shares = shares_of(atlas, samples, atlas.band, {});
  std::size_t compared = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    const CapWeights& own = shares.blend.caps[c];
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const Vec3 at = samples.points[own.samples[i]], n = samples.normals[own.samples[i]];
      if (!(share(atlas, c, at) > 0.01 && share(atlas, c, at) < 0.99)) continue;
      const Vec3 u = normalized(cross(n, Vec3{0, 1, 0})), v = cross(n, u);
      const double h = 1e-5;
      const double du = (share(atlas, c, at + h * u) - share(atlas, c, at - h * u)) / (2 * h);
      const double dv = (share(atlas, c, at + h * v) - share(atlas, c, at - h * v)) / (2 * h);
      // Weights have single precision.
      EXPECT_NEAR(shares.slopes[c][i], du * du + dv * dv, 1e-5 * (1 + du * du + dv * dv));
      ++compared;
    }
  }
  EXPECT_GT(compared, 500U);
}

// The step between two caps has the slope |grad p| |g_1 - g_2|. There is no step where one cap is
// alone, or between a cap and itself.
TEST(share_of_ledges, is_the_part_where_shares_change_fast_for_what_caps_disagree_by) {
  const SampleLevels levels = wavy_samples();
  const SampleLevel& samples = levels.finest();
  Atlas atlas = two_caps(samples);
  Atlas same = atlas;
  same.caps[1] = same.caps[0];
  same.caps[1].weight = 2;
  EXPECT_EQ(share_of_ledges(shares_of(same, samples, 1e3, {}), 1e-3), 0);
  const double slope = 0.1;
  atlas.caps[1].frame.center.z += 0.03;
  std::size_t leaning = 0, weighted = 0;
  for (const Vec3& at : samples.points) {
    const double own = share(atlas, 0, at);
    if (std::isnan(own)) continue;  // outside both caps
    ++weighted;
    if (!(own > 0 && own < 1)) continue;
    CapValue values[2];
    for (std::size_t c = 0; c < 2; ++c)
      values[c] = evaluate(atlas.caps[c], atlas.coefficients_of(atlas.caps[c]), at);
    const double h = 1e-6;  // along the wave's plane, nearly the surface
    const auto along = [&](const Vec3& way) {
      return (share(atlas, 0, at + h * way) - share(atlas, 0, at - h * way)) / (2 * h);
    };
    const double steepness = std::hypot(along({1, 0, 0}), along({0, 1, 0}));
    leaning += steepness * std::abs(values[0].distance - values[1].distance) > slope;
  }
  EXPECT_GT(leaning, weighted / 20);
  EXPECT_NEAR(share_of_ledges(shares_of(atlas, samples, 1e3, {}), slope),
              static_cast<double>(leaning) / static_cast<double>(weighted), 0.01);
}

TEST(agree, brings_caps_together_where_they_meet) {
  const SampleLevels levels = wavy_samples();
  const SampleLevel& samples = levels.finest();
  Atlas atlas = two_caps(samples);
  const double before = ledges(atlas, samples), error = blend(atlas, samples, atlas.band, {}).rms;
  agree(samples, {.tolerance = 0.02, .band = atlas.band}, atlas, {});
  // One step lowers the slopes by a third at no cost: the error of the blend stays the same.
  EXPECT_LT(ledges(atlas, samples), 0.7 * before);
  EXPECT_LT(blend(atlas, samples, atlas.band, {}).rms, 1.05 * error);
}

TEST(agree, leaves_what_is_zero) {
  const SampleLevels levels = wavy_samples();
  Atlas atlas = two_caps(levels.finest());
  atlas.coefficients[4] = 0;
  const std::vector<double> before = atlas.coefficients;
  agree(levels.finest(), {.tolerance = 0.03, .band = atlas.band}, atlas, {});
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(atlas.coefficients[i] == 0, i == 4);
}

}  // namespace
}  // namespace rholm
