#include "atlas/cap/cap_fit.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/cap_fit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/opened_sphere-inl.h"
#include "base/poison.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

// Rows of the least squares, each multiplied by its weight: the right-hand sides, then for every
// harmonic its value and two slopes at each point. All of a row is written, zeros beyond the last
// point: what takes rows reads them whole, whatever the lanes.
std::size_t FillRows(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                     double* rows, std::size_t stride) {
  const D d;
  const LaneFrame<double> f = lane_frame<double>(frame);
  const V one = hn::Set(d, 1.0);
  const bool even = options.basis == CapBasis::kEven;
  const std::size_t third = stride / 3;
  V usable = hn::Zero(d);
  for (std::size_t i = 0; i < third; i += hn::Lanes(d)) {
    const std::size_t left = points.size() - HWY_MIN(i, points.size());
    const auto row = [&](std::size_t which) HWY_ATTR { return hn::Load(d, points.row(which) + i); };
    CapRay<V> ray = RayTo(d, f, ToFrame(d, f, row(0), row(1), row(2)));
    const Lanes3<V> n = ToFrame(d, f, row(3), row(4), row(5));
    V facing =
        hn::Div(hn::MulAdd(n.x, ray.x, hn::MulAdd(n.y, ray.y, hn::Mul(n.z, ray.z))), ray.rho);
    auto good = hn::And(hn::Gt(facing, hn::Set(d, kLeastFacing)),
                        hn::Gt(ray.z, hn::Mul(ray.rho, hn::Set(d, kLowest))));
    good = hn::And(good, hn::FirstN(d, left));
    const V weight = hn::IfThenElseZero(good, hn::Sqrt(row(6)));
    usable = hn::Add(usable, hn::IfThenElseZero(good, one));
    // What is left out counts as on the axis: a weight of zero does not undo a division by it.
    ray = {hn::IfThenElseZero(good, ray.x), hn::IfThenElseZero(good, ray.y),
           hn::IfThenElse(good, ray.z, one), hn::IfThenElse(good, ray.rho, one)};
    facing = hn::IfThenElseZero(good, facing);
    const OpenedPlace<V> place = Open(d, f, ray);
    const LowDirection<V>& at = place.at;
    // grad phi = (r / R_0) (u - n / (n . u)), method 7.4, along the tangents of the plane's axes.
    const V level = hn::Mul(ray.rho, hn::Set(d, 1 / f.radius));
    const V n_below = hn::Add(facing, n.z);
    const V steep = hn::IfThenElseZero(
        good, hn::Div(level, hn::Neg(hn::Mul(facing, ConformalFactor(d, f, place)))));
    const V slope_weight = hn::Mul(weight, hn::Set(d, options.gradient_weight));
    double* const right = rows + i;
    hn::Store(hn::IfThenElseZero(good, hn::Mul(weight, hn::Sub(level, one))), d, right);
    hn::Store(hn::Mul(hn::Mul(slope_weight, steep), hn::NegMulAdd(place.s1, n_below, n.x)), d,
              right + third);
    hn::Store(hn::Mul(hn::Mul(slope_weight, steep), hn::NegMulAdd(place.s2, n_below, n.y)), d,
              right + 2 * third);
    V re = one, im = one, re_below = one, im_below = one;
    const V up = hn::Add(at.z, one);
    VisitLowHarmonics(
        d, options.degree, at,
        [&](int, V b0, V b1, V b2, V b3)
            HWY_ATTR { re = b0, im = b1, re_below = b2, im_below = b3; },
        [&](int l, int m, V p, V dp) HWY_ATTR {
          if (even && ((l + m) & 1) != 0) return;
          const std::size_t index = even ? even_index(l, m) : low_index(l, m);
          double* to = rows + (1 + index) * stride + i;
          const V order = hn::Set(d, static_cast<double>(m));
          const V turn = hn::MulAdd(order, p, hn::Mul(up, dp)), pm = hn::Mul(order, p);
          hn::Store(hn::Mul(weight, hn::Mul(p, re)), d, to);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s1, hn::Mul(turn, re), hn::Mul(pm, re_below))),
              d, to + third);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulSub(at.s2, hn::Mul(turn, re), hn::Mul(pm, im_below))),
              d, to + 2 * third);
          if (m == 0) return;
          to += stride;
          hn::Store(hn::Mul(weight, hn::Mul(p, im)), d, to);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s1, hn::Mul(turn, im), hn::Mul(pm, im_below))),
              d, to + third);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s2, hn::Mul(turn, im), hn::Mul(pm, re_below))),
              d, to + 2 * third);
        });
  }
  return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, usable)) + 0.5);
}

