// The kernel of a cap, in both precisions, with every instruction set. Expected values come from
// the dilation and the frame of chart/cap, from a linear function on the opened sphere, and from
// differences along its surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/opened_sphere_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/opened_sphere-inl.h"

#ifndef RHOLM_OPENED_SPHERE_TEST_ROWS
#define RHOLM_OPENED_SPHERE_TEST_ROWS
namespace rholm::test {
// Rows of results that the kernel gives for each point.
enum Row {
  kX,
  kY,
  kZ,
  kRho,  // kX ... kRho: the ray
  kS1,
  kS2,
  kOpenX,
  kOpenY,
  kOpenZ,  // kS1 ... kOpenZ: the place on the opened sphere
  kFactor,
  kLevel,
  kG1,
  kG2,
  kFlatness,  // kFactor ... kFlatness: the surface
  kPotential,
  kValid,
  kNx,
  kNy,
  kNz,
  kRows  // kNx ... kNz: normals in space
};
}  // namespace rholm::test
#endif

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Computes rows[kRows][stride] from offsets [3][stride] to the seed; stride is a multiple of 16.
template <class T>
void All(const LaneFrame<T>& frame, int degree, const T* coefficients, const T* offsets,
         std::size_t stride, T* rows) {
  const hn::CappedTag<T, 16> d;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t i = 0; i < stride; i += hn::Lanes(d)) {
    const CapRay<V> ray =
        RayTo(d, frame,
              ToFrame(d, frame, hn::LoadU(d, offsets + i), hn::LoadU(d, offsets + stride + i),
                      hn::LoadU(d, offsets + 2 * stride + i)));
    const OpenedPlace<V> place = Open(d, frame, ray);
    const LowSum<V> phi = SumLowHarmonics(d, degree, false, coefficients, place.at);
    const CapLevel<V> here = LevelOf(d, frame, place, phi);
    const Lanes3<V> normal = NormalOf(d, DirectionOf(d, ray), place, here);
    const V valid = hn::IfThenElseZero(HasPotential(d, ray, here), hn::Set(d, T(1)));
    const auto put = [&](int row, V value) HWY_ATTR {
      hn::StoreU(value, d, rows + static_cast<std::size_t>(row) * stride + i);
    };
    put(test::kX, ray.x), put(test::kY, ray.y), put(test::kZ, ray.z), put(test::kRho, ray.rho);
    put(test::kS1, place.s1), put(test::kS2, place.s2);
    put(test::kOpenX, place.at.x), put(test::kOpenY, place.at.y), put(test::kOpenZ, place.at.z);
    put(test::kFactor, ConformalFactor(d, frame, place));
    put(test::kLevel, here.level), put(test::kG1, here.g1), put(test::kG2, here.g2);
    put(test::kFlatness, here.flatness);
    put(test::kPotential, Potential(d, frame, ray, here)), put(test::kValid, valid);
    put(test::kNx, FromFrame(d, frame, 0, normal)), put(test::kNy, FromFrame(d, frame, 1, normal));
    put(test::kNz, FromFrame(d, frame, 2, normal));
  }
}
void AllFloat(const LaneFrame<float>& frame, int degree, const float* coefficients,
              const float* offsets, std::size_t stride, float* rows) {
  All(frame, degree, coefficients, offsets, stride, rows);
}
void AllDouble(const LaneFrame<double>& frame, int degree, const double* coefficients,
               const double* offsets, std::size_t stride, double* rows) {
  All(frame, degree, coefficients, offsets, stride, rows);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "chart/cap/cap_frame.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {
HWY_EXPORT(AllFloat);
HWY_EXPORT(AllDouble);

using namespace test;

constexpr std::size_t kMostPoints = 33;
constexpr double kUnit = 0.5;  // unit of length in which the kernel computes

CapFrame make_frame() { return cap_frame({1, 2, 3}, {0.3, -0.5, 0.9}, 0.4, 0.5, 1.4); }

// phi = slope . u' on the opened sphere. Harmonics of degree 1 are sqrt(3 / 4 pi) times z, x, y.
const Vec3 kSlope{0.11, -0.07, 0.05};
template <class T>
std::array<T, 4> coefficients() {
  const double one = std::sqrt(3 / (4 * std::numbers::pi));
  return {T(0), T(kSlope.z / one), T(kSlope.x / one), T(kSlope.y / one)};
}

Vec3 offset(std::size_t i) {
  return {random_in(-0.5, 0.5, 1, i), random_in(-0.5, 0.5, 2, i), random_in(-0.2, 0.2, 3, i)};
}

// Rows of n points. Values after the last point, and values that are not written, are NaN.
template <class T>
struct Seen {
  std::size_t stride = 0;
  std::vector<T> rows;
  double operator()(Row row, std::size_t i) const {
    return static_cast<double>(rows[static_cast<std::size_t>(row) * stride + i]);
  }
};
template <class T>
Seen<T> see(const CapFrame& frame, const std::vector<Vec3>& offsets) {
  const T nan = std::numeric_limits<T>::quiet_NaN();
  Seen<T> seen{(offsets.size() + 15) / 16 * 16, {}};
  std::vector<T> points(3 * seen.stride, nan);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    points[i] = static_cast<T>(offsets[i].x / kUnit);
    points[seen.stride + i] = static_cast<T>(offsets[i].y / kUnit);
    points[2 * seen.stride + i] = static_cast<T>(offsets[i].z / kUnit);
  }
  seen.rows.assign(kRows * seen.stride, nan);
  const LaneFrame<T> lanes = lane_frame<T>(frame, kUnit);
  if constexpr (std::is_same_v<T, float>) {
    HWY_DYNAMIC_DISPATCH(AllFloat)
    (lanes, 1, coefficients<T>().data(), points.data(), seen.stride, seen.rows.data());
  } else {
    HWY_DYNAMIC_DISPATCH(AllDouble)
    (lanes, 1, coefficients<T>().data(), points.data(), seen.stride, seen.rows.data());
  }
  return seen;
}

