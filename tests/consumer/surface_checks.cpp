// From coefficients to surfaces.
#include <rholm/atlas.h>
#include <rholm/cap_frame.h>
#include <rholm/compare.h>
#include <rholm/descriptors.h>
#include <rholm/primitives.h>
#include <rholm/surface_rules.h>
#include <rholm/synthesize.h>

#include <cmath>
#include <numbers>

#include "check.h"

namespace {

void atlas() {
  expect(rholm::n_coefficients(rholm::CapBasis::kFull, 3) == 16, "(L + 1)^2");
  expect(rholm::n_coefficients(rholm::CapBasis::kEven, 3) == 10, "(L + 1) (L + 2) / 2");
  rholm::Cap cap;  // all coefficients zero: a sphere of radius 2 about the origin
  cap.frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, 1, 1};
  const std::vector<double> zero = {0};
  const rholm::CapValue outside = rholm::evaluate(cap, zero, {0, 1.8, 2.4});
  expect(outside.valid, "a cap has a potential in front of its centre");
  expect_near(outside.distance, 1, 1e-12, "the distance to a sphere of radius 2");
}

void cap_frame() {
  const rholm::CapFrame frame = {{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, 1, 1};
  expect_near(rholm::norm(frame.seed() - rholm::Vec3{1, 2, 5}), 0, 1e-15, "the seed of a cap");
}

void compare() {
  const rholm::Mesh box = rholm::box({1, 1, 1});
  rholm::Mesh raised = box;
  for (rholm::Vec3& vertex : raised.vertices) vertex.z += 0.25;
  expect_near(rholm::compare(box, raised, {.samples = 10000}).hausdorff, 0.25, 1e-12,
              "the distance between a box and itself, moved");
  expect_near(rholm::distances_to_surface({{0, 0, 2}}, box)[0], 1.5, 1e-12,
              "the distance of a point to a box");
}

void surface_rules() {
  const rholm::SurfaceRules rules;
  expect(rules.holes == rholm::HolePolicy::kFill,
         "holes are filled unless somebody says otherwise");
  expect(rholm::parse_name<rholm::HolePolicy>("keep") == rholm::HolePolicy::kKeep,
         "the name of a policy");
}

void synthesize() {
  rholm::Expansion sphere;
  sphere.coefficients.c(0, 0) = 2 * std::sqrt(4 * std::numbers::pi);
  sphere.center = {5, 0, 0};
  const rholm::SurfaceMeasures measures = rholm::measure(sphere);
  expect_near(measures.volume.value(), 32 * std::numbers::pi / 3, 1e-10, "the volume of a sphere");
  expect_near(measures.area.value(), 16 * std::numbers::pi, 1e-10, "the area of a sphere");
  const rholm::Mesh surface = rholm::synthesize(sphere, rholm::icosphere(1));
  expect_near(rholm::norm(surface.vertices[7] - sphere.center), 2, 1e-12, "a vertex of a sphere");
}

void descriptors() {
  rholm::Expansion sphere;
  sphere.coefficients.c(0, 0) = std::sqrt(4 * std::numbers::pi);
  const rholm::SurfaceMeasures measures = rholm::measure(sphere);
  for (const rholm::Descriptor& one : rholm::descriptors()) {
    if (one.name != std::string("sphericity")) continue;
    expect_near(one.value(measures).value(), 1, 1e-12, "the sphericity of a sphere");
    return;
  }
  expect(false, "the sphericity is a descriptor");
}

}  // namespace

std::vector<HeaderCheck> surface_checks() {
  return {{"atlas.h", atlas},
          {"cap_frame.h", cap_frame},
          {"compare.h", compare},
          {"descriptors.h", descriptors},
          {"surface_rules.h", surface_rules},
          {"synthesize.h", synthesize}};
}
