#include "harmonic/legendre/legendre_pairs.h"

#include <hwy/aligned_allocator.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/legendre/legendre_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "harmonic/legendre/legendre_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kMoments = 6;  // sum, square and fourth power, first for cosine coefficients

// Adds the moments of a block of pairs to three vectors of sums.
HWY_INLINE void add_moments(D d, const V* va, const V* vb, const double* wa, const double* wb,
                            double* sums) {
  V sum = hn::Load(d, sums);
  V square = hn::Load(d, sums + hn::Lanes(d));
  V fourth = hn::Load(d, sums + 2 * hn::Lanes(d));
  for (int v = 0; v < kVectors; ++v) {
    const size_t at = static_cast<size_t>(v) * hn::Lanes(d);
    const V a = hn::Mul(va[v], hn::LoadU(d, wa + at)), b = hn::Mul(vb[v], hn::LoadU(d, wb + at));
    const V difference = hn::Sub(a, b);
    const V q = hn::Mul(difference, difference);
    sum = hn::Add(sum, hn::Add(a, b));
    square = hn::Add(square, q);
    fourth = hn::MulAdd(q, q, fourth);
  }
  hn::Store(sum, d, sums);
  hn::Store(square, d, sums + hn::Lanes(d));
  hn::Store(fourth, d, sums + 2 * hn::Lanes(d));
}

// Returns Pt_lm with its sign in `values`, and 0 in lanes that are still below 2^-480.
HWY_INLINE void signed_values(D d, const Block& b, bool odd, V* values) {
  if (b.scaled) {
    visible(d, b, values);
  } else {
    for (int v = 0; v < kVectors; ++v) values[v] = b.p[v];
  }
  if (!odd) return;
  for (int v = 0; v < kVectors; ++v) values[v] = hn::Xor(values[v], b.sign[v]);
}

void PairMomentsOf(const LegendreOrder& order, const PairSide& a, const PairSide& b, size_t n,
                   const PairMoments& c, const PairMoments& s) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const int last = order.degree - order.m;
  const size_t size = (static_cast<size_t>(last) + 1) * kMoments * lanes;
  // Sums stay apart by lane until the end, in the layout [row][moment][lane].
  auto sums = hwy::AllocateAligned<double>(size);
  for (size_t i = 0; i < size; i += lanes) hn::Store(hn::Zero(d), d, sums.get() + i);
  for (size_t j = 0; j < n; j += kVectors * lanes) {
    Block block_a, block_b;
    start(d, order, a.x + j, a.s + j, block_a);
    start(d, order, b.x + j, b.s + j, block_b);
    double* at = sums.get();
    for (int row = 0; row <= last; ++row, at += kMoments * lanes) {
      if (!block_a.scaled || !block_b.scaled || any_visible(d, block_a) ||
          any_visible(d, block_b)) {
        V va[kVectors], vb[kVectors];
        signed_values(d, block_a, row & 1, va);
        signed_values(d, block_b, row & 1, vb);
        add_moments(d, va, vb, a.re + j, b.re + j, at);
        add_moments(d, va, vb, a.im + j, b.im + j, at + 3 * lanes);
      }
      if (row == last) break;
      advance(d, order, row, block_a);
      advance(d, order, row, block_b);
      if (block_a.scaled) rescale(d, block_a);
      if (block_b.scaled) rescale(d, block_b);
    }
  }
  double* const out[kMoments] = {c.sum, c.square, c.fourth, s.sum, s.square, s.fourth};
  const double* at = sums.get();
  for (int row = 0; row <= last; ++row) {
    for (size_t i = 0; i < kMoments; ++i, at += lanes) {
      out[i][row] += hn::GetLane(hn::SumOfLanes(d, hn::Load(d, at)));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(PairMomentsOf);

void legendre_pair_moments(const LegendreOrder& order, const PairSide& a, const PairSide& b,
                           std::size_t n, const PairMoments& c, const PairMoments& s) {
  HWY_DYNAMIC_DISPATCH(PairMomentsOf)(order, a, b, n, c, s);
}

}  // namespace rholm
#endif  // HWY_ONCE
