#include "atlas/cap/cap_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Equations of a point: right-hand sides, already multiplied by their weights.
struct Asked {
  V value, slope1, slope2;
  V weight, slope_weight;
  LowDirection<V> at;
  V usable;  // 1 or 0
};

HWY_INLINE Asked Ask(D d, const LaneFrame<double>& f, const CapPoints& points,
                     double gradient_weight, std::size_t i) {
  const V one = hn::Set(d, 1.0);
  const std::size_t left = points.size() - HWY_MIN(i, points.size());
  const auto row = [&](std::size_t which) HWY_ATTR { return hn::Load(d, points.row(which) + i); };
  CapRay<V> ray = RayTo(d, f, ToFrame(d, f, row(0), row(1), row(2)));
  const Lanes3<V> n = ToFrame(d, f, row(3), row(4), row(5));
  V facing = hn::Div(hn::MulAdd(n.x, ray.x, hn::MulAdd(n.y, ray.y, hn::Mul(n.z, ray.z))), ray.rho);
  auto good = hn::And(hn::Gt(facing, hn::Set(d, kLeastFacing)),
                      hn::Gt(ray.z, hn::Mul(ray.rho, hn::Set(d, kLowest))));
  good = hn::And(good, hn::FirstN(d, left));
  Asked asked;
  asked.weight = hn::IfThenElseZero(good, hn::Sqrt(row(6)));
  asked.usable = hn::IfThenElseZero(good, one);
  // Unusable points are moved to the axis, since a weight of 0 does not undo a division by 0.
  ray = {hn::IfThenElseZero(good, ray.x), hn::IfThenElseZero(good, ray.y),
         hn::IfThenElse(good, ray.z, one), hn::IfThenElse(good, ray.rho, one)};
  facing = hn::IfThenElseZero(good, facing);
  const OpenedPlace<V> place = Open(d, f, ray);
  asked.at = place.at;
  // grad phi = (r / R_0) (u - n / (n . u)), method 7.4, along the tangents of the plane's axes.
  const V level = hn::Mul(ray.rho, hn::Set(d, 1 / f.radius));
  const V n_below = hn::Add(facing, n.z);
  const V steep = hn::IfThenElseZero(
      good, hn::Div(level, hn::Neg(hn::Mul(facing, ConformalFactor(d, f, place)))));
  asked.slope_weight = hn::Mul(asked.weight, hn::Set(d, gradient_weight));
  const V times = hn::Mul(asked.slope_weight, steep);
  asked.value = hn::IfThenElseZero(good, hn::Mul(asked.weight, hn::Sub(level, one)));
  asked.slope1 = hn::Mul(times, hn::NegMulAdd(place.s1, n_below, n.x));
  asked.slope2 = hn::Mul(times, hn::NegMulAdd(place.s2, n_below, n.y));
  return asked;
}

