// Star-shaped shapes and their coefficients.
#include <rholm/monte_carlo.h>
#include <rholm/primitives.h>
#include <rholm/rms_beyond.h>
#include <rholm/star.h>
#include <rholm/transform.h>
#include <rholm/truncation.h>

#include <cmath>
#include <numbers>

#include "check.h"

namespace {

void star() {
  const rholm::StarReport box = rholm::find_center(rholm::box({2, 4, 6}), {});
  expect(box.star_shaped, "a box is star-shaped");
  expect_near(box.min_d, 1, 1e-6, "the radius of the largest ball in a box");
  expect(!rholm::find_center(rholm::torus(2, 0.5, 48, 24), {}).star_shaped, "a torus is not");
}

void transform() {
  const rholm::StarChart cube = rholm::make_star_chart(rholm::box({2, 2, 2}));
  // int r^2 dOmega over a face at distance 1 is int dA / sqrt(1 + x^2 + y^2), the potential of a
  // square.
  const double face =
      4 * (2 * std::log((1 + std::sqrt(3.0)) / std::sqrt(2.0)) - std::numbers::pi / 6);
  expect_near(rholm::radius_norm_squared(cube), 6 * face, 1e-10, "int r^2 dOmega of a cube");
  const rholm::Transform transform = rholm::expand(cube, {.degree = 8, .precision = 1e-10});
  const rholm::Coefficients& found = transform.expansion.coefficients;
  expect_near(found.c(2, 0), 0, 1e-9, "C_20 of a cube");
  expect_near(found.c(4, 2), 0, 1e-9, "C_42 of a cube");
  // The cubic harmonic of degree 4.
  expect_near(found.c(4, 4) / found.c(4, 0), std::sqrt(5.0 / 7), 1e-8, "C_44 / C_40 of a cube");
}

void monte_carlo() {
  const rholm::StarChart chart = rholm::make_star_chart(rholm::box({2, 2, 2}, 8));
  const rholm::MonteCarlo estimate = rholm::monte_carlo(chart, {.degree = 4, .samples = 64});
  const rholm::Transform exact = rholm::expand(chart, {.degree = 4});
  // The error is within 3 deviations for 99.7 % of all seeds, and for this seed.
  expect_near(estimate.expansion.coefficients.c(4, 0), exact.expansion.coefficients.c(4, 0),
              3 * estimate.deviation.c(4, 0), "C_40 at random");
}

void truncation() {
  const rholm::StarChart chart = rholm::make_star_chart(rholm::box({2, 2, 2}));
  const rholm::ToleranceTransform wanted = rholm::expand(chart, rholm::Tolerance{.error = 0.02});
  expect(wanted.met && wanted.reached <= 0.02, "a tolerance is kept");
  const rholm::Expansion& expansion = wanted.transform.expansion;
  rholm::Coefficients fewer = expansion.coefficients.resized(expansion.coefficients.degree() - 1);
  double energy = 0;
  for (const double of_degree : rholm::power_spectrum(fewer)) energy += of_degree;
  const double left = rholm::radius_norm_squared(chart) - energy;
  expect(std::sqrt(left / (4 * std::numbers::pi)) > 0.02, "by no degree less");
}

void rms_beyond() {
  const rholm::StarChart chart = rholm::make_star_chart(rholm::box({2, 2, 2}));
  const rholm::Transform found = rholm::expand(chart, {.degree = 8});
  const rholm::RmsBeyond beyond = rholm::rms_beyond(found.expansion);
  expect_near(beyond.rms[8].value(), found.truncation_rms.value(), 1e-9, "what degree 8 leaves");
}

}  // namespace

std::vector<HeaderCheck> star_checks() {
  return {{"star.h", star},
          {"transform.h", transform},
          {"monte_carlo.h", monte_carlo},
          {"rms_beyond.h", rms_beyond},
          {"truncation.h", truncation}};
}
