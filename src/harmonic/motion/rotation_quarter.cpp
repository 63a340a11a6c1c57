#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "harmonic/motion/rotation_quarter.h"

namespace rholm {
namespace {

// Columns are scaled by powers of this number, 2^-600, until their values have grown to normal
// size. From degree 1000 on, the first values would underflow.
constexpr double kTiny = 0x1p-600;

constexpr int kLanes = 8;  // number of partial sums, fixed so that results do not depend on vectors

// Returns the sums of d[k] z[k] over even k and over odd k < n.
std::pair<double, double> alternating_dots(const double* d, const double* z, int n) {
  double part[kLanes] = {};
  int k = 0;
  for (; k + kLanes <= n; k += kLanes) {
    for (int i = 0; i < kLanes; ++i) part[i] += d[k + i] * z[k + i];
  }
  for (int i = 0; k + i < n; ++i) part[i] += d[k + i] * z[k + i];
  return {(part[0] + part[2]) + (part[4] + part[6]), (part[1] + part[3]) + (part[5] + part[7])};
}

// Adds d[k] even to y[k] for even k < n, and d[k] odd for odd k < n.
void add_alternating(const double* d, double even, double odd, int n, double* y) {
  int k = 0;
  for (; k + 2 <= n; k += 2) {
    y[k] += d[k] * even;
    y[k + 1] += d[k + 1] * odd;
  }
  if (k < n) y[k] += d[k] * even;
}

}  // namespace

void QuarterTurn::set_degree(int l) {
  degree_ = l;
  const std::size_t n = static_cast<std::size_t>(l) + 1;
  if (triangle_.size() < n * (n + 1) / 2) triangle_.resize(n * (n + 1) / 2);
  for (auto* column : {&current_, &next_, &after_}) column->assign(n, 0.0);
  pending_.assign(n, 0);
  start_values();
  descend();
}

// Computes row m1 = l into next_, upwards from m2 = 0: C(2l, l) 4^-l = prod (1 - 1/2k), and the
// ratio C(2l, l+m+1) / C(2l, l+m) = (l-m)/(l+m+1).
void QuarterTurn::start_values() {
  const int l = degree_;
  double square = 1;
  for (int k = 1; k <= l; ++k) square *= 1 - 0.5 / k;
  double value = std::sqrt(square);
  int pending = 0;
  double* last = row(l);
  for (int m = 0; m <= l; ++m) {
    next_[m] = (l - m) % 2 == 0 ? value : -value;
    pending_[m] = pending;
    last[m] = pending > 0 ? 0 : next_[m];
    value *= std::sqrt((l - m) / (l + m + 1.0));
    if (value < kTiny) {
      value /= kTiny;
      ++pending;
    }
  }
}

void QuarterTurn::descend() {
  const int l = degree_;
  // In every row, the columns with pending factors are the last ones.
  int first_pending =
      static_cast<int>(std::find_if(pending_.begin(), pending_.end(), [](int p) { return p > 0; }) -
                       pending_.begin());
  for (int m1 = l - 1; m1 >= 0; --m1) {
    const double scale = 1 / std::sqrt((l - m1) * (l + m1 + 1.0));
    const double two = 2 * scale;
    const double back = std::sqrt((l - m1 - 1) * (l + m1 + 2.0)) * scale;
    const double *b = next_.data(), *c = after_.data();
    double *a = current_.data(), *out = row(m1);
    for (int m2 = 0; m2 <= m1; ++m2) a[m2] = two * m2 * b[m2] - back * c[m2];
    std::copy(a, a + m1 + 1, out);
    for (int m2 = first_pending; m2 <= m1; ++m2) {
      if (pending_[m2] > 0 && std::abs(a[m2]) > 1) {
        current_[m2] *= kTiny;
        next_[m2] *= kTiny;
        --pending_[m2];
      }
      out[m2] = pending_[m2] > 0 ? 0 : a[m2];
    }
    std::swap(after_, next_);
    std::swap(next_, current_);
  }
}

double QuarterTurn::delta(int m1, int m2) const {
  const auto sign = [](int exponent) { return exponent % 2 == 0 ? 1 : -1; };
  int signs = 1;
  if (m1 < 0) signs *= sign(degree_ + std::abs(m2)), m1 = -m1;
  if (m2 < 0) signs *= sign(degree_ + m1), m2 = -m2;
  return m1 >= m2 ? signs * row(m1)[m2] : signs * sign(m2 - m1) * row(m2)[m1];
}

// In the real basis, only cosines with even l + m1 + m2 and sines with odd l + m1 + m2 contribute:
//   C'_m1 = (-1)^l w_m1 sum w_m2 Delta_{m1 m2} C_m2,   S'_m1 = -(-1)^l (the same of S),
// w_0 = 1 and w_m = sqrt 2. The inverse is the transpose: the same without the sign in front. Each
// number of the triangle is read once. The array in_[q] has at m a cosine for even q + m and a sine
// for odd q + m. Row m1 with q = (l + m1) mod 2 thus takes one pass.
void QuarterTurn::apply(Way way, double* c, double* s) {
  const int l = degree_;
  const double sigma = l % 2 == 0 ? 1 : -1;
  for (int q = 0; q < 2; ++q) {
    in_[q].resize(static_cast<std::size_t>(l) + 1);
    out_[q].assign(static_cast<std::size_t>(l) + 1, 0.0);
  }
  for (int m = 0; m <= l; ++m) {
    in_[m % 2][m] = m == 0 ? c[0] : std::numbers::sqrt2 * c[m];
    in_[1 - m % 2][m] = m == 0 ? 0 : std::numbers::sqrt2 * s[m];
  }
  for (int m1 = 0; m1 <= l; ++m1) {
    const int q = (l + m1) % 2;
    const auto [even, odd] = alternating_dots(row(m1), in_[q].data(), m1 + 1);
    out_[m1 % 2][m1] += q == 0 ? even : odd;
    out_[1 - m1 % 2][m1] += q == 0 ? odd : even;
    const double of_c = sigma * in_[m1 % 2][m1], of_s = -sigma * in_[1 - m1 % 2][m1];
    add_alternating(row(m1), q == 0 ? of_c : of_s, q == 0 ? of_s : of_c, m1, out_[q].data());
  }
  const double sign = way == Way::kForward ? sigma : 1, sign_s = way == Way::kForward ? -sigma : 1;
  for (int m = 0; m <= l; ++m) {
    const double w = m == 0 ? 1 : std::numbers::sqrt2;
    c[m] = sign * w * out_[m % 2][m];
    s[m] = m == 0 ? 0 : sign_s * w * out_[1 - m % 2][m];
  }
}

}  // namespace rholm