// Writes the rows of the least squares, multiplied by their weights: the right-hand sides, then
// for each harmonic its value and two slopes at each point. Rows are written whole, with zeros
// beyond the last point, because readers use whole vectors. Returns the number of usable points.
std::size_t FillRows(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                     double* rows, std::size_t third) {
  const D d;
  const LaneFrame<double> f = lane_frame<double>(frame);
  const V one = hn::Set(d, 1.0);
  const std::size_t stride = 3 * third;
  V usable = hn::Zero(d);
  for (std::size_t i = 0; i < third; i += hn::Lanes(d)) {
    const Asked asked = Ask(d, f, points, options.gradient_weight, i);
    const V weight = asked.weight, slope_weight = asked.slope_weight;
    const LowDirection<V>& at = asked.at;
    usable = hn::Add(usable, asked.usable);
    double* const right = rows + i;
    hn::Store(asked.value, d, right);
    hn::Store(asked.slope1, d, right + third);
    hn::Store(asked.slope2, d, right + 2 * third);
    V re = one, im = one, re_below = one, im_below = one;
    const V up = hn::Add(at.z, one);
    VisitLowHarmonics(
        d, options.degree, at,
        [&](int, V b0, V b1, V b2, V b3)
            HWY_ATTR { re = b0, im = b1, re_below = b2, im_below = b3; },
        [&](int l, int m, V p, V dp) HWY_ATTR {
          double* to = rows + (1 + low_index(l, m)) * stride + i;
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

// Writes the points as EvenPoints defines them, in whole rows like FillRows().
std::size_t FillPoints(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                       double* rows, std::size_t third) {
  const D d;
  const LaneFrame<double> f = lane_frame<double>(frame);
  V usable = hn::Zero(d);
  for (std::size_t i = 0; i < third; i += hn::Lanes(d)) {
    const Asked asked = Ask(d, f, points, options.gradient_weight, i);
    const LowDirection<V>& at = asked.at;
    usable = hn::Add(usable, asked.usable);
    const V values[EvenPoints::kRows] = {
        asked.value, asked.slope1, asked.slope2, asked.weight, at.x, at.y, at.z, at.s1, at.s2};
    for (std::size_t r = 0; r < EvenPoints::kRows; ++r) {
      hn::Store(values[r], d, rows + r * third + i);
    }
  }
  return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, usable)) + 0.5);
}

// Computes target = sum of the rows times the coefficients, minus the right-hand side.
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

// Does so for values at kCount vectors of points at once, as one waits for its recurrence.
template <std::size_t kCount>
HWY_INLINE void ValueResiduals(const EvenPoints& points, const double* coefficients, int degree,
                               std::size_t i, double* target) {
  const D d;
  const EvenHarmonics& h = even_harmonics();
  V x[kCount], y[kCount], z2[kCount], re[kCount], im[kCount], sum[kCount];
  const auto row = [&](EvenPoints::Row which, std::size_t g)
                       HWY_ATTR { return hn::Load(d, points.row(which) + i + g * hn::Lanes(d)); };
  for (std::size_t g = 0; g < kCount; ++g) {
    x[g] = row(EvenPoints::kX, g), y[g] = row(EvenPoints::kY, g);
    z2[g] = hn::Mul(row(EvenPoints::kZ, g), row(EvenPoints::kZ, g));
    re[g] = hn::Set(d, 1.0), im[g] = sum[g] = hn::Zero(d);
  }
  for (int m = 0; m <= degree; ++m) {
    V cosine[kCount], sine[kCount], p0[kCount], p1[kCount];
    for (std::size_t g = 0; g < kCount; ++g) {
      cosine[g] = sine[g] = p0[g] = hn::Zero(d), p1[g] = hn::Set(d, h.start[m]);
    }
    for (int l = m; l <= degree; l += 2) {
      const double* const c = coefficients + even_index(l, m);
      const V a = hn::Set(d, h.a[m][l]), b = hn::Set(d, h.b[m][l]), e = hn::Set(d, h.c[m][l]);
      const V of_cosine = hn::Set(d, c[0]), of_sine = m > 0 ? hn::Set(d, c[1]) : hn::Zero(d);
      for (std::size_t g = 0; g < kCount; ++g) {
        cosine[g] = hn::MulAdd(of_cosine, p1[g], cosine[g]);
        sine[g] = hn::MulAdd(of_sine, p1[g], sine[g]);
        const V next = hn::MulSub(hn::MulSub(a, z2[g], b), p1[g], hn::Mul(e, p0[g]));
        p0[g] = p1[g], p1[g] = next;
      }
    }
    for (std::size_t g = 0; g < kCount; ++g) {
      sum[g] = hn::MulAdd(cosine[g], re[g], hn::MulAdd(sine[g], im[g], sum[g]));
      const V next = hn::MulSub(x[g], re[g], hn::Mul(y[g], im[g]));
      im[g] = hn::MulAdd(x[g], im[g], hn::Mul(y[g], re[g]));
      re[g] = next;
    }
  }
  for (std::size_t g = 0; g < kCount; ++g) {
    hn::Store(hn::MulSub(row(EvenPoints::kWeight, g), sum[g], row(EvenPoints::kValue, g)), d,
              target + i + g * hn::Lanes(d));
  }
}

// Computes residuals of points: [value, slope 1, slope 2][length], or values alone.
void EvenResiduals(const EvenPoints& points, const double* coefficients, int degree, bool slopes,
                   double* target) {
  const D d;
  const std::size_t length = points.length, n = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + 2 * n <= length; i += 2 * n) {
    ValueResiduals<2>(points, coefficients, degree, i, target);
  }
  for (; i < length; i += n) ValueResiduals<1>(points, coefficients, degree, i, target);
  for (i = 0; slopes && i < length; i += n) {
    const auto row = [&](EvenPoints::Row which)
                         HWY_ATTR { return hn::Load(d, points.row(which) + i); };
    const LowDirection<V> at{row(EvenPoints::kX), row(EvenPoints::kY), row(EvenPoints::kZ),
                             row(EvenPoints::kS1), row(EvenPoints::kS2)};
    const LowSum<V> sum = SumLowHarmonics(d, degree, true, coefficients, at);
    const V weight = hn::Mul(row(EvenPoints::kWeight), hn::Set(d, points.gradient_weight));
    hn::Store(hn::MulSub(weight, sum.d1, row(EvenPoints::kSlope1)), d, target + length + i);
    hn::Store(hn::MulSub(weight, sum.d2, row(EvenPoints::kSlope2)), d, target + 2 * length + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(FillRows);
HWY_EXPORT(FillPoints);
HWY_EXPORT(Residuals);
HWY_EXPORT(EvenResiduals);

// Pivots below this part of their diagonal element have lost all digits.
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
    // Padding points lie on the axis with weight 0, so that no division by 0 occurs.
    for (std::size_t which = 0; which < 7; ++which) data_[which * capacity_ + i] = 0;
  }
}

void add_sunflower(const CapFrame& frame, std::size_t n, CapPoints& points) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0)), c = std::cos(turn),
               s = std::sin(turn);
  double x = frame.support / std::sqrt(static_cast<double>(n)), y = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double r = std::sqrt(static_cast<double>(k) + 0.5);
    points.add(r * x * frame.x + r * y * frame.y, frame.z, 1);
    const double before = x;
    x = c * x - s * y, y = s * before + c * y;
  }
}

