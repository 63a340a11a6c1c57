// Edits of chosen regions of a shape.
#include <rholm/primitives.h>
#include <rholm/region.h>
#include <rholm/smooth.h>
#include <rholm/transfer.h>

#include <algorithm>
#include <cmath>

#include "check.h"

namespace {

// Returns the vertex that lies farthest in that direction.
std::size_t tip(const rholm::Mesh& mesh, const rholm::Vec3& direction) {
  const auto last = std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                                     [&](const rholm::Vec3& a, const rholm::Vec3& b) {
                                       return rholm::dot(a, direction) < rholm::dot(b, direction);
                                     });
  return static_cast<std::size_t>(last - mesh.vertices.begin());
}

void region() {
  const rholm::Mesh sphere = rholm::icosphere(4);
  const std::vector<rholm::Region> regions = {rholm::parse_region("ball:0,0,1,0.5")};
  const std::vector<double> weights = rholm::region_weights(sphere, regions, 0.2);
  expect(weights[tip(sphere, {0, 0, 1})] == 1, "the pole is in the ball about it");
  expect(weights[tip(sphere, {0, 0, -1})] == 0, "the other pole is not");
}

void smooth() {
  const rholm::Mesh sphere = rholm::icosphere(5);
  const std::size_t top = tip(sphere, {0, 0, 1});
  const std::size_t bottom = tip(sphere, {0, 0, -1});
  rholm::Mesh spiked = sphere;
  for (const std::size_t at : {top, bottom}) spiked.vertices[at] *= 1.1;
  const std::vector<rholm::Region> regions = {rholm::BallRegion{{0, 0, 1}, 0.5}};
  const rholm::Patch patch = rholm::analyze_patch(spiked, regions, {.wavelength = 0.5});
  rholm::apply(patch, rholm::update(patch), spiked);
  expect_near(rholm::norm(spiked.vertices[top]), 1, 1e-3, "the radius where a spike was");
  expect(spiked.vertices[bottom] == 1.1 * sphere.vertices[bottom], "the other spike stays");
}

void transfer() {
  const rholm::Mesh smooth = rholm::icosphere(6);
  rholm::Mesh waves = smooth;
  const double amplitude = 0.01;
  for (rholm::Vec3& x : waves.vertices) x *= 1 + amplitude * std::cos(30 * x.y);
  const std::vector<rholm::Region> regions = {rholm::BallRegion{{0, 0, 1}, 0.6}};
  const rholm::TransferAnalysis analysis =
      rholm::analyze_transfer(waves, regions, smooth, regions, {.from_degree = 6});
  // The mean square of a cosine is 1/2.
  expect_near(analysis.report.source_rms, amplitude / std::sqrt(2.0), 0.2 * amplitude,
              "the height of waves");
  rholm::Mesh laid = analysis.mesh;
  rholm::apply(analysis.patch, rholm::update(analysis, {.angle = 0.0}), laid);
  const std::size_t top = tip(smooth, {0, 0, 1});
  expect_near(rholm::norm(laid.vertices[top]), 1 + amplitude, 0.2 * amplitude,
              "the crest of a wave, laid at the pole");
  const std::size_t bottom = tip(smooth, {0, 0, -1});
  expect(laid.vertices[bottom] == smooth.vertices[bottom], "the other pole stays");
}

}  // namespace

std::vector<HeaderCheck> edit_checks() {
  return {{"region.h", region}, {"smooth.h", smooth}, {"transfer.h", transfer}};
}
