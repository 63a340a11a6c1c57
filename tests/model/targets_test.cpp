// Whole pipelines with each instruction set in turn. Results differ by rounding and by near
// decisions that rounding changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "rholm/reconstruct.h"
#include "rholm/topology.h"
#include "support/reconstruct_checks.h"
#include "support/sizes.h"
#include "support/targets.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::random_in;

struct Body {
  const char* name;
  PointCloud cloud;
  std::function<double(const Vec3&)> distance;  // signed distance to its surface, outside positive
  std::ptrdiff_t euler;
  double volume;
};

// Radii are 1 and 0.4: a ring at theta has an area proportional to 1 + 0.4 cos(theta).
Body torus_body(std::size_t n) {
  Body body{"torus", {}, {}, 0, 2 * pi * pi * 0.16};
  for (std::uint64_t i = 0; body.cloud.points.size() < n; ++i) {
    const double theta = random_in(0, 2 * pi, 1, i), phi = random_in(0, 2 * pi, 2, i);
    if (random_in(0, 1.4, 3, i) > 1 + 0.4 * std::cos(theta)) continue;
    const Vec3 out{std::cos(phi), std::sin(phi), 0};
    const Vec3 normal = std::cos(theta) * out + Vec3{0, 0, std::sin(theta)};
    body.cloud.points.push_back(out + 0.4 * normal);
    body.cloud.normals.push_back(normal);
  }
  body.distance = [](const Vec3& x) { return std::hypot(std::hypot(x.x, x.y) - 1, x.z) - 0.4; };
  return body;
}

Body sphere_body(std::size_t n) {
  return {"sphere", test::sphere_points(n), [](const Vec3& x) { return norm(x) - 1; }, 2,
          4 * pi / 3};
}

// Semi-axes are 1, 0.6 and 0.3. At edges, decisions are near.
Body box_body(std::size_t n) {
  Body body{"box", {}, {}, 2, 8 * 0.18};
  const double half[3] = {1, 0.6, 0.3};
  const double areas[3] = {half[1] * half[2], half[2] * half[0], half[0] * half[1]};
  const double area = areas[0] + areas[1] + areas[2];
  for (std::uint64_t i = 0; i < n; ++i) {
    const double where = random_in(0, area, 4, i);
    const std::size_t axis = where < areas[0] ? 0 : where < areas[0] + areas[1] ? 1 : 2;
    const double sign = random_in(-1, 1, 5, i) < 0 ? -1 : 1;
    double at[3], normal[3] = {};
    for (std::size_t k = 0; k < 3; ++k) at[k] = random_in(-half[k], half[k], 6 + k, i);
    at[axis] = sign * half[axis];
    normal[axis] = sign;
    body.cloud.points.push_back({at[0], at[1], at[2]});
    body.cloud.normals.push_back({normal[0], normal[1], normal[2]});
  }
  body.distance = [](const Vec3& x) {
    const Vec3 q{std::abs(x.x) - 1, std::abs(x.y) - 0.6, std::abs(x.z) - 0.3};
    const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return norm(out) + std::min(0.0, std::max(q.x, std::max(q.y, q.z)));
  };
  return body;
}

double rms_of(const Mesh& mesh, const Body& body) {
  double sum = 0;
  for (const Vec3& v : mesh.vertices) sum += std::pow(body.distance(v), 2);
  return std::sqrt(sum / static_cast<double>(mesh.vertices.size()));
}

// Runs without noise and with noise of 0.25 % of the diagonal. Caps have all remainders of points
// by the lanes of a vector.
TEST_OF_TWO_SIZES(targets, reconstructions_have_the_same_topology_and_are_as_near) {
  std::vector<Body> bodies = {box_body(6000)};
  if (nightly) bodies = {sphere_body(4000), torus_body(6000), box_body(6000)};
  for (Body body : bodies) {
    for (const double noise : nightly ? std::vector{0.0, 0.007} : std::vector{0.0}) {
      for (std::size_t i = 0; noise > 0 && i < body.cloud.points.size(); ++i) {
        body.cloud.points[i] += noise * test::random_normal(9, i) * body.cloud.normals[i];
      }
      double first_rms = 0;
      test::for_each_target([&](const char* target) {
        SCOPED_TRACE(std::string(body.name) + " " + target + (noise > 0 ? " noise" : ""));
        const Reconstruction made = reconstruct(body.cloud);
        const Inspection found = test::expect_closed_manifold(made.mesh);
        EXPECT_EQ(found.components, 1U);
        EXPECT_EQ(found.euler_characteristic, body.euler);
        EXPECT_NEAR(enclosed_volume(made.mesh), body.volume, 0.01 * body.volume);
        const double rms = rms_of(made.mesh, body);
        if (first_rms == 0) first_rms = rms;
        EXPECT_NEAR(rms, first_rms, 0.02 * first_rms);
      });
    }
  }
}

}  // namespace
}  // namespace rholm
