// The search for caps and for a band that give the surface the topology of the shape, on made-up
// surfaces.
#include "model/atlas/atlas_fit.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "rholm/error.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

constexpr double kTolerance = 0.1, kBand = 0.3, kStep = 0.1;

// Properties that a made-up surface reports.
struct Seen {
  double rms = kTolerance / 2;
  bool handle = false;
  bool fits = true;  // the surface fits into memory
};

// A sphere covered with caps whose surfaces have the properties `see` returns. The shape has
// `handles` more handles than a sphere.
class Fit {
 public:
  using See = std::function<Seen(const AtlasModel&)>;
  Fit(std::size_t handles, See see) : handles_(handles), see_(std::move(see)) {}

  void run(const Overlap& overlap) {
    const Mesh sphere = icosphere(2);
    static const Atlas atlas = [&] {
      Atlas a = compress(sphere, {.tolerance = kTolerance, .samples = 2000}).model.atlas;
      a.band = kBand;
      return a;
    }();
    const SampleLevels levels = make_levels(sphere.vertices, sphere.vertices, {});
    Seen seen;
    const FitTarget target{.levels = levels,
                           .topology = Topology{1, handles_},
                           .tolerance = kTolerance,
                           .accepted = accepted,
                           .stray = 1.5 * kTolerance,
                           .step = kStep,
                           .max_degree = 14,
                           .surface =
                               [&](const AtlasModel& model) {
                                 ++surfaces;
                                 bands.insert(model.atlas.band);
                                 seen = see_(model);
                                 if (!seen.fits) throw Error(ErrorCode::kOutOfMemory, "too fine");
                                 return seen.handle ? torus(1, 0.4, 8, 8) : icosphere(1);
                               },
                           .measure =
                               [&](const Mesh&) {
                                 ++measured;
                                 return AtlasErrors{seen.rms, seen.rms, seen.rms, seen.rms};
                               }};
    fit_atlas(target, atlas, overlap, found, aim, {});
  }

  double accepted = kTolerance;
  Compressed found;
  double aim = 0;
  int surfaces = 0, measured = 0;
  std::set<double> bands;

 private:
  std::size_t handles_;
  See see_;
};

constexpr Overlap kNarrow{1, 3, true}, kWide{1.15, 1, false};

// Files store bands in single precision.
bool is_first(const AtlasModel& model) { return model.atlas.band < 1.01 * kBand; }

TEST(fit_atlas, parts_and_handles_that_differ_are_counted) {
  EXPECT_EQ(n_wrong_handles({3, 0}, std::nullopt), 0u);
  EXPECT_EQ(n_wrong_handles({3, 2}, Topology{3, 2}), 0u);
  EXPECT_EQ(n_wrong_handles({3, 2}, Topology{1, 7}), 7u);
}

TEST(fit_atlas, one_surface_does_where_it_is_right) {
  for (const Overlap& overlap : {kNarrow, kWide}) {
    Fit fit(0, [](const AtlasModel&) { return Seen{.rms = 0.99 * kTolerance}; });
    fit.run(overlap);
    EXPECT_TRUE(fit.found.report.met && fit.found.report.topology_kept);
    EXPECT_EQ(fit.surfaces, 1);
  }
}

TEST(fit_atlas, many_handles_are_looked_for_with_one_other_band) {
  Fit fit(40, [](const AtlasModel&) { return Seen{}; });
  fit.run(kNarrow);
  EXPECT_TRUE(fit.found.report.met);
  EXPECT_FALSE(fit.found.report.topology_kept);
  EXPECT_EQ(fit.found.report.components, 1u);
  EXPECT_EQ(fit.found.report.genus, 0u);
  EXPECT_EQ(fit.surfaces, 2);
}

