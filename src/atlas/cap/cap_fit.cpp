#include "atlas/cap/cap_fit.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/cap_fit.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/cap_limits.h"
#include "base/poison.h"
#include "harmonic/legendre/low_harmonics-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

HWY_INLINE V Dot(D d, const Vec3& a, V x, V y, V z) {
  return hn::MulAdd(hn::Set(d, a.x), x,
                    hn::MulAdd(hn::Set(d, a.y), y, hn::Mul(hn::Set(d, a.z), z)));
}

// Rows of the least squares, each multiplied by its weight: for every harmonic its value and two
// slopes at each point, then the right-hand sides. All of a row is written, zeros beyond the last
// point: what takes rows reads them whole, whatever the lanes.
std::size_t FillRows(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                     double* rows, std::size_t stride) {
  const D d;
  const V one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const bool even = options.basis == CapBasis::kEven;
  const std::size_t n_basis = n_coefficients(options.basis, options.degree), third = stride / 3;
  V usable = hn::Zero(d);
  for (std::size_t i = 0; i < third; i += hn::Lanes(d)) {
    const std::size_t left = points.size() - HWY_MIN(i, points.size());
    const V px = hn::Load(d, points.row(0) + i), py = hn::Load(d, points.row(1) + i);
    const V pz = hn::Load(d, points.row(2) + i), nx = hn::Load(d, points.row(3) + i);
    const V ny = hn::Load(d, points.row(4) + i), nz = hn::Load(d, points.row(5) + i);
    // From the centre, which is R_0 below the seed.
    const V lx = Dot(d, frame.x, px, py, pz), ly = Dot(d, frame.y, px, py, pz);
    const V lz = hn::Add(Dot(d, frame.z, px, py, pz), hn::Set(d, frame.radius));
    const V rho = hn::Sqrt(hn::MulAdd(lx, lx, hn::MulAdd(ly, ly, hn::Mul(lz, lz))));
    const V inverse = hn::Div(one, rho);
    V ux = hn::Mul(lx, inverse), uy = hn::Mul(ly, inverse), uz = hn::Mul(lz, inverse);
    const V n1 = Dot(d, frame.x, nx, ny, nz), n2 = Dot(d, frame.y, nx, ny, nz);
    const V n3 = Dot(d, frame.z, nx, ny, nz);
    V facing = hn::MulAdd(n1, ux, hn::MulAdd(n2, uy, hn::Mul(n3, uz)));
    auto good = hn::And(hn::Gt(facing, hn::Set(d, kLeastFacing)), hn::Gt(uz, hn::Set(d, -0.9)));
    good = hn::And(good, hn::FirstN(d, left));
    const V weight = hn::IfThenElseZero(good, hn::Sqrt(hn::Load(d, points.row(6) + i)));
    usable = hn::Add(usable, hn::IfThenElseZero(good, one));
    // What is left out counts as on the axis: a weight of zero does not undo a division by it.
    ux = hn::IfThenElseZero(good, ux), uy = hn::IfThenElseZero(good, uy);
    uz = hn::IfThenElse(good, uz, one), facing = hn::IfThenElseZero(good, facing);
    // Stereographic plane, opened, and the conformal factor.
    const V below = hn::Div(one, hn::Add(one, uz));
    const V s1 = hn::Mul(ux, below), s2 = hn::Mul(uy, below);
    const V q = hn::MulAdd(s1, s1, hn::MulAdd(s2, s2, one));
    const V a = hn::Set(d, frame.dilation);
    LowDirection<V> at;
    at.s1 = hn::Mul(a, s1), at.s2 = hn::Mul(a, s2);
    const V opened = hn::MulAdd(at.s1, at.s1, hn::MulAdd(at.s2, at.s2, one));
    const V over = hn::Div(two, opened);
    at.x = hn::Mul(at.s1, over), at.y = hn::Mul(at.s2, over), at.z = hn::Sub(over, one);
    const V factor = hn::Div(hn::Mul(a, q), opened);
    // grad phi = (r / R_0) (u - n / (n . u)), method 7.4, along the tangents of the plane's axes.
    const V level = hn::Mul(rho, hn::Set(d, 1 / frame.radius));
    const V n_below = hn::Add(facing, n3);
    const V steep = hn::IfThenElseZero(
        good, hn::Div(level, hn::Mul(hn::Mul(facing, factor), hn::Set(d, -1.0))));
    const V slope_weight = hn::Mul(weight, hn::Set(d, options.gradient_weight));
    double* const right = rows + n_basis * stride + i;
    hn::Store(hn::IfThenElseZero(good, hn::Mul(weight, hn::Sub(level, one))), d, right);
    hn::Store(hn::Mul(hn::Mul(slope_weight, steep), hn::NegMulAdd(s1, n_below, n1)), d,
              right + third);
    hn::Store(hn::Mul(hn::Mul(slope_weight, steep), hn::NegMulAdd(s2, n_below, n2)), d,
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
          double* row = rows + index * stride + i;
          const V order = hn::Set(d, static_cast<double>(m));
          const V turn = hn::MulAdd(order, p, hn::Mul(up, dp)), pm = hn::Mul(order, p);
          hn::Store(hn::Mul(weight, hn::Mul(p, re)), d, row);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s1, hn::Mul(turn, re), hn::Mul(pm, re_below))),
              d, row + third);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulSub(at.s2, hn::Mul(turn, re), hn::Mul(pm, im_below))),
              d, row + 2 * third);
          if (m == 0) return;
          row += stride;
          hn::Store(hn::Mul(weight, hn::Mul(p, im)), d, row);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s1, hn::Mul(turn, im), hn::Mul(pm, im_below))),
              d, row + third);
          hn::Store(
              hn::Mul(slope_weight, hn::NegMulAdd(at.s2, hn::Mul(turn, im), hn::Mul(pm, re_below))),
              d, row + 2 * third);
        });
  }
  return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, usable)) + 0.5);
}

