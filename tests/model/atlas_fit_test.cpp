// The search for caps, and for a grid, whose surface hangs together as the shape does.
#include "model/atlas_fit.h"

#include <gtest/gtest.h>

#include "rholm/primitives.h"

namespace rholm {
namespace {

constexpr double kTolerance = 0.03;

// What comes of a sphere that is said to have other parts or handles, and all of whose surfaces are
// said to be as far from it.
struct Fit {
  Compressed found;
  FitState state;
  int measured = 0;  // surfaces
};
Fit fit_sphere(const std::optional<Topology>& wanted, const Overlap& overlap,
               double rms = kTolerance / 2) {
  const Mesh sphere = icosphere(4);
  static const Atlas atlas =
      compress(sphere, {.tolerance = kTolerance, .samples = 2000}).model.atlas;
  const SampleLevels levels = make_levels(sphere.vertices, sphere.vertices, {});
  Fit fit;
  const FitTarget target{.levels = levels,
                         .topology = wanted,
                         .tolerance = kTolerance,
                         .accepted = 2 * kTolerance,
                         .stray = 1.5 * kTolerance,
                         .step = 0.1,
                         .max_degree = 14,
                         .uncovered = 0,
                         .measure = [&](const Mesh&) {
                           ++fit.measured;
                           return AtlasErrors{rms, rms, rms, rms};
                         }};
  fit_atlas(target, atlas, overlap, fit.found, fit.state, {});
  return fit;
}

TEST(fit_atlas, parts_and_handles_that_differ_are_counted) {
  EXPECT_EQ(n_odd({3, 0}, std::nullopt), 0u);
  EXPECT_EQ(n_odd({3, 2}, Topology{3, 2}), 0u);
  EXPECT_EQ(n_odd({3, 2}, Topology{1, 7}), 7u);
}

TEST(fit_atlas, one_surface_does_where_it_is_right) {
  for (const bool settles : {false, true}) {
    const Fit fit = fit_sphere(Topology{1, 0}, {1, 3, settles});
    EXPECT_TRUE(fit.found.report.met && fit.found.report.topology_kept);
    EXPECT_EQ(fit.measured, 1);
    EXPECT_EQ(fit.state.searches, 2);
  }
}

// Another grid is tried at the one aim, and not measured: it is no nearer to the shape.
TEST(fit_atlas, many_handles_are_not_looked_for_on_all_grids) {
  const Fit fit = fit_sphere(Topology{1, 40}, {1, 3, true});
  EXPECT_TRUE(fit.found.report.met);
  EXPECT_FALSE(fit.found.report.topology_kept);
  EXPECT_EQ(fit.found.report.components, 1u);
  EXPECT_EQ(fit.found.report.genus, 0u);
  EXPECT_EQ(fit.measured, 1);
  EXPECT_EQ(fit.state.searches, 2);
}

// On six grids at each of two aims, on one at the third.
TEST(fit_atlas, one_handle_is_looked_for_on_all_grids_twice) {
  const Fit fit = fit_sphere(Topology{1, 1}, {1, 3, true});
  EXPECT_FALSE(fit.found.report.topology_kept);
  EXPECT_EQ(fit.state.searches, 0);
  EXPECT_EQ(fit.measured, 3);
}

TEST(fit_atlas, a_wider_overlap_is_given_up_after_one_aim_and_leaves_it_to_the_next) {
  const Fit fit = fit_sphere(Topology{1, 40}, {1.15, 1, false});
  EXPECT_EQ(fit.measured, 1);
  EXPECT_DOUBLE_EQ(fit.state.aim, kTolerance);
  const Fit far = fit_sphere(Topology{1, 40}, {1.15, 1, false}, 1.6 * kTolerance);
  EXPECT_EQ(far.measured, 1);  // no grid mends what another aim must
  EXPECT_NEAR(far.state.aim, kTolerance / 1.6, 0.01 * kTolerance);
}

}  // namespace
}  // namespace rholm
