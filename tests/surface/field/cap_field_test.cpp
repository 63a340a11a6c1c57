// The blended potential on a grid and at vertices. The oracle computes the same sums in double
// precision, cap by cap, from evaluate().
#include "surface/field/cap_field.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "support/targets.h"
#include "surface/field/sphere_field.h"

namespace rholm {
namespace {

using test::Field;
using test::largest_support;
using test::make_field;

// Quadratic B-spline of (P44), with the value 1 at 0.
double spline(double t) { return (t < 0.5 ? 0.75 - t * t : 0.5 * (1.5 - t) * (1.5 - t)) / 0.75; }

// Returns the squared cosine between a cap's surface and its sphere. This is the angle between the
// surface's normal and the direction from the centre.
double squared_cosine(const Atlas& atlas, const Cap& cap, const Vec3& x) {
  const CapValue value = evaluate(cap, atlas.coefficients_of(cap), x);
  const double out = dot(value.gradient, normalized(x - cap.frame.center));
  return out * out / dot(value.gradient, value.gradient);
}

// Method: G = sum w g / sum w, w = trust (1 - s^2)^3 (1 - g^2/T^2)^2, with the squared cosine as a
// factor where points are noisy.
struct Sum {
  double weight = 0, value = 0;
};
Sum blend_at(const Atlas& atlas, double band, const Vec3& x) {
  Sum sum;
  for (const Cap& cap : atlas.caps) {
    const double near = 1 - place(cap, x - cap.frame.seed());
    if (!(near > 0)) continue;
    const CapValue value = evaluate(cap, atlas.coefficients_of(cap), x);
    const double rest = 1 - std::pow(value.distance / band, 2);
    if (!value.valid || !(rest > 0)) continue;
    const double by_place =
        atlas.blend == CapBlend::kSpline ? spline(1.5 * std::sqrt(1 - near)) : near * near * near;
    const double lean = atlas.noise > 0 ? squared_cosine(atlas, cap, x) : 1;
    const double w = cap.weight * by_place * rest * rest * lean;
    sum.weight += w;
    sum.value += w * value.distance;
  }
  return sum;
}

void expect_blend(const Atlas& atlas, double step, double band) {
  Field field = make_field(atlas, step);
  const std::vector<std::uint64_t> doubtful =
      fill_grid(atlas, CapBands(atlas, field.grid.step), field.lists, field.grid, {});
  std::size_t known = 0;
  for (std::size_t b = 0; b < field.grid.n_blocks(); b += 3) {
    for (std::size_t i = 0; i < BlockGrid::kNodes; i += 5) {
      const Sum sum = blend_at(atlas, band, field.grid.node(b, i));
      const float value = field.grid.block_values(b)[i];
      // A node is unsure if its weight is below 0.1 within a step of the surface.
      const bool doubted = (doubtful[8 * b + (i >> 6)] >> (i & 63) & 1) != 0;
      if (sum.weight > 0.101 || !(std::abs(value) < 1.001 * step)) {
        EXPECT_FALSE(doubted);
      } else if (sum.weight > 1e-3 && sum.weight < 0.099 && std::abs(value) < 0.999 * step) {
        EXPECT_TRUE(doubted);
      }
      if (sum.weight < 1e-6) {
        EXPECT_FALSE(std::isfinite(value));
      } else if (sum.weight > 1e-3) {
        ++known;
        ASSERT_TRUE(std::isfinite(value));
        // The bound is single precision, in steps; weights near the rim of a cap are differences.
        EXPECT_NEAR(value, sum.value / sum.weight, 1e-4 * step);
      }
    }
  }
  EXPECT_GT(known, 300U);
}

TEST(CapField, nodes_have_the_blend_of_the_caps_that_reach_them) {
  Atlas atlas = test::whole_sphere(800);
  const double step = 0.7 * atlas.spacing, band = kBandSteps * step;
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    atlas.blend = CapBlend::kSmooth;
    expect_blend(atlas, step, band);
    atlas.noise = step;
    expect_blend(atlas, step, band);
    atlas.noise = 0;
    atlas.blend = CapBlend::kSpline;
    expect_blend(atlas, step, band);
  });
}
TEST(CapField, is_a_signed_distance_to_first_order) {
  const Atlas atlas = test::whole_sphere(4000);
  const double step = 0.7 * atlas.spacing;
  Field field = make_field(atlas, step);
  fill_grid(atlas, CapBands(atlas, field.grid.step), field.lists, field.grid, {});
  const double missed = 0.0037 * largest_support(atlas);  // as in cap_cover_test.cpp
  for (std::size_t b = 0; b < field.grid.n_blocks(); ++b) {
    for (std::size_t i = 0; i < BlockGrid::kNodes; ++i) {
      const float value = field.grid.block_values(b)[i];
      if (!std::isfinite(value)) continue;
      const double d = norm(field.grid.node(b, i)) - 1;
      EXPECT_NEAR(value, d, d * d + 2 * missed);
    }
  }
}

TEST(CapField, what_is_done_beside_is_done_once_and_changes_nothing) {
  const Atlas atlas = test::whole_sphere(4000);
  const double step = 0.7 * atlas.spacing;
  Field alone = make_field(atlas, step);
  const CapBands bands(atlas, step);
  const std::vector<std::uint64_t> doubtful =
      fill_grid(atlas, bands, alone.lists, alone.grid, {.threads = 1});
  for (const int threads : {1, 2, 3}) {
    Field field = make_field(atlas, step);
    std::atomic<int> calls = 0;
    EXPECT_EQ(
        fill_grid(atlas, bands, field.lists, field.grid, {.threads = threads}, [&] { ++calls; }),
        doubtful);
    EXPECT_EQ(calls, 1);
    const std::size_t n = field.grid.n_blocks() * BlockGrid::kNodes * sizeof(float);
    EXPECT_EQ(std::memcmp(field.grid.values.data(), alone.grid.values.data(), n), 0);
    EXPECT_THROW(fill_grid(atlas, bands, field.lists, field.grid, {.threads = threads},
                           [] { throw Error(ErrorCode::kInvalidInput, ""); }),
                 Error);
  }
}

// Blocks have different numbers of vertices.
TEST(CapField, vertices_are_moved_to_the_surface_with_its_normals) {
  const Atlas atlas = test::whole_sphere(4000);
  const double step = 0.7 * atlas.spacing;
  Field field = make_field(atlas, step);
  fill_grid(atlas, CapBands(atlas, field.grid.step), field.lists, field.grid, {});
  const ExtractedSurface extracted = extract_surface(field.grid);
  ASSERT_TRUE(inspect(extracted.mesh).closed);
  const double support = largest_support(atlas);
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    ExtractedSurface surface = extracted;
    project_vertices(atlas, CapBands(atlas, field.grid.step), field.lists, field.grid, surface, {});
    const Mesh& mesh = surface.mesh;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      EXPECT_NEAR(norm(mesh.vertices[v]), 1, std::pow(support, 4) / 8 + 1e-5 * support);
      const Sum sum = blend_at(atlas, kBandSteps * step, mesh.vertices[v]);
      EXPECT_NEAR(sum.value / sum.weight, 0, 1e-4 * step);
      const Vec3 n{find_attribute(mesh.attributes, "nx")->values[v],
                   find_attribute(mesh.attributes, "ny")->values[v],
                   find_attribute(mesh.attributes, "nz")->values[v]};
      EXPECT_NEAR(norm(n), 1, 1e-6);
      EXPECT_LT(norm(n - mesh.vertices[v]), std::pow(support, 3) + 1e-4);
    }
  });
}

}  // namespace
}  // namespace rholm