// target = rows' sum with the coefficients, minus the right-hand side.
void Residuals(const double* rows, const double* coefficients, std::size_t n, std::size_t length,
               std::size_t stride, double* target) {
  const D d;
  for (std::size_t k = 0; k < length; k += hn::Lanes(d)) {
    V sum = hn::Neg(hn::Load(d, rows + k));
    for (std::size_t i = 0; i < n; ++i) {
      sum = hn::MulAdd(hn::Set(d, coefficients[i]), hn::Load(d, rows + (1 + i) * stride + k), sum);
    }
    hn::Store(sum, d, target + k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(FillRows);
HWY_EXPORT(Residuals);

// Pivots below that part of their diagonal element have lost all digits.
constexpr double kLeastPivot = 1e-14;

double sum_of_squares(const double* values, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += values[i] * values[i];
  return sum;
}

}  // namespace

void CapPoints::add(const Vec3& offset, const Vec3& normal, double weight) {
  if (n_ + kCapLanes >= capacity_) {
    const std::size_t larger = std::max<std::size_t>(64, 2 * capacity_);
    AlignedArray<double> data(7 * larger);
    for (std::size_t which = 0; which < 7; ++which) {
      std::copy_n(row(which), n_, data.data() + which * larger);
    }
    data_ = std::move(data);
    capacity_ = larger;
  }
  double* const at = data_.data() + n_;
  const double values[7] = {offset.x, offset.y, offset.z, normal.x, normal.y, normal.z, weight};
  for (std::size_t which = 0; which < 7; ++which) at[which * capacity_] = values[which];
  ++n_;
}

void CapPoints::pad() {
  for (std::size_t i = n_; i < std::min(n_ + kCapLanes, capacity_); ++i) {
    // A point on the axis, without weight: nothing to divide by zero.
    for (std::size_t which = 0; which < 7; ++which) data_[which * capacity_ + i] = 0;
  }
}

CapSystem make_system(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                      CapFitScratch& scratch) {
  CapSystem system;
  const std::size_t n = n_coefficients(options.basis, options.degree);
  system.n = n;
  system.third = padded(points.size());
  system.stride = 3 * system.third;
  const std::size_t wanted = (n + 6) * system.stride;
  if (scratch.rows.size() < wanted) scratch.rows = AlignedArray<double>(2 * wanted);
  double* const rows = scratch.rows.data();
  poison_scratch(rows, wanted * sizeof(double));
  system.usable = HWY_DYNAMIC_DISPATCH(FillRows)(frame, points, options, rows, system.stride);
  clear_beyond(rows, n + 1, system.stride);
  for (std::size_t i = 0; i < points.size(); ++i) system.weights += points.weight(i);
  if (3 * system.usable < n) return system;
  scratch.matrix.resize((n + 1) * (n + 1));
  poison_scratch(std::span(scratch.matrix));
  make_normal_matrix(
      {.rows = rows, .count = n + 1, .length = system.stride, .stride = system.stride},
      scratch.matrix.data());
  for (int l = 0; l <= options.degree; ++l) {
    const double square = static_cast<double>(l) * (l + 1) * l * (l + 1);
    const std::size_t end = n_coefficients(options.basis, l);
    for (std::size_t i = l == 0 ? 0 : n_coefficients(options.basis, l - 1); i < end; ++i) {
      scratch.matrix[normal_diagonal(i, n)] += options.penalty * system.weights * square;
    }
  }
  system.solvable = true;
  return system;
}

const double* residuals(const CapSystem& system, std::span<const double> coefficients,
                        std::size_t length, CapFitScratch& scratch) {
  double* const rows = scratch.rows.data();
  double* const target = rows + (system.n + 1) * system.stride;
  HWY_DYNAMIC_DISPATCH(Residuals)
  (rows, coefficients.data(), coefficients.size(), length, system.stride, target);
  return target;
}

bool fit_cap(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
             CapFitScratch& scratch, CapFit& fit) {
  const CapSystem system = make_system(frame, points, options, scratch);
  const std::size_t n = system.n, third = system.third;
  fit.usable = static_cast<double>(system.usable) /
               static_cast<double>(std::max<std::size_t>(1, points.size()));
  if (!system.solvable) return false;
  if (scratch.factor.factor(scratch.matrix.data(), n, kLeastPivot) < n) return false;
  scratch.factor.solve(n, fit.coefficients);
  const double* const rest = residuals(system, fit.coefficients, system.stride, scratch);
  fit.rms = frame.radius * std::sqrt(sum_of_squares(rest, third) / system.weights);
  fit.slope_rms = std::sqrt(sum_of_squares(rest + third, 2 * third) /
                            (system.weights * options.gradient_weight * options.gradient_weight));
  fit.deviation = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    fit.deviation = std::max(fit.deviation, std::abs(dot(points.offset(i), frame.z)));
  }
  return true;
}

}  // namespace rholm
#endif
