// Checks that every reconstruction must pass.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "rholm/error.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"

namespace rholm::test {

inline void expect_finite(const Mesh& mesh) {
  for (const Vec3& v : mesh.vertices) ASSERT_TRUE(is_finite(v));
  for (const Attribute& attribute : mesh.attributes) {
    for (const double value : attribute.values) ASSERT_TRUE(std::isfinite(value)) << attribute.name;
  }
}

inline void expect_manifold(const Inspection& found) {
  EXPECT_EQ(found.non_manifold_edges, 0U);
  EXPECT_EQ(found.non_manifold_vertices, 0U);
  EXPECT_EQ(found.misoriented_edges, 0U);
  EXPECT_EQ(found.duplicate_faces, 0U);
}

inline Inspection expect_closed_manifold(const Mesh& mesh) {
  validate(mesh);
  expect_finite(mesh);
  Inspection found = inspect(mesh);
  expect_manifold(found);
  EXPECT_EQ(found.boundary_edges, 0U);
  EXPECT_GT(found.faces, 0U);
  return found;
}

// Returns the message of the expected error, or "" if no error is thrown.
inline std::string refusal(PointCloud cloud, const ReconstructOptions& options = {},
                           ErrorCode code = ErrorCode::kInvalidInput) {
  try {
    reconstruct(std::move(cloud), options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "";
}

}  // namespace rholm::test
