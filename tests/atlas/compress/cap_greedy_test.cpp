// Expected values come from surfaces with a closed form of the distance (sphere, torus), and from
// separate fits of each degree.
#include "atlas/compress/cap_greedy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "atlas/compress/cap_prune.h"
#include "chart/cap/cap_frame.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using std::numbers::pi;

struct Samples {
  std::vector<Vec3> points, normals;
};

// A Fibonacci lattice: points of equal areas; any part of the list is evenly distributed.
Samples sphere(std::size_t n) {
  Samples s;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double phi = static_cast<double>(i) * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    s.points.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  s.normals = s.points;
  return s;
}

constexpr double kTube = 0.4;

// Radii 1 and kTube. Areas are equal, because theta + kTube sin(theta) is uniform.
Samples torus(std::size_t n) {
  Samples s;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = 2 * pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    double theta = u;
    for (int k = 0; k < 50; ++k) theta = u - kTube * std::sin(theta);
    const double phi = static_cast<double>(i) * pi * (3 - std::sqrt(5.0));
    const Vec3 out{std::cos(phi), std::sin(phi), 0};
    const Vec3 normal = std::cos(theta) * out + std::sin(theta) * Vec3{0, 0, 1};
    s.points.push_back(out + kTube * normal);
    s.normals.push_back(normal);
  }
  return s;
}

GreedyOptions options_for(double tolerance) {
  GreedyOptions options;
  options.candidate.tolerance = tolerance;
  options.candidate.stray = 5 * tolerance;
  return options;
}

Atlas atlas_of(const GreedyCover& cover, double band) {
  Atlas atlas;
  for (const Candidate& chosen : cover.chosen) {
    atlas.caps.push_back(chosen.cap);
    atlas.caps.back().first = atlas.coefficients.size();
    atlas.coefficients.insert(atlas.coefficients.end(), chosen.coefficients.begin(),
                              chosen.coefficients.end());
  }
  set_weights(atlas.caps, 3);
  atlas.band = band;
  return atlas;
}

TEST(greedy_cover, is_given_up_where_too_many_numbers_are_foreseen) {
  const Samples s = torus(3000);
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  const std::vector<std::uint8_t> none(levels.size());
  GreedyOptions options = options_for(3e-3);
  const GreedyCover all = greedy_cover(levels, 3, options, none, {});
  EXPECT_EQ(all.foreseen, 0U);
  std::size_t numbers = 0;
  for (const Candidate& chosen : all.chosen) numbers += chosen.cost();
  options.most_numbers = numbers / 2;
  const GreedyCover few = greedy_cover(levels, 3, options, none, {});
  EXPECT_GT(few.foreseen, options.most_numbers);
  EXPECT_LT(few.chosen.size(), all.chosen.size());
  options.most_numbers = 2 * numbers;
  EXPECT_EQ(greedy_cover(levels, 3, options, none, {}).chosen.size(), all.chosen.size());
}

TEST(greedy_cover, covered_samples_of_a_sphere_are_within_four_tolerances) {
  const Samples s = sphere(6000);
  const double tolerance = 1e-2;
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  const GreedyCover cover = greedy_cover(levels, std::sqrt(12.0), options_for(tolerance),
                                         std::vector<std::uint8_t>(levels.size()), {});
  EXPECT_LE(cover.uncovered, 0.002);
  // A cap over 30 degrees of a sphere is nearly constant, so that a dozen or two caps suffice.
  EXPECT_LT(cover.chosen.size(), 40U);
  for (const Candidate& chosen : cover.chosen) {
    EXPECT_LE(chosen.rms, tolerance);
    // The distance of a point x of a cap's surface to the sphere is | |x| - 1 |.
    const CapFrame& f = chosen.cap.frame;
    CapPoints at;
    for (double r = 0; r < 0.9 * f.support; r += 0.1 * f.support) at.add(r * f.x, f.z, 1);
    at.pad();
    std::vector<double> places(3 * at.padded()), normals(places.size());
    cap_surface(chosen.cap, chosen.coefficients, at, places, normals);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vec3 x{places[i], places[at.padded() + i], places[2 * at.padded() + i]};
      EXPECT_NEAR(norm(f.seed() + x), 1, 5 * tolerance);
    }
  }
}

// Prunes to the tolerance that the caps were fitted to.
PruneReport prune(const SampleLevels& samples, const PruneOptions& options, Atlas& atlas,
                  const Context& context) {
  Pruning pruning(samples, options, atlas, context);
  return pruning.to(options.tolerance, atlas, context);
}

