#include "rholm/smooth.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "edit/region/local_mesh.h"
#include "edit/sheet.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using std::numbers::pi;

constexpr double kEdge = 0.1;  // ten edges per wavelength of 1

Patch patch_of(const Mesh& mesh, const Region& region, const PatchOptions& options,
               const Context& context = {}) {
  return analyze_patch(mesh, std::vector<Region>{region}, options, context);
}

// Returns the remaining part of a wave where the weight is 1, by projection onto the wave.
double gain(double wave, const PatchOptions& options, double shorten = 1) {
  const Mesh mesh = test::sheet(90, kEdge, [&](double x, double y) {
    return 0.02 * std::cos(2 * pi * (0.8 * x + 0.6 * y) / wave + 0.3);
  });
  const Patch patch = patch_of(mesh, BallRegion{{0, 0, 0}, 1.5}, options);
  const std::vector<Vec3> moved = update(patch, {.wavelength = shorten * patch.wavelength});
  double all = 0, left = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (patch.weights[i] < 1) continue;
    all += patch.positions[i].z * patch.positions[i].z;
    left += patch.positions[i].z * moved[i].z;
  }
  return left / all;
}

TEST(Smooth, wavelength_is_where_waves_begin_to_pass) {
  for (const PatchFitting fitting : {PatchFitting::kMean, PatchFitting::kRobust}) {
    const PatchOptions options{.wavelength = 1, .fitting = fitting};
    EXPECT_LT(std::abs(gain(0.4, options)), 0.05);
    EXPECT_LT(std::abs(gain(0.5, options)), 0.05);
    EXPECT_LT(std::abs(gain(0.6, options)), 0.1);
    for (const double wave : {1.0, 1.3, 2.0, 4.0}) EXPECT_NEAR(gain(wave, options), 1, 0.05);
  }
}

TEST(Smooth, slider_of_the_wavelength_is_an_analysis_for_it) {
  const PatchOptions options{.wavelength = 1, .fitting = PatchFitting::kMean};
  EXPECT_LT(std::abs(gain(0.9, options, 2)), 0.1);  // half of the cut-off
  EXPECT_NEAR(gain(2.2, options, 2), 1, 0.07);
}

// A cap uses all of its points up to 400 per coefficient. Aliasing is at most 1 / sqrt(400), and
// less where caps overlap. Here a cap has 47 points per square wavelength, 12.6 square wavelengths,
// and 51 coefficients.
TEST(Smooth, finer_detail_leaves_nothing_behind) {
  const Mesh mesh = test::sheet(90, kEdge, [&](double x, double y) {
    return 0.02 * (std::cos(15 * x + 3 * y) + std::cos(4 * x - 13 * y) + std::cos(9 * x + 12 * y));
  });
  const Patch patch =
      patch_of(mesh, BallRegion{{0, 0, 0}, 1.5}, {.wavelength = 1, .fitting = PatchFitting::kMean});
  const std::vector<Vec3> moved = update(patch);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (patch.weights[i] < 1) continue;
    before += patch.positions[i].z * patch.positions[i].z;
    after += moved[i].z * moved[i].z;
  }
  EXPECT_LT(std::sqrt(after / before), 0.04);
}

// A dome whose width at half height is the wavelength, on a smooth surface.
TEST(Smooth, features_as_wide_as_the_wavelength_keep_their_height) {
  const auto base = [](double x, double y) { return -(x * x + 0.4 * y * y) / 8; };
  const double s2 = 1 / (8 * std::log(2.0));  // full width 1 at half maximum
  const Mesh mesh = test::sheet(90, kEdge, [&](double x, double y) {
    return base(x, y) + 0.1 * std::exp(-(x * x + y * y) / (2 * s2));
  });
  for (const PatchFitting fitting : {PatchFitting::kMean, PatchFitting::kRobust}) {
    for (const bool repair : {false, true}) {
      if (repair && fitting == PatchFitting::kMean) continue;
      Mesh edited = mesh;
      const Patch patch = patch_of(mesh, BallRegion{{0, 0, 0}, 1.5},
                                   {.wavelength = 1, .fitting = fitting, .repair = repair});
      apply(patch, update(patch), edited);
      double top = 0;
      for (const Vec3& v : edited.vertices) top = std::max(top, v.z - base(v.x, v.y));
      EXPECT_GT(top, 0.095);
      EXPECT_LT(top, 0.105);
    }
  }
}