// Each of three aims is tried with both bands; surfaces that are no better are not measured.
TEST(fit_atlas, one_handle_is_looked_for_with_both_bands_at_nearer_aims) {
  Fit fit(1, [](const AtlasModel&) { return Seen{}; });
  fit.run(kNarrow);
  EXPECT_FALSE(fit.found.report.topology_kept);
  EXPECT_EQ(fit.bands.size(), 2u);
  EXPECT_EQ(fit.surfaces, 6);
  EXPECT_EQ(fit.measured, 3);
}

TEST(fit_atlas, the_band_that_sees_the_handle_comes_first_from_then_on) {
  // The surface is too far at first, so that another aim follows.
  int calls = 0;
  Fit fit(1, [&](const AtlasModel& model) {
    return Seen{.rms = (++calls > 2 ? 0.99 : 1.2) * kTolerance, .handle = !is_first(model)};
  });
  fit.run(kNarrow);
  EXPECT_TRUE(fit.found.report.met && fit.found.report.topology_kept);
  EXPECT_EQ(fit.found.report.genus, 1u);
  EXPECT_EQ(fit.surfaces, 3);
  EXPECT_EQ(fit.bands.size(), 2u);
}

// A surface within the tolerance is not given up for the handles.
TEST(fit_atlas, a_band_with_the_handle_that_is_too_far_is_no_better) {
  Fit fit(1, [](const AtlasModel& model) {
    return Seen{.rms = is_first(model) ? kTolerance : 1.2 * kTolerance, .handle = !is_first(model)};
  });
  fit.run(kWide);
  EXPECT_TRUE(fit.found.report.met);
  EXPECT_FALSE(fit.found.report.topology_kept);
  EXPECT_LE(fit.found.model.errors->rms(), kTolerance);
}

TEST(fit_atlas, a_band_that_memory_does_not_allow_is_no_choice) {
  Fit fit(1, [](const AtlasModel& model) { return Seen{.fits = is_first(model)}; });
  fit.run(kNarrow);
  EXPECT_TRUE(fit.found.report.met);
  EXPECT_EQ(fit.bands.size(), 2u);
  Fit none(1, [](const AtlasModel&) { return Seen{.fits = false}; });
  EXPECT_THROW(none.run(kNarrow), Error);
}

// At the second aim no surface fits, so that the surface of the first aim is kept.
TEST(fit_atlas, what_there_is_stands_where_another_aim_has_no_surface) {
  int calls = 0;
  Fit fit(0,
          [&](const AtlasModel&) { return Seen{.rms = 1.4 * kTolerance, .fits = ++calls == 1}; });
  fit.run(kNarrow);
  EXPECT_EQ(calls, 2);
  EXPECT_FALSE(fit.found.report.met);
  EXPECT_TRUE(fit.found.model.errors.has_value());
}

TEST(fit_atlas, a_wider_overlap_is_given_up_after_one_aim_and_leaves_it_to_the_next) {
  Fit near(40, [](const AtlasModel&) { return Seen{}; });
  near.run(kWide);
  EXPECT_EQ(near.measured, 1);
  EXPECT_DOUBLE_EQ(near.aim, kTolerance);
  Fit far(40, [](const AtlasModel&) { return Seen{.rms = 1.6 * kTolerance}; });
  far.accepted = 2 * kTolerance;
  far.run(kWide);
  EXPECT_EQ(far.surfaces, 1);  // another band cannot help
  EXPECT_NEAR(far.aim, kTolerance / 1.6, 0.01 * kTolerance);
}

// A fit begins at the last aim of the previous fit: a smaller aim drops fewer coefficients.
TEST(fit_atlas, an_aim_that_was_left_is_the_first) {
  const auto numbers_from = [](double aim) {
    Fit fit(0, [](const AtlasModel&) { return Seen{.rms = 0.99 * kTolerance}; });
    fit.aim = aim;
    fit.run(kNarrow);
    return size_of(fit.found.model.atlas).numbers();
  };
  EXPECT_GT(numbers_from(kTolerance / 20), numbers_from(0));
}

}  // namespace
}  // namespace rholm