// Returns r(u) / R_0 in the direction of a ray in the frame.
double level_at(const CapFrame& frame, const Vec3& ray) {
  return 1 + dot(kSlope, dilated(frame.dilation, normalized(ray)));
}

// Returns the point of the surface in that direction, in space.
Vec3 surface_at(const CapFrame& frame, const Vec3& ray) {
  const Vec3 u = normalized(ray);
  return frame.center +
         frame.radius * level_at(frame, ray) * (u.x * frame.x + u.y * frame.y + u.z * frame.z);
}

// Returns the normal of the surface, by central differences along two tangents.
Vec3 normal_at(const CapFrame& frame, const Vec3& ray) {
  const double h = 1e-5;
  const Vec3 u = normalized(ray), e = normalized(cross(u, Vec3{0.3, 1, 0.2})), f = cross(u, e);
  return normalized(cross(surface_at(frame, u + h * e) - surface_at(frame, u - h * e),
                          surface_at(frame, u + h * f) - surface_at(frame, u - h * f)));
}

// `rounding` bounds the error of a few operations. Slopes have errors a few times as large.
template <class T>
void expect_all(const CapFrame& frame, const std::vector<Vec3>& offsets, const Seen<T>& seen,
                double rounding) {
  const double far = frame.radius / kUnit;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Vec3 ray = in_frame(frame, frame.seed() + offsets[i]), u = normalized(ray);
    const Vec3 opened = dilated(frame.dilation, u);
    EXPECT_NEAR(seen(kX, i), far * ray.x, far * rounding);
    EXPECT_NEAR(seen(kY, i), far * ray.y, far * rounding);
    EXPECT_NEAR(seen(kZ, i), far * ray.z, far * rounding);
    EXPECT_NEAR(seen(kRho, i), far * norm(ray), far * rounding);
    EXPECT_NEAR(seen(kS1, i), u.x / (1 + u.z), rounding);
    EXPECT_NEAR(seen(kS2, i), u.y / (1 + u.z), rounding);
    EXPECT_NEAR(seen(kOpenX, i), opened.x, 4 * rounding);
    EXPECT_NEAR(seen(kOpenY, i), opened.y, 4 * rounding);
    EXPECT_NEAR(seen(kOpenZ, i), opened.z, 4 * rounding);
    EXPECT_NEAR(seen(kFactor, i), conformal_factor(frame.dilation, u.z), 8 * rounding);
    const double level = level_at(frame, ray);
    EXPECT_NEAR(seen(kLevel, i), level, rounding);
    // |grad r|^2 / r^2 on the unopened sphere.
    const double steep = std::pow(conformal_factor(frame.dilation, u.z) / level, 2) *
                         (dot(kSlope, kSlope) - std::pow(dot(kSlope, opened), 2));
    const double flatness = 1 / std::sqrt(1 + steep);
    EXPECT_NEAR(std::hypot(seen(kG1, i), seen(kG2, i)), std::sqrt(steep), 8 * rounding);
    EXPECT_NEAR(seen(kFlatness, i), flatness, 4 * rounding);
    EXPECT_NEAR(seen(kPotential, i), far * (norm(ray) - level) * flatness, 8 * far * rounding);
    EXPECT_EQ(seen(kValid, i), 1);
    const Vec3 normal{seen(kNx, i), seen(kNy, i), seen(kNz, i)};
    EXPECT_NEAR(norm(normal - normal_at(frame, ray)), 0, 8 * rounding + 1e-9) << i;
  }
}

