// Tests for builds of rholm without Qhull.
#include <gtest/gtest.h>

#include <string>

#include "paper/patches/sphere_delaunay.h"
#include "rholm/error.h"

namespace rholm {
namespace {

TEST(SphereDelaunay, is_refused_without_qhull) {
  try {
    sphere_delaunay(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("Qhull"), std::string::npos);
  }
}

}  // namespace
}  // namespace rholm