// A curved, sharp scratch that is three edges wide.
double scratch(double x, double y) {
  const double u = (y - 0.2 * x * x) / 0.15;
  return std::abs(u) < 1 && std::abs(x) < 0.8 ? -0.08 * (1 - u * u) : 0;
}

double rolling(double x, double y) { return 0.1 * std::sin(2 * x) * std::cos(1.5 * y + 0.5); }

double rms_in_scratch(const Mesh& mesh) {
  double sum = 0;
  int count = 0;
  for (const Vec3& v : mesh.vertices) {
    if (scratch(v.x, v.y) == 0) continue;
    sum += std::pow(v.z - rolling(v.x, v.y), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Smooth, scratch_of_a_third_of_the_wavelength_goes) {
  Mesh mesh =
      test::sheet(90, kEdge, [](double x, double y) { return rolling(x, y) + scratch(x, y); });
  const double before = rms_in_scratch(mesh);
  std::vector<double> painted;
  painted.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) painted.push_back(scratch(v.x, v.y) < 0 ? 1 : 0);
  mesh.attributes = {{"scar", ScalarType::kUint8, painted}};
  for (const auto& [region, fitting, repair] :
       {std::tuple{Region{BallRegion{{0, 0, 0}, 1.2}}, PatchFitting::kRobust, false},
        std::tuple{Region{BallRegion{{0, 0, 0}, 1.2}}, PatchFitting::kRobust, true},
        std::tuple{Region{PropertyRegion{"scar"}}, PatchFitting::kAround, false}}) {
    Mesh edited = mesh;
    const Patch patch =
        patch_of(mesh, region, {.wavelength = 1, .fitting = fitting, .repair = repair});
    apply(patch, update(patch), edited);
    EXPECT_LT(rms_in_scratch(edited), before / 5);
  }
}

// Waves of length 0.55 are too short for the fits, but exist at the rim. Only painted points move.
TEST(Smooth, bridge_carries_the_detail_of_its_rim) {
  const auto wave = [](double x, double y) { return 0.02 * std::sin(2 * pi * (x + y) / 0.78); };
  Mesh mesh =
      test::sheet(90, kEdge, [&](double x, double y) { return wave(x, y) + scratch(x, y); });
  std::vector<double> painted;
  painted.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) painted.push_back(scratch(v.x, v.y) < 0 ? 1 : 0);
  mesh.attributes = {{"scar", ScalarType::kUint8, painted}};
  const Patch patch =
      patch_of(mesh, PropertyRegion{"scar"}, {.wavelength = 1, .fitting = PatchFitting::kAround});
  const std::vector<Vec3> moved = update(patch);
  double error = 0, detail = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(painted[patch.vertices[i]], 1);
    error += std::pow(moved[i].z - wave(moved[i].x, moved[i].y), 2);
    detail += std::pow(wave(moved[i].x, moved[i].y), 2);
  }
  EXPECT_GT(moved.size(), 50u);
  EXPECT_LT(std::sqrt(error / detail), 0.6);  // measured: 0.49; with the fits alone: 1.2
}

