#include "rholm/region.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "edit/sheet.h"
#include "rholm/error.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

// Returns the smooth step of degree 5, in closed form.
double step(double t) {
  const double s = 1 - std::min(1.0, std::max(0.0, t));
  return 6 * std::pow(s, 5) - 15 * std::pow(s, 4) + 10 * std::pow(s, 3);
}

std::vector<double> weights(const Mesh& mesh, const Region& region, double transition) {
  return region_weights(mesh, std::vector<Region>{region}, transition);
}

TEST(Region, ball_fades_by_the_distance_in_space) {
  const Mesh mesh = test::sheet(40, 0.1);
  const std::vector<double> w = weights(mesh, BallRegion{{0.1, 0.2, 0}, 0.5}, 0.7);
  for (std::size_t i = 0; i < w.size(); ++i) {
    EXPECT_NEAR(w[i], step((norm(mesh.vertices[i] - Vec3{0.1, 0.2, 0}) - 0.5) / 0.7), 1e-14);
  }
}

TEST(Region, box_is_one_inside_and_zero_beyond_the_transition) {
  const Mesh mesh = test::sheet(40, 0.1);
  const std::vector<double> w = weights(mesh, BoxRegion{{-1, -0.5, -1}, {1, 0.5, 1}}, 0.25);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double x = std::abs(mesh.vertices[i].x) - 1, y = std::abs(mesh.vertices[i].y) - 0.5;
    const double d = std::hypot(std::max(0.0, x), std::max(0.0, y));
    EXPECT_NEAR(w[i], step(d / 0.25), 1e-14);
  }
}

// Distances on a sphere are arcs. Fast marching is exact to first order: its measured error is at
// most 1.6 % of an edge's length per edge. The bound 0.04 allows for it where the step is steepest.
TEST(Region, disc_follows_the_surface) {
  const Mesh mesh = icosphere(5);
  const std::vector<double> w = weights(mesh, DiscRegion{100, 0.8}, 0.6);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double cosine = dot(mesh.vertices[i], mesh.vertices[100]);
    const double arc = std::acos(std::min(1.0, std::max(-1.0, cosine)));
    EXPECT_NEAR(w[i], step((arc - 0.8) / 0.6), 0.04);
  }
}

TEST(Region, disc_does_not_jump_to_another_sheet) {
  Mesh mesh = test::sheet(20, 0.1);
  const std::size_t n = mesh.vertices.size();
  Mesh other = mesh;
  for (Vec3& v : other.vertices) v.z += 0.01;
  for (const Vec3& v : other.vertices) mesh.vertices.push_back(v);
  for (const Triangle& t : other.faces) {
    const auto shift = static_cast<std::uint32_t>(n);
    mesh.faces.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  const std::vector<double> w = weights(mesh, DiscRegion{220, 0.5}, 0.2);
  for (std::size_t i = n; i < w.size(); ++i) EXPECT_EQ(w[i], 0);
  EXPECT_EQ(w[220], 1);
}

TEST(Region, color_and_mask_are_the_same_and_spread_along_the_surface) {
  Mesh mesh = test::sheet(40, 0.1);
  const std::size_t n = mesh.vertices.size();
  std::vector<double> mask(n), red(n), green(n, 16), blue(n, 255);
  for (std::size_t i = 0; i < n; ++i) {
    mask[i] = norm(mesh.vertices[i]) < 0.5 ? 1 : 0;
    red[i] = 200 * mask[i];
  }
  mesh.attributes = {{"red", ScalarType::kUint8, red},
                     {"green", ScalarType::kUint8, green},
                     {"blue", ScalarType::kUint8, blue},
                     {"scar", ScalarType::kFloat32, mask}};
  const std::vector<double> a = weights(mesh, ColorRegion{0xc810ff}, 0.5);
  EXPECT_EQ(a, weights(mesh, PropertyRegion{"scar"}, 0.5));
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_TRUE(mask[i] == 0 || a[i] == 1);
    // The rim of the mask lies inside its circle by up to an edge.
    EXPECT_TRUE(norm(mesh.vertices[i]) < 1.01 || a[i] == 0);
  }
}

TEST(Region, property_of_other_values_is_the_weight_itself) {
  Mesh mesh = test::sheet(2, 0.1);
  mesh.attributes = {{"w", ScalarType::kFloat64, {0, .25, -3, 7, 1, .5, std::nan(""), 0, 0}}};
  EXPECT_EQ(weights(mesh, PropertyRegion{"w"}, 5),
            (std::vector<double>{0, .25, 0, 1, 1, .5, 0, 0, 0}));
}

TEST(Region, union_is_one_minus_the_product_of_what_is_left) {
  const Mesh mesh = test::sheet(20, 0.1);
  const Region a = BallRegion{{0, 0, 0}, 0.3}, b = BallRegion{{0.5, 0, 0}, 0.2};
  const std::vector<double> both = region_weights(mesh, std::vector<Region>{a, b}, 0.4);
  const std::vector<double> wa = weights(mesh, a, 0.4), wb = weights(mesh, b, 0.4);
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_NEAR(both[i], 1 - (1 - wa[i]) * (1 - wb[i]), 1e-15);
  }
}

TEST(Region, text_is_read_as_it_is_documented) {
  EXPECT_EQ(std::get<BallRegion>(parse_region("ball:1,-2,3.5,4")).center, (Vec3{1, -2, 3.5}));
  EXPECT_EQ(std::get<BoxRegion>(parse_region("box:1,1,1,0,2,0")).min, (Vec3{0, 1, 0}));
  EXPECT_EQ(std::get<DiscRegion>(parse_region("vertex:7,0.5")).vertex, 7u);
  EXPECT_EQ(std::get<PropertyRegion>(parse_region("property:scar")).name, "scar");
  EXPECT_EQ(std::get<ColorRegion>(parse_region("color:FF8000")).rgb, 0xff8000u);
  for (const char* text : {"", "ball", "ball:1,2,3", "ball:1,2,3,nan", "ball:1,2,3,4x", "box:1,2",
                           "vertex:-1,2", "vertex:1", "vertex:", "property:", "color:12345",
                           "color:12345g", "cone:1,2,3", "ball:1,2,3,1e999"}) {
    EXPECT_THROW(parse_region(text), Error) << text;
  }
}

TEST(Region, what_holds_nothing_is_refused) {
  const Mesh mesh = test::sheet(10, 0.1);
  for (const Region& region : {Region{BallRegion{{9, 0, 0}, 1}}, Region{BallRegion{{0, 0, 0}, -1}},
                               Region{BoxRegion{{5, 5, 5}, {6, 6, 6}}},
                               Region{DiscRegion{999999, 1}}, Region{DiscRegion{0, std::nan("")}},
                               Region{PropertyRegion{"none"}}, Region{ColorRegion{0}}}) {
    EXPECT_THROW(weights(mesh, region, 0.1), Error);
  }
  EXPECT_THROW(weights(mesh, BallRegion{{0, 0, 0}, 1}, -1), Error);
}

}  // namespace
}  // namespace rholm
