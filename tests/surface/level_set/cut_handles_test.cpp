// Bridges and tunnels that are cut, and rods that are not cut. Oracles are counts by inspect() and
// distances from planes.
#include "surface/level_set/cut_handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/test_shapes.h"
#include "surface/level_set/tight_places.h"

namespace rholm {
namespace {

constexpr double kRadius = 2;

// Returns a ring about z whose tube has a radius that depends on the angle.
template <typename Tube>
Mesh ring(const Tube& tube_radius, int around = 48) {
  Mesh mesh = torus(kRadius, 0.5, 300, around);
  for (Vec3& v : mesh.vertices) {
    const double phi = std::atan2(v.y, v.x);
    const Vec3 middle{kRadius * std::cos(phi), kRadius * std::sin(phi), 0};
    v = middle + tube_radius(phi) / 0.5 * (v - middle);
  }
  test::add_normals(mesh);
  return mesh;
}

// The ring is 1.2 wide, except for a neck: at arc length s from it the radius is hypot(narrow, 4
// s).
Mesh with_neck(double narrow) {
  return ring([=](double phi) {
    return std::min(0.6, std::sqrt(narrow * narrow + std::pow(4 * kRadius * phi, 2)));
  });
}

Resolution everywhere(double resolution) {
  return {.typical = resolution, .at = [=](const Vec3&) { return resolution; }};
}

TEST(cut_handles, takes_a_bridge_between_two_walls) {
  for (const double narrow : {0.02, 0.05}) {
    Mesh mesh = with_neck(narrow);
    const Inspection before = inspect(mesh);
    const CutHandles cut = cut_handles(mesh, everywhere(0.15), {});
    EXPECT_EQ(cut.handles, 1U);
    const Inspection after = inspect(mesh);
    EXPECT_TRUE(after.closed && after.manifold && after.oriented);
    EXPECT_EQ(after.components, 1U);
    EXPECT_EQ(after.euler_characteristic, 2);
    EXPECT_EQ(mesh.vertices.size(), before.vertices + cut.copies.size());
    // Smoothing changes less than a ball of that radius at the neck.
    EXPECT_NEAR(after.volume, before.volume, 4.0 / 3 * std::numbers::pi * std::pow(0.2, 3));
    double least = 1;
    for (const Vec3& v : mesh.vertices) {
      if (v.x > 0) least = std::min(least, std::abs(v.y));
    }
    EXPECT_GT(least, 1e-3);  // both ends have retracted
    for (const Attribute& attribute : mesh.attributes) {
      EXPECT_EQ(attribute.values.size(), mesh.vertices.size());
      EXPECT_EQ(attribute.values.back(), 0);
    }
  }
}

TEST(cut_handles, takes_a_hole_through_a_thin_wall) {
  // Inside out, the neck is a hole through the wall between two cavities.
  Mesh mesh = with_neck(0.05);
  flip(mesh);
  EXPECT_EQ(cut_handles(mesh, everywhere(0.15), {}).handles, 1U);
  EXPECT_EQ(inspect(mesh).euler_characteristic, 2);
}

TEST(cut_handles, leaves_rods_however_thin) {
  for (const double radius : {0.02, 0.05, 0.1}) {
    Mesh mesh = ring([=](double) { return radius; });
    const Mesh before = mesh;
    EXPECT_EQ(cut_handles(mesh, everywhere(0.15), {}).handles, 0U);
    EXPECT_EQ(mesh.vertices, before.vertices);
    EXPECT_EQ(mesh.faces, before.faces);
  }
}

TEST(cut_handles, leaves_what_is_wider_than_five_resolutions) {
  Mesh mesh = with_neck(0.05);
  EXPECT_EQ(cut_handles(mesh, everywhere(2 * std::numbers::pi * 0.05 / 5.5), {}).handles, 0U);
}

TEST(cut_handles, leaves_necks_without_which_there_would_be_two_parts) {
  // An hourglass has no handle.
  Mesh mesh = icosphere(5);
  for (Vec3& v : mesh.vertices) {
    const double wide = std::min(1.0, 0.05 + 3 * std::abs(v.z));
    v = {wide * v.x, wide * v.y, v.z};
  }
  test::add_normals(mesh);
  EXPECT_EQ(cut_handles(mesh, everywhere(0.15), {}).handles, 0U);
  // A ring with two necks: if both were cut there would be two parts.
  Mesh two = ring([](double phi) {
    const double along = 4 * kRadius * std::min(std::abs(phi), std::numbers::pi - std::abs(phi));
    return std::min(0.6, std::hypot(0.05, along));
  });
  EXPECT_EQ(cut_handles(two, everywhere(0.15), {}).handles, 1U);
  EXPECT_EQ(inspect(two).components, 1U);
  EXPECT_EQ(inspect(two).euler_characteristic, 2);
}

// A ring with a neck that is cut on one side, and a rod that stays on the other side.
TEST(places_to_cut, are_all_that_cutting_needs) {
  constexpr double kResolution = 0.07;
  const Mesh whole = ring(
      [](double phi) {
        const double neck = std::hypot(0.05, 4 * kRadius * phi);
        const double rod = 0.05 + 2 * std::max(0.0, std::numbers::pi - std::abs(phi) - 0.4);
        return std::min({0.6, neck, rod});
      },
      12);
  Mesh with_normals = whole;
  const std::vector<std::uint32_t> places =
      tight_places(whole, normal_attributes(with_normals), length_of_tight_places(kResolution), {});
  const auto is_of_rod = [&](std::uint32_t v) { return whole.vertices[v].x < 0; };
  ASSERT_TRUE(std::any_of(places.begin(), places.end(), is_of_rod));
  const std::vector<std::uint32_t> kept = places_to_cut(whole, places, everywhere(kResolution), {});
  EXPECT_FALSE(kept.empty());
  EXPECT_FALSE(std::any_of(kept.begin(), kept.end(), is_of_rod));
  Mesh few = whole, all = whole;
  EXPECT_EQ(cut_handles_at(few, kept, everywhere(kResolution), {}, {}).handles, 1U);
  EXPECT_EQ(cut_handles_at(all, places, everywhere(kResolution), {}, {}).handles, 1U);
  EXPECT_EQ(few.vertices, all.vertices);
  EXPECT_EQ(few.faces, all.faces);
  std::vector<std::uint32_t> of_rod;
  std::copy_if(places.begin(), places.end(), std::back_inserter(of_rod), is_of_rod);
  EXPECT_TRUE(places_to_cut(whole, of_rod, everywhere(kResolution), {}).empty());
}

}  // namespace
}  // namespace rholm
