#include "transform/error/sampled_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/primitives.h"
#include "rholm/truncation.h"
#include "transform/error/error_sites.h"

namespace rholm {
namespace {

Expansion sphere_of_radius(double r) {
  Expansion expansion;
  expansion.coefficients = Coefficients(0);
  expansion.coefficients.c(0, 0) = r * std::sqrt(4 * std::numbers::pi);
  return expansion;
}

// The unit sphere about (0, 0, a) and the sphere of radius R about the origin. A point of the first
// at height z over its centre is ||x| - R| from the second; a point of the second is
// |y - (0, 0, a)| - 1| from the first. Heights are uniform on a sphere.
struct Spheres {
  double a, radius;

  double there(double z) const { return std::abs(std::sqrt(1 + a * a + 2 * a * z) - radius); }
  double back(double z) const {
    return std::abs(std::sqrt(radius * radius + a * a - 2 * a * radius * z) - 1);
  }
  double rms() const {
    constexpr int kHeights = 10'000;
    double sum_there = 0, sum_back = 0;
    for (int i = 0; i < kHeights; ++i) {
      const double z = (2 * i + 1.0) / kHeights - 1;
      sum_there += there(z) * there(z) / kHeights;
      sum_back += back(z) * back(z) / kHeights;
    }
    return std::sqrt(std::max(sum_there, sum_back));
  }
  double max() const { return std::max({there(-1), there(1), back(-1), back(1)}); }
};

TEST(sampled_distances, between_two_spheres_are_those_of_the_closed_form) {
  double first_order_is_off = 0;
  for (const Spheres& spheres : {Spheres{0.6, 1.4}, Spheres{0.7, 0.9}, Spheres{0.5, 0.6}}) {
    Mesh mesh = icosphere(5);
    for (Vec3& v : mesh.vertices) v.z += spheres.a;
    const MeshView view = view_of(mesh);
    ErrorSites sites(view, {});
    const ErrorPoints& points = sites.over_area();
    const RadialModel model(sphere_of_radius(spheres.radius), 0, points.size(), true, 1e-12, {});
    const PointErrors errors = point_errors(points, model, true, {});
    const SampledDistances found =
        sampled_distances(view, {}, model, {points, errors}, {points, errors}, {});
    // Flat faces lie up to 3e-4 inside the sphere.
    EXPECT_NEAR(found.rms, spheres.rms(), 2e-3 * spheres.rms());
    EXPECT_LT(found.rms_error, 2e-3);
    EXPECT_NEAR(found.max, spheres.max(), 1e-3 * spheres.max());
    EXPECT_TRUE(found.suffice(view));
    first_order_is_off =
        std::max(first_order_is_off, std::abs(rms_distance(errors, 0) / spheres.rms() - 1));
    const TruncationErrors said = truncation_errors(view, sphere_of_radius(spheres.radius));
    EXPECT_TRUE(said.distances_are_closest);
    EXPECT_NEAR(*said.distance_rms, spheres.rms(), 2e-3 * spheres.rms());
    EXPECT_NEAR(*said.measured_max_distance, spheres.max(), 1e-3 * spheres.max());
  }
  // First-order distances are measured to the planes of faces, not to the faces. The test only
  // shows that they differ.
  EXPECT_GT(first_order_is_off, 0.02);
}

TEST(sampled_distances, of_a_surface_that_is_the_model_are_nothing) {
  const Mesh mesh = icosphere(4);
  const MeshView view = view_of(mesh);
  ErrorSites sites(view, {});
  const ErrorPoints& points = sites.over_area();
  const RadialModel model(sphere_of_radius(1), 0, points.size(), true, 1e-12, {});
  PointErrors errors = point_errors(points, model, true, {});
  for (auto* values : {&errors.radial, &errors.to_model, &errors.to_shape}) {
    for (double& value : *values) value = 0;
  }
  const SampledDistances found =
      sampled_distances(view, {}, model, {points, errors}, {points, errors}, {});
  EXPECT_EQ(found.rms, 0);
  EXPECT_EQ(found.rms_error, 0);
}

}  // namespace
}  // namespace rholm
