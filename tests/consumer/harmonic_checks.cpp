// Functions on the sphere.
#include <rholm/align.h>
#include <rholm/coefficients.h>
#include <rholm/filter.h>
#include <rholm/grid.h>
#include <rholm/harmonic.h>
#include <rholm/length_unit.h>
#include <rholm/recenter.h>
#include <rholm/rotate.h>

#include <cmath>
#include <numbers>

#include "check.h"

namespace {

const double kPi = std::numbers::pi;
const double kRounding = 1e-12;

// Returns a sphere of that radius about its centre.
rholm::Expansion sphere(double radius, int degree) {
  rholm::Expansion expansion;
  expansion.coefficients = rholm::Coefficients(degree);
  expansion.coefficients.c(0, 0) = radius * std::sqrt(4 * kPi);
  return expansion;
}

void coefficients() {
  const rholm::Coefficients one = sphere(1, 2).coefficients;
  expect_near(rholm::power_spectrum(one)[0], 4 * kPi, kRounding, "the energy of f = 1");
  expect_near(rholm::to_convention(one, {}).c(0, 0), 1, kRounding, "c_00 of f = 1, 4-pi");
}

void harmonic() {
  rholm::Coefficients height(1);  // cos(theta)
  height.c(1, 0) = std::sqrt(4 * kPi / 3);
  const std::vector<rholm::Vec3> directions = {{0, 0, 1}, {0, 1, 0}, {0, 0.6, -0.8}};
  const std::vector<double> values = rholm::evaluate(height, directions);
  expect_near(values[0], 1, kRounding, "z at the pole");
  expect_near(values[1], 0, kRounding, "z at the equator");
  expect_near(values[2], -0.8, kRounding, "z below the equator");
  expect_near(rholm::gauss_legendre(2).nodes[0], std::sqrt(1.0 / 3), kRounding,
              "the larger zero of P_2");
}

void grid() {
  const rholm::Grid grid = rholm::smallest_grid(rholm::GridKind::kGaussLegendre, 3);
  expect(rholm::exact_degree(grid) >= 3, "the grid is exact to the degree it is made for");
  std::vector<double> values;
  for (const double theta : rholm::grid_colatitudes(grid)) {
    values.insert(values.end(), grid.n_phi, std::cos(theta));
  }
  expect_near(rholm::analyze_grid(values, grid, 3).c(1, 0), std::sqrt(4 * kPi / 3), kRounding,
              "C_10 of cos(theta)");
}

void filter() {
  const std::vector<double> gains = rholm::low_pass(2, 4, {.window = rholm::Window::kIdeal});
  expect(gains == std::vector<double>({1, 1, 1, 0, 0}), "the ideal low pass is 1, then 0");
}

void rotate() {
  rholm::Coefficients z(1);
  z.c(1, 0) = 1;
  const rholm::Coefficients x = rholm::rotate(z, rholm::rotation_about({0, 1, 0}, kPi / 2));
  expect_near(x.c(1, 1), 1, kRounding, "C_11 of z turned to x");
  expect_near(x.c(1, 0), 0, kRounding, "C_10 of z turned to x");
}

void recenter() {
  rholm::Expansion moved = sphere(1, 32);
  moved.center = {1, 2, 3};
  expect(rholm::norm(rholm::volume_centroid(moved) - moved.center) < kRounding,
         "the centroid of a sphere is its centre");
  const rholm::Expansion seen = rholm::recentered(moved, {1.2, 2, 3});
  const std::vector<rholm::Vec3> along_x = {{1, 0, 0}, {-1, 0, 0}};
  const std::vector<double> radii = rholm::evaluate(seen.coefficients, along_x);
  // The coefficients of the radius fall as 0.2^l: degrees above 32 are negligible.
  expect_near(radii[0], 0.8, 1e-9, "the nearest point of the sphere");
  expect_near(radii[1], 1.2, 1e-9, "the farthest point of the sphere");
}

void align() {
  rholm::Coefficients a(3);
  a.c(0, 0) = 4;
  a.c(1, 0) = 0.3;
  a.c(2, 1) = 0.2;
  a.s(3, 2) = 0.4;
  a.c(3, 3) = -0.1;
  const rholm::Rotation turn = rholm::rotation_about({1, 2, 2}, 0.7);
  const rholm::Alignment found = rholm::align(a, rholm::rotate(a, turn));
  expect_near(rholm::angle_between(found.best.rotation, turn), 0, 1e-6, "the turn left over");
  expect_near(found.best.distance, 0, 1e-6, "the distance after alignment");
}

void length_unit() {
  expect(rholm::metres_of("km") == 1000, "a km has 1000 m");
  expect(!rholm::metres_of("parrots"), "parrots are no unit");
  expect_near(rholm::scaled(sphere(1, 0), 1000).coefficients.c(0, 0), 1000 * std::sqrt(4 * kPi),
              1e-9, "a scaled sphere");
}

}  // namespace

std::vector<HeaderCheck> harmonic_checks() {
  return {{"coefficients.h", coefficients},
          {"harmonic.h", harmonic},
          {"grid.h", grid},
          {"filter.h", filter},
          {"rotate.h", rotate},
          {"recenter.h", recenter},
          {"align.h", align},
          {"length_unit.h", length_unit}};
}