TEST(greedy_cover, threads_do_not_change_a_bit) {
  const Samples s = torus(8000);
  std::vector<double> found[2];
  for (const int threads : {1, 2}) {
    Context context;
    context.threads = threads;
    const SampleLevels levels = make_levels(s.points, s.normals, context);
    const GreedyCover cover = greedy_cover(levels, 4, options_for(0.02),
                                           std::vector<std::uint8_t>(levels.size()), context);
    Atlas atlas = atlas_of(cover, 0.2);
    prune(levels, {.tolerance = 0.02, .band = 0.2, .stray = 0.1}, atlas, context);
    found[threads - 1] = atlas.coefficients;
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST(pruning, keeps_the_tolerance_and_drops_coefficients) {
  const Samples s = torus(6000);
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  for (const double tolerance : {1e-2, 5e-3}) {
    const GreedyCover cover = greedy_cover(levels, 4, options_for(tolerance),
                                           std::vector<std::uint8_t>(levels.size()), {});
    Atlas atlas = atlas_of(cover, 10 * tolerance);
    const std::size_t before = n_kept(atlas);
    const PruneReport report = prune(
        levels, {.tolerance = tolerance, .band = atlas.band, .stray = 5 * tolerance}, atlas, {});
    EXPECT_LE(report.rms, tolerance);
    EXPECT_EQ(report.coefficients, n_kept(atlas));
    EXPECT_LT(report.coefficients, before);
    const Blend after = blend(atlas, levels.finest(), atlas.band, {});
    EXPECT_DOUBLE_EQ(after.rms, report.rms);
    EXPECT_LT(static_cast<double>(after.weightless), 0.02 * static_cast<double>(levels.size()));
  }
}

// Returns random points, as uneven as samples of a mesh, in contrast to a lattice.
Samples random_sphere(std::size_t n) {
  Samples s;
  for (std::size_t i = 0; i < n; ++i) s.points.push_back(test::random_direction(1, i));
  s.normals = s.points;
  return s;
}

// Adds a constant to the function: only the coefficient of degree 0 changes.
void lift(Candidate& candidate, double height) {
  candidate.coefficients[0] += height / candidate.cap.frame.radius * std::sqrt(4 * pi);
}

TEST(strays, voids_between_random_samples_are_no_edges) {
  // Samples are seven tolerances apart, like 200 000 samples of a mesh at 3e-4 of its diagonal. The
  // widest holes between them have radii of 1.7 spacings.
  const Samples s = random_sphere(60000);
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  const double tolerance = levels.finest().spacing / 7;
  CandidateOptions options;
  options.tolerance = tolerance, options.stray = 3 * tolerance;
  CandidateScratch scratch;
  Candidate candidate;
  for (std::uint32_t seed = 0; seed < 60000; seed += 6000) {
    ASSERT_TRUE(make_candidate(levels, candidate_place(levels, seed, 0.5, options, scratch), 0.5,
                               options, {}, scratch, candidate));
    EXPECT_FALSE(strays(levels, candidate.cap, candidate.coefficients, options.stray, options.stray,
                        scratch));
    // A surface that is off the samples by more than the band and a spacing is rejected.
    lift(candidate, 11 * tolerance);
    EXPECT_TRUE(strays(levels, candidate.cap, candidate.coefficients, options.stray, options.stray,
                       scratch));
  }
}

TEST(strays, surfaces_that_go_on_where_samples_end_do) {
  const Samples whole = random_sphere(20000);
  Samples half;
  for (const Vec3& p : whole.points) {
    if (p.z > 0) half.points.push_back(p);
  }
  half.normals = half.points;
  const SampleLevels all = make_levels(whole.points, whole.normals, {});
  const SampleLevels upper = make_levels(half.points, half.normals, {});
  CandidateOptions options;
  options.tolerance = 1e-3, options.stray = 3e-3;
  CandidateScratch scratch;
  Candidate candidate;
  std::size_t tried = 0;
  for (std::uint32_t seed = 0; seed < all.size(); ++seed) {
    const double z = all.finest().points[seed].z;
    // The cap reaches 0.1 (four spacings) beyond the border, or it ends before the border.
    if (!(std::abs(z - 0.2) < 1e-4 || std::abs(z - 0.4) < 1e-4)) continue;
    ++tried;
    ASSERT_TRUE(make_candidate(all, candidate_place(all, seed, 0.3, options, scratch), 0.5, options,
                               {}, scratch, candidate));
    EXPECT_EQ(
        strays(upper, candidate.cap, candidate.coefficients, options.stray, options.stray, scratch),
        z < 0.3);
  }
  EXPECT_GE(tried, 2U);
}

TEST(pruning, leaves_no_gaps_between_caps_of_random_samples) {
  const Samples s = random_sphere(30000);
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  const double tolerance = levels.finest().spacing / 7;
  const GreedyCover cover = greedy_cover(levels, std::sqrt(12.0), options_for(tolerance),
                                         std::vector<std::uint8_t>(levels.size()), {});
  Atlas atlas = atlas_of(cover, 10 * tolerance);
  prune(levels, {.tolerance = tolerance, .band = atlas.band, .stray = 3 * tolerance}, atlas, {});
  const Blend after = blend(atlas, levels.finest(), atlas.band, {});
  EXPECT_LT(static_cast<double>(after.weightless), 0.005 * static_cast<double>(levels.size()));
}

TEST(greedy_cover, cancels) {
  const Samples s = torus(4000);
  const SampleLevels levels = make_levels(s.points, s.normals, {});
  Context context;
  context.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW(
      greedy_cover(levels, 4, options_for(0.02), std::vector<std::uint8_t>(levels.size()), context),
      std::exception);
}

}  // namespace
}  // namespace rholm