namespace {

// Makes the matrix from the points or rows in the scratch memory, if there are enough.
void make_matrix(CapSystem& system, CapFitScratch& scratch) {
  const CapFitOptions& options = system.options;
  const std::size_t n = system.n, third = system.third;
  system.solvable = 3 * system.usable >= n;
  if (!system.solvable) return;
  double* const rows = scratch.rows.data();
  scratch.matrix.resize((n + 1) * (n + 1));
  poison_scratch(std::span(scratch.matrix));
  if (options.basis == CapBasis::kEven) {
    make_even_matrix({rows, third, options.gradient_weight}, options.degree, scratch.moments,
                     scratch.matrix.data());
  } else {
    clear_beyond(rows, n + 1, 3 * third);
    make_normal_matrix({.rows = rows, .count = n + 1, .length = 3 * third, .stride = 3 * third},
                       scratch.matrix.data());
  }
  for (int l = 0; l <= options.degree; ++l) {
    const double square = static_cast<double>(l) * (l + 1) * l * (l + 1);
    const std::size_t end = n_coefficients(options.basis, l);
    for (std::size_t i = l == 0 ? 0 : n_coefficients(options.basis, l - 1); i < end; ++i) {
      scratch.matrix[normal_diagonal(i, n)] += options.penalty * system.weights * square;
    }
  }
}

}  // namespace

CapSystem make_system(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                      CapFitScratch& scratch) {
  const bool even = options.basis == CapBasis::kEven;
  CapSystem system{.n = n_coefficients(options.basis, options.degree),
                   .third = padded(points.size()),
                   .options = options};
  const std::size_t third = system.third;
  const std::size_t wanted = (even ? EvenPoints::kRows + 3 : 3 * (system.n + 6)) * third;
  if (scratch.rows.size() < wanted) scratch.rows = AlignedArray<double>(2 * wanted);
  double* const rows = scratch.rows.data();
  poison_scratch(rows, wanted * sizeof(double));
  system.usable = even ? HWY_DYNAMIC_DISPATCH(FillPoints)(frame, points, options, rows, third)
                       : HWY_DYNAMIC_DISPATCH(FillRows)(frame, points, options, rows, third);
  for (std::size_t i = 0; i < points.size(); ++i) system.weights += points.weight(i);
  make_matrix(system, scratch);
  return system;
}

CapSystem with_degree(const CapSystem& system, int degree, CapFitScratch& scratch) {
  CapSystem other = system;
  other.options.degree = degree;
  other.n = n_coefficients(CapBasis::kEven, degree);
  make_matrix(other, scratch);
  return other;
}

const double* residuals(const CapSystem& system, std::span<const double> coefficients, bool slopes,
                        CapFitScratch& scratch) {
  const CapFitOptions& options = system.options;
  double* const rows = scratch.rows.data();
  const std::size_t third = system.third;
  if (options.basis == CapBasis::kEven) {
    int degree = 0;
    while (n_coefficients(options.basis, degree) < coefficients.size()) ++degree;
    double* const target = rows + EvenPoints::kRows * third;
    HWY_DYNAMIC_DISPATCH(EvenResiduals)
    ({rows, third, options.gradient_weight}, coefficients.data(), degree, slopes, target);
    return target;
  }
  double* const target = rows + 3 * (system.n + 1) * third;
  HWY_DYNAMIC_DISPATCH(Residuals)
  (rows, coefficients.data(), coefficients.size(), slopes ? 3 * third : third, 3 * third, target);
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
  const double* const rest = residuals(system, fit.coefficients, true, scratch);
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