TEST(OpenedSphere, rays_places_potentials_and_normals_of_any_number_of_points) {
  const CapFrame frame = make_frame();
  for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    std::vector<Vec3> offsets;
    for (std::size_t n = 1; n <= kMostPoints; ++n) {
      offsets.push_back(offset(n));
      expect_all(frame, offsets, see<double>(frame, offsets), 4e-15);
      expect_all(frame, offsets, see<float>(frame, offsets), 2e-6);
    }
  });
}

TEST(OpenedSphere, points_do_not_depend_on_those_beside_them) {
  const CapFrame frame = make_frame();
  for_each_target([&](const char* target) {
    std::vector<Vec3> offsets;
    for (std::size_t n = 1; n <= kMostPoints; ++n) {
      offsets.push_back(offset(n));
      const Seen<float> all = see<float>(frame, offsets), one = see<float>(frame, {offset(n)});
      for (int row = 0; row < kRows; ++row) {
        EXPECT_EQ(all(static_cast<Row>(row), n - 1), one(static_cast<Row>(row), 0)) << target;
      }
    }
  });
}

// At the seed the ray is the axis, and the factor is the dilation.
TEST(OpenedSphere, at_the_seed_the_factor_is_the_dilation) {
  const CapFrame frame = make_frame();
  for_each_target([&](const char* target) {
    const Seen<double> seen = see<double>(frame, {Vec3{}});
    EXPECT_EQ(seen(kS1, 0), 0) << target;
    EXPECT_EQ(seen(kOpenZ, 0), 1) << target;
    EXPECT_EQ(seen(kFactor, 0), frame.dilation) << target;
    EXPECT_NEAR(seen(kLevel, 0), 1 + kSlope.z, 1e-15) << target;
  });
}

// Points behind the centre, at the centre, and opposite the axis, where the plane ends, have no
// potential, whatever the coefficients are.
TEST(OpenedSphere, there_is_no_potential_behind_the_centre) {
  const CapFrame frame = cap_frame({}, {0, 0, 1}, 0.4, 0.5, 1.4);
  const double below = frame.radius;
  const std::vector<Vec3> offsets = {
      {0, 0, -below}, {0, 0, -2 * below}, {0.1, 0, -1.01 * below}, {below, 0, -0.7 * below}};
  for_each_target([&](const char* target) {
    const Seen<float> in_float = see<float>(frame, offsets);
    const Seen<double> in_double = see<double>(frame, offsets);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      // The cosine of the last point is 0.287.
      EXPECT_EQ(in_float(kValid, i), 0) << target << " " << i;
      EXPECT_EQ(in_double(kValid, i), 0) << target << " " << i;
    }
  });
}

}  // namespace
}  // namespace rholm
#endif
