#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::exploded;

// A sphere is cut in two at its equator, with a gap between the halves.
TEST(closing_tolerance, is_just_above_the_gap_of_a_seam) {
  const Mesh mesh = ellipsoid({1, 1, 1}, 4);
  for (const double gap : {1e-12, 1e-6, 1e-3}) {
    Mesh soup = exploded(mesh);
    for (std::size_t t = 0; t < soup.faces.size(); ++t) {
      double z = 0;
      for (int k = 0; k < 3; ++k) z += soup.vertices[3 * t + k].z;
      if (z < 0) {
        for (int k = 0; k < 3; ++k) soup.vertices[3 * t + k].z -= gap;
      }
    }
    const Mesh open = weld(soup).mesh;
    ASSERT_FALSE(inspect(open).closed);
    const std::optional<double> tolerance = closing_tolerance(open);
    ASSERT_TRUE(tolerance) << gap;
    EXPECT_TRUE(inspect(weld(open, *tolerance).mesh).closed) << gap;
    EXPECT_LE(*tolerance, std::max(2.2 * gap, 1e-6)) << gap;
  }
}

TEST(closing_tolerance, is_none_for_holes_and_for_closed_meshes) {
  Mesh mesh = icosphere(3);
  EXPECT_FALSE(closing_tolerance(mesh));
  mesh.faces.resize(mesh.faces.size() - 40);
  EXPECT_FALSE(closing_tolerance(mesh));
  EXPECT_FALSE(closing_tolerance(Mesh{}));
}

}  // namespace
}  // namespace rholm
