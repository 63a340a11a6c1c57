#include "atlas/cap/normal_equations.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/normal_equations.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/poison.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

// Pivots below this bound have no inverse.
constexpr double kSmallest = std::numeric_limits<double>::min();

// Returns the first column of the vector that holds column k.
HWY_INLINE std::size_t VectorOf(std::size_t k) { return k / hn::Lanes(D()) * hn::Lanes(D()); }

// Multiplies kRows rows from index i on by the four rows from index j on.
template <bool kWeighted, bool kAdd, std::size_t kRows>
HWY_INLINE void ProductsOf(const NormalRows& given, std::size_t i, std::size_t j, double* matrix) {
  const D d;
  const std::size_t count = given.count, stride = given.stride;
  V sum[kRows][4];
  for (auto& row : sum) {
    for (V& v : row) v = hn::Zero(d);
  }
  const double* const left_rows = given.rows + i * stride;
  const double* const right_rows = given.rows + j * stride;
  for (std::size_t k = 0; k < given.length; k += hn::Lanes(d)) {
    V left[kRows], right[4];
    for (std::size_t r = 0; r < kRows; ++r) left[r] = hn::LoadU(d, left_rows + r * stride + k);
    for (std::size_t r = 0; r < 4; ++r) right[r] = hn::LoadU(d, right_rows + r * stride + k);
    if (kWeighted) {
      const V weight = hn::LoadU(d, given.weights + k);
      for (V& v : left) v = hn::Mul(weight, v);
    }
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < 4; ++c) sum[r][c] = hn::MulAdd(left[r], right[c], sum[r][c]);
    }
  }
  // Rows beyond the last have arbitrary content; their sums are not used.
  for (std::size_t c = 0; c < 4 && j + c < count; ++c) {
    double* const to = matrix + (j + c) * count + i;
    for (std::size_t r = 0; r < kRows && i + r < count; ++r) {
      const double product = hn::GetLane(hn::SumOfLanes(d, sum[r][c]));
      to[r] = kAdd ? to[r] + product : product;
    }
  }
}

// Multiplies blocks of four rows. The number of harmonics is often a square, plus one row.
template <bool kWeighted, bool kAdd>
HWY_INLINE void Products(const NormalRows& given, double* matrix) {
  for (std::size_t i = 0; i < given.count; i += 4) {
    for (std::size_t j = 0; j <= i; j += 4) {
      if (i + 1 == given.count) {
        ProductsOf<kWeighted, kAdd, 1>(given, i, j, matrix);
      } else {
        ProductsOf<kWeighted, kAdd, 4>(given, i, j, matrix);
      }
    }
  }
}

void Make(const NormalRows& rows, double* matrix) {
  rows.weights != nullptr ? Products<true, false>(rows, matrix)
                          : Products<false, false>(rows, matrix);
}
void Add(const NormalRows& rows, double* matrix) {
  rows.weights != nullptr ? Products<true, true>(rows, matrix)
                          : Products<false, true>(rows, matrix);
}

// Computes row -= times other, in whole vectors of columns.
HWY_INLINE void Subtract(double times, const double* other, double* row, std::size_t begin,
                         std::size_t end) {
  const D d;
  const V factor = hn::Set(d, times);
  for (std::size_t j = begin; j < end; j += hn::Lanes(d)) {
    hn::Store(hn::NegMulAdd(factor, hn::Load(d, other + j), hn::Load(d, row + j)), d, row + j);
  }
}

// Subtracts the four rows before `end` from all later rows; each is loaded and stored once.
HWY_INLINE void SubtractFour(const double* inverses, std::size_t end, std::size_t n,
                             std::size_t stride, double* upper) {
  const D d;
  const double* const row0 = upper + (end - 4) * stride;
  const double *const row1 = row0 + stride, *const row2 = row1 + stride;
  const double* const row3 = row2 + stride;
  for (std::size_t i = end; i < n; ++i) {
    double* const below = upper + i * stride;
    const V times0 = hn::Set(d, inverses[0] * row0[i]), times1 = hn::Set(d, inverses[1] * row1[i]);
    const V times2 = hn::Set(d, inverses[2] * row2[i]), times3 = hn::Set(d, inverses[3] * row3[i]);
    for (std::size_t j = VectorOf(i); j < stride; j += hn::Lanes(d)) {
      V v = hn::NegMulAdd(times0, hn::Load(d, row0 + j), hn::Load(d, below + j));
      v = hn::NegMulAdd(times1, hn::Load(d, row1 + j), v);
      v = hn::NegMulAdd(times2, hn::Load(d, row2 + j), v);
      hn::Store(hn::NegMulAdd(times3, hn::Load(d, row3 + j), v), d, below + j);
    }
  }
}