TEST(Smooth, repair_leaves_texture_that_does_not_stand_out) {
  const auto texture = [](double x, double y) {
    return 0.004 * std::sin(25 * x) * std::sin(21 * y);
  };
  const Mesh mesh = test::sheet(
      90, kEdge, [&](double x, double y) { return rolling(x, y) + texture(x, y) + scratch(x, y); });
  const Patch patch = patch_of(mesh, BallRegion{{0, 0, 0}, 1.5}, {.wavelength = 1, .repair = true});
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    const Vec3& v = patch.positions[i];
    // The distance to the scratch is at most half a wavelength and an edge.
    EXPECT_LT(std::abs(v.y - 0.2 * v.x * v.x), 0.15 + 0.5 + 2 * kEdge);
  }
  EXPECT_GT(patch.vertices.size(), 100u);
}

TEST(Smooth, what_has_no_weight_stays_to_the_last_bit) {
  Mesh mesh = bumpy_sphere(5, 0.2, 3);
  mesh.vertices[5].x = -0.0;
  mesh.attributes = {
      {"quality", ScalarType::kFloat32, std::vector<double>(mesh.vertices.size(), 7)}};
  const std::vector<Region> regions = {BallRegion{mesh.vertices[0], 0.3}};
  const Patch patch = analyze_patch(mesh, regions, {.wavelength = 0.3});
  Mesh edited = mesh;
  apply(patch, update(patch), edited);
  const std::vector<double> w = region_weights(mesh, regions, 0.3);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const bool same = test::bits_of(mesh.vertices[i]) == test::bits_of(edited.vertices[i]);
    EXPECT_TRUE(same || w[i] > 0);
    moved += same ? 0 : 1;
  }
  EXPECT_GT(moved, 100u);
  EXPECT_EQ(mesh.faces, edited.faces);
  EXPECT_EQ(mesh.attributes[0].values, edited.attributes[0].values);
  EXPECT_EQ(update(patch, {.strength = 0}), patch.positions);
}

// The transition adds no crease to a smooth input: the normals of a sphere stay within a degree of
// the exact normals.
TEST(Smooth, smooth_surface_keeps_its_normals_across_the_transition) {
  Mesh mesh = icosphere(6);
  const Patch patch = patch_of(mesh, BallRegion{{0, 0, 1}, 0.4}, {.wavelength = 0.3});
  apply(patch, update(patch), mesh);
  const LocalMesh local = cut_out(mesh, bounds(mesh.vertices));
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const double cosine = dot(local.normals[i], normalized(local.points[i]));
    EXPECT_LT(std::acos(std::min(1.0, cosine)), pi / 180);
    EXPECT_NEAR(norm(local.points[i]), 1, 3e-4 * 0.3);  // measured: 1.3e-4 wavelengths
  }
}

TEST(Smooth, a_handle_is_no_obstacle) {
  Mesh mesh = torus(1, 0.4, 192, 96);
  const Mesh clean = mesh;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] *= 1 + 0.01 * (random_uniform(1, i) - 0.5);
  }
  const auto off = [](const Vec3& v) { return std::hypot(std::hypot(v.x, v.y) - 1, v.z) - 0.4; };
  Mesh edited = mesh;
  const Patch patch = patch_of(mesh, BoxRegion{{-2, -2, -2}, {2, 2, 2}},
                               {.wavelength = 0.2, .fitting = PatchFitting::kMean});
  apply(patch, update(patch), edited);
  EXPECT_EQ(patch.unreached, 0u);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < clean.vertices.size(); ++i) {
    before += std::pow(off(mesh.vertices[i]), 2);
    after += std::pow(off(edited.vertices[i]), 2);
  }
  // Squares of noise: 47 vertices per square wavelength, for 4 coefficients of a cap.
  EXPECT_LT(after, before / 6);
}

// The post is higher than wide. It is in the support of neighbouring caps, but off their surface.
TEST(Smooth, what_towers_beside_a_patch_does_not_pull_at_it) {
  const Mesh mesh = test::sheet(90, kEdge, [](double x, double y) {
    return 1.5 / (1 + std::pow(std::hypot(x - 1.3, y) / 0.4, 8));
  });
  const Patch patch =
      patch_of(mesh, BallRegion{{0, 0, 0}, 0.3},
               {.wavelength = 1, .transition = 0.2, .fitting = PatchFitting::kMean});
  const std::vector<Vec3> moved = update(patch);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_LT(norm(moved[i] - patch.positions[i]), 0.05);  // the foot of the post moves by 0.034
  }
}

