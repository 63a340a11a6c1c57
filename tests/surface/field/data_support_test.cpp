// How far places are within the data. Expected values are the quadratic form of discs in closed
// form, and a sphere whose points end at a known height.
#include "surface/field/data_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "surface/field/field_grid.h"
#include "surface/field/sphere_field.h"

namespace rholm {
namespace {

using test::Field;
using test::largest_support;
using test::make_field;
using test::sphere_atlas;

constexpr double kStep = 0.1;

// Returns discs of radius 1 in the plane z = 0, around these places on the x axis.
Atlas discs(const std::vector<double>& at) {
  Atlas atlas;
  for (const double x : at) {
    Cap cap;
    cap.frame = {.center = {x, 0, -2},
                 .x = {1, 0, 0},
                 .y = {0, 1, 0},
                 .z = {0, 0, 1},
                 .radius = 2,
                 .dilation = 1,
                 .support = 1};
    set_support(cap, 1);
    atlas.caps.push_back(cap);
  }
  return atlas;
}

// Returns blocks around the origin, with the caps of each block.
Field field_of(const Atlas& atlas) {
  Field field{test::box_grid({}, kStep, -3, 3), {}};
  field.lists = list_caps(field.grid, discs_of(atlas, CapBands(atlas, kStep)));
  return field;
}

// Returns s^2 of the nearest disc, for a place at height 0.
double square_from(const std::vector<double>& at, const Vec3& x) {
  double least = INFINITY;
  for (const double middle : at) least = std::min(least, std::pow(x.x - middle, 2) + x.y * x.y);
  return least;
}

std::vector<Vec3> places() {
  std::vector<Vec3> all;
  for (int i = 0; i <= 40; ++i) all.push_back({-1.5 + 0.0752 * i, 0.01 * i, 0});
  return all;
}

// The support is 1 - s^2 / 0.63 for the cap in which the vertex is farthest inside.
TEST(DataSupport, of_vertices_falls_from_1_in_the_middle_to_0_at_the_rim) {
  const std::vector<double> at = {-0.4, 0.3};
  const Atlas atlas = discs(at);
  const Field field = field_of(atlas);
  ExtractedSurface surface;
  surface.first_vertex.assign(1, 0);
  for (std::size_t b = 0; b < field.grid.n_blocks(); ++b) {
    const Vec3 low = field.grid.node(b, 0);
    for (const Vec3& x : places()) {
      const Vec3 p = x - low;
      const auto inside = [](double c) { return c >= 0 && c < 8 * kStep; };
      if (inside(p.x) && inside(p.y) && inside(p.z)) surface.mesh.vertices.push_back(x);
    }
    surface.first_vertex.push_back(static_cast<std::uint32_t>(surface.mesh.vertices.size()));
  }
  ASSERT_EQ(surface.mesh.vertices.size(), places().size());
  const std::vector<double> support =
      data_support(atlas, field.lists, surface, CapBands(atlas, kStep), {});
  for (std::size_t v = 0; v < support.size(); ++v) {
    const double square = square_from(at, surface.mesh.vertices[v]);
    if (square < 1) {
      EXPECT_NEAR(support[v], 1 - square / 0.63, 1e-14);
    } else {
      EXPECT_LT(support[v], 0);
    }
  }
}

// The support is 1 up to s^2 = 0.63, and 0 from 0.7 on.
TEST(DataSupport, of_nodes_ends_between_the_rim_of_the_data_and_that_of_caps) {
  const std::vector<double> at = {-0.4, 0.3};
  const Atlas atlas = discs(at);
  const Field field = field_of(atlas);
  std::vector<Vec3> x = places();
  for (const double y : {0.78, 0.79, 0.795, 0.8, 0.81, 0.82, 0.83, 0.84}) x.push_back({0.3, y, 0});
  x.push_back({100, 0, 0});  // outside all blocks
  std::vector<double> support(x.size(), NAN);
  node_support(atlas, field.lists, field.grid, {})(x, support);
  std::size_t between = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double square = square_from(at, x[i]);
    const double expected = std::min(1.0, std::max(0.0, (0.7 - square) / 0.07));
    EXPECT_NEAR(support[i], expected, 1e-12) << i;
    between += expected > 0 && expected < 1;
  }
  EXPECT_GT(between, 4U);
}

TEST(DataSupport, is_positive_within_the_data_and_negative_beyond) {
  constexpr double kBorder = 0.5;
  const Atlas atlas = sphere_atlas(8000, [](const Vec3& p) { return p.z < kBorder; });
  const double step = 0.7 * atlas.spacing;
  Field field = make_field(atlas, step);
  fill_grid(atlas, CapBands(atlas, field.grid.step), field.lists, field.grid, {});
  ExtractedSurface surface = extract_surface(field.grid);
  const std::vector<double> support =
      data_support(atlas, field.lists, surface, CapBands(atlas, kStep), {});
  const double margin = largest_support(atlas);
  std::size_t inside = 0, doubtful = 0;
  for (std::size_t v = 0; v < support.size(); ++v) {
    const double z = surface.mesh.vertices[v].z;
    EXPECT_LE(support[v], 1);
    if (z < kBorder - margin) {
      ++inside;
      doubtful += support[v] <= 0;
    } else if (z > kBorder + margin) {
      EXPECT_LT(support[v], 0);
    }
  }
  EXPECT_GT(inside, 1000U);
  EXPECT_LT(100 * doubtful, inside);  // gaps between random points
}

}  // namespace
}  // namespace rholm