// Copies rows from the diagonal's vector on, with the right-hand side
// behind and zeros up to the end. The entries left of the diagonal in this
// vector have no meaning, here and later; they never affect other columns.
HWY_INLINE void CopyRows(const double* matrix, std::size_t n, std::size_t stride, double* upper) {
  const D d;
  const std::size_t whole = VectorOf(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* const from = matrix + (1 + i) * (n + 1) + 1;
    double* const row = upper + i * stride;
    for (std::size_t j = VectorOf(i); j < stride; j += hn::Lanes(d)) {
      hn::Store(j < whole ? hn::LoadU(d, from + j) : hn::Zero(d), d, row + j);
    }
    for (std::size_t j = HWY_MAX(i, whole); j < n; ++j) row[j] = from[j];
    row[n] = matrix[1 + i];
  }
}

// The right-hand side is one more column, treated like the others.
std::size_t Factor(const double* matrix, std::size_t n, double least, double* upper) {
  const std::size_t stride = padded(n + 1);
  CopyRows(matrix, n, stride, upper);
  for (std::size_t first = 0; first < n; first += 4) {
    const std::size_t end = HWY_MIN(first + 4, n);
    double inverses[4];
    for (std::size_t k = first; k < end; ++k) {
      double* const row = upper + k * stride;
      if (!(row[k] > HWY_MAX(least * matrix[normal_diagonal(k, n)], kSmallest))) return k;
      const double inverse = inverses[k - first] = 1 / row[k];
      for (std::size_t i = k + 1; i < end; ++i) {
        Subtract(inverse * row[i], row, upper + i * stride, VectorOf(i), stride);
      }
    }
    if (end < n) SubtractFour(inverses, end, n, stride, upper);
  }
  return n;
}

// Solves R x = D R^-T A^T b for the first n unknowns of `all`; x is 0 up to the end of its last
// vector. The unknown found last is subtracted last and alone, because the next step waits for it.
void Solve(const double* upper, std::size_t all, std::size_t n, double* x) {
  const D d;
  const std::size_t stride = padded(all + 1);
  for (std::size_t j = n; j-- > 0;) {
    const double* const row = upper + j * stride;
    const std::size_t next = VectorOf(j) + hn::Lanes(d);
    V sum = hn::Zero(d);
    for (std::size_t k = next; k < n; k += hn::Lanes(d)) {
      sum = hn::MulAdd(hn::Load(d, row + k), hn::LoadU(d, x + k), sum);
    }
    double rest = row[all] - hn::GetLane(hn::SumOfLanes(d, sum));
    for (std::size_t k = HWY_MIN(next, n); k-- > j + 1;) rest -= row[k] * x[k];
    x[j] = rest * (1 / row[j]);
  }
}

// Solves several sizes side by side, because one solution is a chain of
// dependent operations. The result is x [the last size][padded(n_sizes)].
void SolveNested(const double* upper, std::size_t all, const std::size_t* sizes,
                 std::size_t n_sizes, double* x) {
  const D d;
  const std::size_t stride = padded(all + 1), sets = padded(n_sizes), n = sizes[n_sizes - 1];
  std::size_t lowest = n_sizes - 1;  // smallest set with unknown i
  for (std::size_t i = n; i-- > 0;) {
    while (lowest > 0 && i < sizes[lowest - 1]) --lowest;
    const double* const row = upper + i * stride;
    for (std::size_t s = 0; s < sets; s += hn::Lanes(d)) {
      V sum = hn::Set(d, row[all]);
      for (std::size_t j = i + 1; j < n; ++j) {
        sum = hn::NegMulAdd(hn::Set(d, row[j]), hn::Load(d, x + j * sets + s), sum);
      }
      const V here = hn::Iota(d, static_cast<double>(s));
      const auto has = hn::Ge(here, hn::Set(d, static_cast<double>(lowest)));
      sum = hn::IfThenElseZero(has, hn::Div(sum, hn::Set(d, row[i])));
      hn::Store(sum, d, x + i * sets + s);
    }
  }
}

