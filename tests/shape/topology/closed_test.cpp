#include "shape/topology/closed.h"

#include <gtest/gtest.h>

#include <utility>

#include "rholm/primitives.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

TEST(is_closed, asks_for_every_edge_both_ways) {
  const Mesh closed = test::rotated(bumpy_sphere(2, 0.3));
  EXPECT_TRUE(is_closed(view_of(closed)));
  // Each face has its own corners.
  Mesh copies;
  for (const Triangle& t : closed.faces) {
    const auto first = static_cast<std::uint32_t>(copies.vertices.size());
    for (const std::uint32_t i : t) copies.vertices.push_back(closed.vertices[i]);
    copies.faces.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(is_closed(view_of(copies)));
  // A face has two corners at one place.
  copies.faces.push_back({0, 0, 1});
  copies.faces.push_back({1, 0, 0});
  EXPECT_TRUE(is_closed(view_of(copies)));
  Mesh open = closed;
  open.faces.pop_back();
  EXPECT_FALSE(is_closed(view_of(open)));
  Mesh turned = closed;
  std::swap(turned.faces[7][0], turned.faces[7][1]);
  EXPECT_FALSE(is_closed(view_of(turned)));
  // The tube is open at both ends, but the missing parts have no area in the sum.
  Mesh tube = torus(2, 0.5, 40, 20);
  std::erase_if(tube.faces, [&](const Triangle& t) { return tube.vertices[t[0]].x > 0; });
  EXPECT_FALSE(is_closed(view_of(tube)));
}

}  // namespace
}  // namespace rholm