TEST(Smooth, a_seam_of_the_file_stays_closed) {
  const Mesh whole = bumpy_sphere(4, 0.2, 3);
  const Mesh soup = test::exploded(whole);
  const Region region = BallRegion{whole.vertices[0], 0.4};
  Mesh a = whole, b = soup;
  const Patch pa = patch_of(a, region, {.wavelength = 0.6});
  const Patch pb = patch_of(b, region, {.wavelength = 0.6});
  apply(pa, update(pa), a);
  apply(pb, update(pb), b);
  const Mesh again = weld(b).mesh;
  EXPECT_EQ(again.vertices.size(), whole.vertices.size());
}

TEST(Smooth, threads_do_not_change_a_bit) {
  const Mesh mesh = bumpy_sphere(6, 0.2, 3);
  const Region region = BallRegion{mesh.vertices[0], 1};
  const Patch one = patch_of(mesh, region, {.wavelength = 0.2}, {.threads = 1});
  const Patch two = patch_of(mesh, region, {.wavelength = 0.2}, {.threads = 2});
  EXPECT_EQ(one.moves, two.moves);
  EXPECT_GT(one.caps, 20u);
}

TEST(Smooth, normals_of_the_file_follow) {
  Mesh mesh = test::sheet(40, kEdge, [](double x, double y) { return scratch(x, y); });
  const std::vector<double> up(mesh.vertices.size(), 0);
  mesh.attributes = {{"nx", ScalarType::kFloat32, up},
                     {"ny", ScalarType::kFloat32, up},
                     {"nz", ScalarType::kFloat32, up}};
  const Patch patch = patch_of(mesh, BallRegion{{0, 0, 0}, 0.5}, {.wavelength = 1});
  apply(patch, update(patch), mesh);
  std::vector<std::uint8_t> in(mesh.vertices.size(), 0);
  for (const std::uint32_t v : patch.vertices) in[v] = 1;
  for (std::size_t i = 0; i < in.size(); ++i) {
    EXPECT_EQ(mesh.attributes[2].values[i] != 0, in[i] != 0);
  }
}

TEST(Smooth, what_cannot_be_done_is_refused) {
  const Mesh mesh = test::sheet(40, kEdge);
  const Region ball = BallRegion{{0, 0, 0}, 1};
  for (const double wavelength : {0.0, -1.0, std::nan(""), 1e300, 0.15, 40.0}) {
    EXPECT_THROW(patch_of(mesh, ball, {.wavelength = wavelength}), Error) << wavelength;
  }
  EXPECT_THROW(analyze_patch(mesh, {}, {.wavelength = 1}), Error);
  EXPECT_THROW(patch_of(mesh, ball, {.wavelength = 1, .transition = -1}), Error);
  EXPECT_THROW(patch_of({}, ball, {.wavelength = 1}), Error);
  EXPECT_THROW(patch_of(mesh, ball, {.wavelength = 0.5, .fitting = PatchFitting::kAround}), Error);
  Mesh faint = mesh;
  faint.attributes = {{"w", ScalarType::kFloat32, std::vector<double>(mesh.vertices.size(), 0.25)}};
  EXPECT_THROW(
      patch_of(faint, PropertyRegion{"w"}, {.wavelength = 1, .fitting = PatchFitting::kAround}),
      Error);
  const Patch patch = patch_of(mesh, ball, {.wavelength = 1});
  EXPECT_THROW(update(patch, {.wavelength = 0.9}), Error);
  EXPECT_THROW(update(patch, {.wavelength = 5}), Error);
  EXPECT_THROW(update(patch, {.strength = std::nan("")}), Error);
}

}  // namespace
}  // namespace rholm