// Solves R^T D^-1 Y = 1, then R X = Y. Only the lower triangle of X
// [n][padded(n)] counts: Y has no other part, and X needs no other part.
void Invert(const double* upper, std::size_t all, std::size_t n, double* x) {
  const D d;
  const std::size_t stride = padded(all + 1), width = padded(n), lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = x + i * width;
    for (std::size_t j = 0; j <= i; j += lanes) hn::Store(hn::Zero(d), d, row + j);
    row[i] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double* const factors = upper + k * stride;
    const double inverse = 1 / factors[k];
    for (std::size_t i = k + 1; i < n; ++i) {
      Subtract(inverse * factors[i], x + k * width, x + i * width, 0, VectorOf(k) + lanes);
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    double* const row = x + k * width;
    const V inverse = hn::Set(d, 1 / upper[k * stride + k]);
    for (std::size_t j = 0; j <= k; j += lanes) {
      hn::Store(hn::Mul(inverse, hn::Load(d, row + j)), d, row + j);
    }
    for (std::size_t i = 0; i < k; ++i) {
      Subtract(upper[i * stride + k], row, x + i * width, 0, VectorOf(i) + lanes);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Make);
HWY_EXPORT(Add);
HWY_EXPORT(Factor);
HWY_EXPORT(Solve);
HWY_EXPORT(SolveNested);
HWY_EXPORT(Invert);
}  // namespace

void clear_beyond(double* rows, std::size_t count, std::size_t stride) {
  std::fill(rows + count * stride, rows + (count + 3) / 4 * 4 * stride, 0.0);
}

void make_normal_matrix(const NormalRows& rows, double* matrix) {
  HWY_DYNAMIC_DISPATCH(Make)(rows, matrix);
}

void add_normal_matrix(const NormalRows& rows, double* matrix) {
  HWY_DYNAMIC_DISPATCH(Add)(rows, matrix);
}

std::size_t NormalFactor::factor(const double* matrix, std::size_t n, double least) {
  const std::size_t wanted = n * padded(n + 1);
  if (upper_.size() < wanted) upper_ = AlignedArray<double>(wanted);
  poison_scratch(upper_.data(), wanted * sizeof(double));
  n_ = n;
  regular_ = HWY_DYNAMIC_DISPATCH(Factor)(matrix, n, least, upper_.data());
  return regular_;
}

double* NormalFactor::work(std::size_t size) {
  if (work_.size() < size) work_ = AlignedArray<double>(size);
  poison_scratch(work_.data(), size * sizeof(double));
  return work_.data();
}

void NormalFactor::solve(std::size_t n, std::vector<double>& x) const {
  x.assign(padded(n), 0);
  HWY_DYNAMIC_DISPATCH(Solve)(upper_.data(), n_, n, x.data());
  x.resize(n);
}

void NormalFactor::solve_nested(std::span<const std::size_t> sizes, std::vector<double>& x) {
  const std::size_t n = sizes.back(), sets = padded(sizes.size());
  double* const beside = work(n * sets);
  HWY_DYNAMIC_DISPATCH(SolveNested)(upper_.data(), n_, sizes.data(), sizes.size(), beside);
  x.resize(n * sizes.size());
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    for (std::size_t i = 0; i < n; ++i) x[s * n + i] = beside[i * sets + s];
  }
}

void NormalFactor::invert(std::size_t n, std::vector<double>& inverse) {
  const std::size_t width = padded(n);
  double* const lower = work(n * width);
  HWY_DYNAMIC_DISPATCH(Invert)(upper_.data(), n_, n, lower);
  inverse.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      inverse[i * n + j] = inverse[j * n + i] = lower[i * width + j];
    }
  }
}

}  // namespace rholm
#endif
