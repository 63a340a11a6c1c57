// Area and volume by the fast sums. Oracles are a box in closed form and the sums that keep
// slivers.
#include "shape/measure.h"

#include <gtest/gtest.h>

#include "rholm/primitives.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

UnitFrame frame_of(const Mesh& mesh) { return unit_frame(bounds(mesh.vertices)); }

Sizes sizes_of(const Mesh& mesh) { return measure_sizes(view_of(mesh), frame_of(mesh), {}); }

TEST(Sizes, of_a_box_are_those_of_its_sides) {
  for (const double scale : {1e-100, 1.0, 1e90}) {
    Mesh mesh = box({1, 2, 3});
    for (Vec3& v : mesh.vertices) v = scale * (v + Vec3{7, 0, -5});
    const Sizes sizes = sizes_of(mesh);
    EXPECT_NEAR(sizes.area / scale / scale, 22, 1e-13);
    EXPECT_NEAR(sizes.volume / scale / scale / scale, 6, 1e-13);
  }
}

// The mesh has several chunks.
TEST(Sizes, of_many_triangles_are_those_of_the_whole_measure) {
  const Mesh mesh = bumpy_sphere(5);
  const Sizes sizes = sizes_of(mesh);
  const Measures all = measure(view_of(mesh), frame_of(mesh));
  EXPECT_NEAR(sizes.area, all.area, 1e-14 * all.area);
  EXPECT_NEAR(sizes.volume, all.volume, 1e-14 * all.volume);
}

TEST(volume_centroid, is_that_of_the_whole_measure_and_of_a_moved_box) {
  const Mesh mesh = bumpy_sphere(5);
  const Measures all = measure(view_of(mesh), frame_of(mesh));
  EXPECT_NEAR(norm(volume_centroid(view_of(mesh), frame_of(mesh), {}) - all.volume_centroid), 0,
              1e-14);
  Mesh moved = box({1, 2, 3});
  for (Vec3& v : moved.vertices) v = 1e80 * (v + Vec3{7, 0, -5});
  const Bounds corners = bounds(moved.vertices);
  const Vec3 middle = corners.min + 0.5 * (corners.max - corners.min);
  EXPECT_NEAR(norm(volume_centroid(view_of(moved), frame_of(moved), {}) - middle) / 1e80, 0, 1e-13);
}

// A sheet with faces on both sides encloses no volume.
TEST(volume_centroid, of_no_volume_is_the_middle_of_the_frame) {
  Mesh sheet;
  sheet.vertices = {{0, 0, 1}, {2, 0, 1}, {0, 4, 1}};
  sheet.faces = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(volume_centroid(view_of(sheet), frame_of(sheet), {}), (Vec3{1, 2, 1}));
}

TEST(Sizes, of_nothing_are_none) {
  const Sizes sizes = measure_sizes(view_of(Mesh{}), {}, {});
  EXPECT_EQ(sizes.area, 0);
  EXPECT_EQ(sizes.volume, 0);
}

}  // namespace
}  // namespace rholm