// The lower triangle of rows rows^T, n rows of `length`; matrix [n][n].
void NormalMatrix(const double* rows, std::size_t n, std::size_t length, std::size_t stride,
                  double* matrix) {
  const D d;
  for (std::size_t i = 0; i < n; i += 4) {
    for (std::size_t j = 0; j <= i; j += 4) {
      V sum[4][4];
      for (auto& row : sum) {
        for (V& v : row) v = hn::Zero(d);
      }
      // Rows beyond the last may hold anything: their sums are not taken.
      for (std::size_t k = 0; k < length; k += hn::Lanes(d)) {
        V left[4], right[4];
        for (std::size_t r = 0; r < 4; ++r) left[r] = hn::Load(d, rows + (i + r) * stride + k);
        for (std::size_t r = 0; r < 4; ++r) right[r] = hn::Load(d, rows + (j + r) * stride + k);
        for (std::size_t r = 0; r < 4; ++r) {
          for (std::size_t c = 0; c < 4; ++c) sum[r][c] = hn::MulAdd(left[r], right[c], sum[r][c]);
        }
      }
      for (std::size_t r = 0; r < 4 && i + r < n; ++r) {
        for (std::size_t c = 0; c < 4 && j + c < n; ++c) {
          matrix[(i + r) * n + j + c] = hn::GetLane(hn::SumOfLanes(d, sum[r][c]));
        }
      }
    }
  }
}

// target = rows' sum with the coefficients, minus the right-hand side.
void Residuals(const double* rows, const double* coefficients, std::size_t n, const double* right,
               std::size_t length, std::size_t stride, double* target) {
  const D d;
  for (std::size_t k = 0; k < length; k += hn::Lanes(d)) {
    V sum = hn::Neg(hn::Load(d, right + k));
    for (std::size_t i = 0; i < n; ++i) {
      sum = hn::MulAdd(hn::Set(d, coefficients[i]), hn::Load(d, rows + i * stride + k), sum);
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
HWY_EXPORT(NormalMatrix);
HWY_EXPORT(Residuals);

// matrix = L L^T in place, lower triangle; false if a pivot has lost all digits.
bool factor(std::vector<double>& matrix, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    double* const row_j = &matrix[j * n];
    double pivot = row_j[j];
    for (std::size_t k = 0; k < j; ++k) pivot -= row_j[k] * row_j[k];
    if (!(pivot > 1e-14 * row_j[j])) return false;
    const double root = std::sqrt(pivot), inverse = 1 / root;
    row_j[j] = root;
    for (std::size_t i = j + 1; i < n; ++i) {
      double* const row_i = &matrix[i * n];
      double sum = row_i[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      row_i[j] = sum * inverse;
    }
  }
  return true;
}

void solve(const std::vector<double>& lower, std::size_t n, std::vector<double>& x) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= lower[i * n + k] * x[k];
    x[i] /= lower[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    x[i] /= lower[i * n + i];
    for (std::size_t k = 0; k < i; ++k) x[k] -= lower[i * n + k] * x[i];
  }
}

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
  system.third = (points.size() + kCapLanes - 1) / kCapLanes * kCapLanes;
  system.stride = 3 * system.third;
  const std::size_t wanted = (n + 6) * system.stride;
  if (scratch.rows.size() < wanted) scratch.rows = AlignedArray<double>(2 * wanted);
  double* const rows = scratch.rows.data();
  poison_scratch(rows, wanted * sizeof(double));
  system.usable = HWY_DYNAMIC_DISPATCH(FillRows)(frame, points, options, rows, system.stride);
  for (std::size_t i = 0; i < points.size(); ++i) system.weights += points.weight(i);
  if (3 * system.usable < n) return system;
  // The right-hand side is one more row of the matrix.
  scratch.matrix.resize((n + 1) * (n + 1));
  HWY_DYNAMIC_DISPATCH(NormalMatrix)
  (rows, n + 1, system.stride, system.stride, scratch.matrix.data());
  for (int l = 0; l <= options.degree; ++l) {
    const double square = static_cast<double>(l) * (l + 1) * l * (l + 1);
    const std::size_t end = n_coefficients(options.basis, l);
    for (std::size_t i = l == 0 ? 0 : n_coefficients(options.basis, l - 1); i < end; ++i) {
      scratch.matrix[i * (n + 2)] += options.penalty * system.weights * square;
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
  (rows, coefficients.data(), coefficients.size(), rows + system.n * system.stride, length,
   system.stride, target);
  return target;
}

bool fit_cap(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
             CapFitScratch& scratch, CapFit& fit) {
  const CapSystem system = make_system(frame, points, options, scratch);
  const std::size_t n = system.n, third = system.third;
  fit.usable = static_cast<double>(system.usable) /
               static_cast<double>(std::max<std::size_t>(1, points.size()));
  if (!system.solvable) return false;
  scratch.factor.resize(n * n);
  fit.coefficients.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    std::copy_n(&scratch.matrix[i * (n + 1)], i + 1, &scratch.factor[i * n]);
    fit.coefficients[i] = scratch.matrix[n * (n + 1) + i];
  }
  if (!factor(scratch.factor, n)) return false;
  solve(scratch.factor, n, fit.coefficients);
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
