#include "harmonic/fft/radix_passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/poison.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/fft/radix_passes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Complex {
  V re, im;
};

template <class V>
HWY_INLINE Complex<V> Plus(const Complex<V>& a, const Complex<V>& b) {
  return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)};
}
template <class V>
HWY_INLINE Complex<V> Minus(const Complex<V>& a, const Complex<V>& b) {
  return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
// MinusTurned() returns a - i b; PlusTurned() returns a + i b.
template <class V>
HWY_INLINE Complex<V> MinusTurned(const Complex<V>& a, const Complex<V>& b) {
  return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)};
}
template <class V>
HWY_INLINE Complex<V> PlusTurned(const Complex<V>& a, const Complex<V>& b) {
  return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)};
}
template <class V>
HWY_INLINE Complex<V> Times(const Complex<V>& a, const Complex<V>& w) {
  return {hn::NegMulAdd(a.im, w.im, hn::Mul(a.re, w.re)),
          hn::MulAdd(a.re, w.im, hn::Mul(a.im, w.re))};
}
// Returns a + b t for a real t.
template <class V>
HWY_INLINE Complex<V> PlusPart(const Complex<V>& a, V t, const Complex<V>& b) {
  return {hn::MulAdd(t, b.re, a.re), hn::MulAdd(t, b.im, a.im)};
}
template <class V>
HWY_INLINE Complex<V> Part(V t, const Complex<V>& b) {
  return {hn::Mul(t, b.re), hn::Mul(t, b.im)};
}

// Computes a_k = sum_j a_j w_R^(j k) in place.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void Butterfly(D, Complex<V> (&a)[2]) {
  const Complex<V> b = a[1];
  a[1] = Minus(a[0], b);
  a[0] = Plus(a[0], b);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void Butterfly(D d, Complex<V> (&a)[3]) {
  using T = hn::TFromD<D>;
  const Complex<V> sum = Plus(a[1], a[2]);
  const Complex<V> across = Part(hn::Set(d, T(0.86602540378443864676)), Minus(a[1], a[2]));
  const Complex<V> along = PlusPart(a[0], hn::Set(d, T(-0.5)), sum);
  a[0] = Plus(a[0], sum);
  a[1] = MinusTurned(along, across);
  a[2] = PlusTurned(along, across);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void Butterfly(D, Complex<V> (&a)[4]) {
  const Complex<V> even = Plus(a[0], a[2]), even_off = Minus(a[0], a[2]);
  const Complex<V> odd = Plus(a[1], a[3]), odd_off = Minus(a[1], a[3]);
  a[0] = Plus(even, odd);
  a[1] = MinusTurned(even_off, odd_off);
  a[2] = Minus(even, odd);
  a[3] = PlusTurned(even_off, odd_off);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void Butterfly(D d, Complex<V> (&a)[5]) {
  using T = hn::TFromD<D>;
  const V c1 = hn::Set(d, T(0.30901699437494742410)), c2 = hn::Set(d, T(-0.80901699437494742410));
  const V s1 = hn::Set(d, T(0.95105651629515357212)), s2 = hn::Set(d, T(0.58778525229247312917));
  const Complex<V> outer = Plus(a[1], a[4]), outer_off = Minus(a[1], a[4]);
  const Complex<V> inner = Plus(a[2], a[3]), inner_off = Minus(a[2], a[3]);
  const Complex<V> along1 = PlusPart(PlusPart(a[0], c1, outer), c2, inner);
  const Complex<V> along2 = PlusPart(PlusPart(a[0], c2, outer), c1, inner);
  const Complex<V> across1 = PlusPart(Part(s1, outer_off), s2, inner_off);
  const Complex<V> across2 = PlusPart(Part(s2, outer_off), hn::Neg(s1), inner_off);
  a[0] = Plus(a[0], Plus(outer, inner));
  a[1] = MinusTurned(along1, across1);
  a[2] = MinusTurned(along2, across2);
  a[3] = PlusTurned(along2, across2);
  a[4] = PlusTurned(along1, across1);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void Butterfly(D d, Complex<V> (&a)[8]) {
  using T = hn::TFromD<D>;
  Complex<V> even[4] = {a[0], a[2], a[4], a[6]}, odd[4] = {a[1], a[3], a[5], a[7]};
  Butterfly(d, even);
  Butterfly(d, odd);
  // The factors of odd[1] and odd[3] are w_8 and w_8^3.
  const V half = hn::Set(d, T(0.70710678118654752440));
  const Complex<V> eighth = {hn::Mul(half, hn::Add(odd[1].re, odd[1].im)),
                             hn::Mul(half, hn::Sub(odd[1].im, odd[1].re))};
  const Complex<V> turned = {hn::Mul(half, hn::Sub(odd[3].im, odd[3].re)),
                             hn::Mul(half, hn::Neg(hn::Add(odd[3].re, odd[3].im)))};
  a[0] = Plus(even[0], odd[0]);
  a[1] = Plus(even[1], eighth);
  a[2] = MinusTurned(even[2], odd[2]);
  a[3] = Plus(even[3], turned);
  a[4] = Minus(even[0], odd[0]);
  a[5] = Minus(even[1], eighth);
  a[6] = PlusTurned(even[2], odd[2]);
  a[7] = Minus(even[3], turned);
}

// Layout in memory: real and imaginary parts interleaved (as the caller has them), or in two arrays
// which start n numbers apart.
enum class Lie { kInterleaved, kSplit };

template <Lie kLie, class D, typename T = hn::TFromD<D>>
HWY_INLINE Complex<hn::Vec<D>> LoadAt(D d, const T* x, std::size_t n, std::size_t at) {
  if constexpr (kLie == Lie::kSplit) return {hn::LoadU(d, x + at), hn::LoadU(d, x + n + at)};
  if constexpr (hn::MaxLanes(D()) == 1) {
    return {hn::LoadU(d, x + 2 * at), hn::LoadU(d, x + 2 * at + 1)};
  } else {
    Complex<hn::Vec<D>> a;
    hn::LoadInterleaved2(d, x + 2 * at, a.re, a.im);
    return a;
  }
}
template <Lie kLie, class D, typename T = hn::TFromD<D>>
HWY_INLINE void StoreAt(D d, const Complex<hn::Vec<D>>& a, T* y, std::size_t n, std::size_t at) {
  if constexpr (kLie == Lie::kSplit) {
    hn::StoreU(a.re, d, y + at);
    hn::StoreU(a.im, d, y + n + at);
  } else if constexpr (hn::MaxLanes(D()) == 1) {
    hn::StoreU(a.re, d, y + 2 * at);
    hn::StoreU(a.im, d, y + 2 * at + 1);
  } else {
    hn::StoreInterleaved2(a.re, a.im, d, y + 2 * at);
  }
}

// Calls visit(i) for runs of Lanes(d) numbers that begin at i and together cover 0 ... n - 1, where
// n >= Lanes(d). The last run may overlap the one before; it then writes the same values again. A
// single call of visit(), which captures by value, is inlined with its data in registers.
// Otherwise, passes take a third longer (bench/fft_bench).
template <class D, class Visit>
HWY_INLINE void VisitVectors(D d, std::size_t n, const Visit& visit) {
  const std::size_t last = n - hn::Lanes(d);
  for (std::size_t i = 0;; i = std::min(i + hn::Lanes(d), last)) {
    visit(i);
    if (i == last) break;
  }
}

// Does the part of a pass at p, with vectors along q. Skips the twiddle factors, 1, if !kTurned.
template <bool kTurned, int kRadix, Lie kFrom, Lie kTo, class D, typename T = hn::TFromD<D>>
HWY_INLINE void PassAt(D d, std::size_t p, const RadixPass& pass, const T* HWY_RESTRICT twiddles,
                       const T* HWY_RESTRICT x, T* HWY_RESTRICT y) {
  using C = Complex<hn::Vec<D>>;
  const std::size_t m = pass.m, s = pass.s, n = kRadix * m * s;
  const T* const first = twiddles + pass.twiddle(p, 1);
  const std::size_t next = pass.twiddle(0, 2), imaginary = pass.imaginary();
  const auto factor = [=](std::size_t k) HWY_ATTR {
    const T* const at = first + (k - 1) * next;
    return C{hn::Set(d, at[0]), hn::Set(d, at[imaginary])};
  };
  VisitVectors(d, s, [=](std::size_t q) HWY_ATTR {
    C a[kRadix];
    for (std::size_t j = 0; j < kRadix; ++j) a[j] = LoadAt<kFrom>(d, x, n, q + s * (p + m * j));
    Butterfly(d, a);
    StoreAt<kTo>(d, a[0], y, n, q + s * kRadix * p);
    for (std::size_t k = 1; k < kRadix; ++k) {
      if constexpr (kTurned) a[k] = Times(a[k], factor(k));
      StoreAt<kTo>(d, a[k], y, n, q + s * (kRadix * p + k));
    }
  });
}

// Does any pass with vectors along q.
template <int kRadix, Lie kFrom, Lie kTo, class D, typename T = hn::TFromD<D>>
HWY_INLINE void PassAlongQ(D d, const RadixPass& pass, const T* HWY_RESTRICT twiddles,
                           const T* HWY_RESTRICT x, T* HWY_RESTRICT y) {
  PassAt<false, kRadix, kFrom, kTo>(d, 0, pass, twiddles, x, y);
  for (std::size_t p = 1; p < pass.m; ++p) {
    PassAt<true, kRadix, kFrom, kTo>(d, p, pass, twiddles, x, y);
  }
}

// Does the first pass, of radix 4, with vectors along p.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void FirstPassAlongP(D d, const RadixPass& pass, const T* HWY_RESTRICT twiddles,
                                const T* HWY_RESTRICT x, T* HWY_RESTRICT y) {
  using C = Complex<hn::Vec<D>>;
  const std::size_t m = pass.m, n = 4 * m;
  VisitVectors(d, m, [=](std::size_t p) HWY_ATTR {
    C a[4];
    for (std::size_t j = 0; j < 4; ++j) a[j] = LoadAt<Lie::kInterleaved>(d, x, n, p + m * j);
    Butterfly(d, a);
    for (std::size_t k = 1; k < 4; ++k) {
      const T* const w = twiddles + 2 * m * (k - 1) + p;
      a[k] = Times(a[k], C{hn::LoadU(d, w), hn::LoadU(d, w + m)});
    }
    hn::StoreInterleaved4(a[0].re, a[1].re, a[2].re, a[3].re, d, y + 4 * p);
    hn::StoreInterleaved4(a[0].im, a[1].im, a[2].im, a[3].im, d, y + n + 4 * p);
  });
}

#if HWY_TARGET != HWY_SCALAR

// Each vector a_k holds blocks of 4 numbers, one block for each p = 0, 1, ... . Writes for each p
// in turn its blocks from a_0, a_1, a_2 and a_3.
template <class D, typename T = hn::TFromD<D>, class V = hn::Vec<D>>
HWY_INLINE void StoreBlocksOf4(D d, const V& a0, const V& a1, const V& a2, const V& a3, T* y) {
  const hn::Half<D> half;
  if constexpr (hn::MaxLanes(D()) == 8) {
    hn::StoreU(hn::ConcatLowerLower(d, a1, a0), d, y);
    hn::StoreU(hn::ConcatLowerLower(d, a3, a2), d, y + 8);
    hn::StoreU(hn::ConcatUpperUpper(d, a1, a0), d, y + 16);
    hn::StoreU(hn::ConcatUpperUpper(d, a3, a2), d, y + 24);
  } else {
    StoreBlocksOf4(half, hn::LowerHalf(half, a0), hn::LowerHalf(half, a1), hn::LowerHalf(half, a2),
                   hn::LowerHalf(half, a3), y);
    StoreBlocksOf4(half, hn::UpperHalf(half, a0), hn::UpperHalf(half, a1), hn::UpperHalf(half, a2),
                   hn::UpperHalf(half, a3), y + 2 * hn::MaxLanes(D()));
  }
}

// Does the second pass, of radix 4 with s = 4, with vectors along p of at least 8 numbers. The
// table of twiddle factors holds each factor 4 times.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void SecondPassAlongP(D d, const RadixPass& pass, const T* HWY_RESTRICT twiddles,
                                 const T* HWY_RESTRICT x, T* HWY_RESTRICT y) {
  using C = Complex<hn::Vec<D>>;
  const std::size_t length = 4 * pass.m, n = 4 * length;
  VisitVectors(d, length, [=](std::size_t at) HWY_ATTR {
    C a[4];
    for (std::size_t j = 0; j < 4; ++j) a[j] = LoadAt<Lie::kSplit>(d, x, n, at + length * j);
    Butterfly(d, a);
    for (std::size_t k = 1; k < 4; ++k) {
      const T* const w = twiddles + 2 * length * (k - 1) + at;
      a[k] = Times(a[k], C{hn::LoadU(d, w), hn::LoadU(d, w + length)});
    }
    StoreBlocksOf4(d, a[0].re, a[1].re, a[2].re, a[3].re, y + 4 * at);
    StoreBlocksOf4(d, a[0].im, a[1].im, a[2].im, a[3].im, y + n + 4 * at);
  });
}

#endif

template <Lie kFrom, Lie kTo, class D, typename T = hn::TFromD<D>>
HWY_INLINE void PassOfRadix(D d, const RadixPass& pass, const T* twiddles, const T* x, T* y) {
  switch (pass.radix) {
    case 2:
      return PassAlongQ<2, kFrom, kTo>(d, pass, twiddles, x, y);
    case 3:
      return PassAlongQ<3, kFrom, kTo>(d, pass, twiddles, x, y);
    case 4:
      return PassAlongQ<4, kFrom, kTo>(d, pass, twiddles, x, y);
    case 5:
      return PassAlongQ<5, kFrom, kTo>(d, pass, twiddles, x, y);
    default:
      return PassAlongQ<8, kFrom, kTo>(d, pass, twiddles, x, y);
  }
}

// Calls pass(d) with the widest vectors of kLeast to kLanes numbers that n numbers fill. Returns
// false if there are none.
template <std::size_t kLanes, std::size_t kLeast, typename T, class Pass>
HWY_INLINE bool WithWidest(std::size_t n, const Pass& pass) {
  const hn::CappedTag<T, kLanes> d;
  if (hn::Lanes(d) <= n) {
    pass(d);
    return true;
  }
  if constexpr (kLanes / 2 >= kLeast) return WithWidest<kLanes / 2, kLeast, T>(n, pass);
  return false;
}

template <Lie kTo, typename T>
HWY_INLINE void LaterPass(const RadixPass& pass, const T* twiddles, const T* x, T* y) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kTo == Lie::kSplit && hn::MaxLanes(hn::CappedTag<T, 16>()) >= 8) {
    if (pass.s == 4 && pass.radix == 4 && WithWidest<16, 8, T>(4 * pass.m, [&](auto d) HWY_ATTR {
          SecondPassAlongP(d, pass, twiddles, x, y);
        })) {
      return;
    }
  }
#endif
  WithWidest<16, 1, T>(
      pass.s, [&](auto d) HWY_ATTR { PassOfRadix<Lie::kSplit, kTo>(d, pass, twiddles, x, y); });
}

template <Lie kTo, typename T>
HWY_INLINE void FirstPass(const RadixPass& pass, const T* twiddles, const T* x, T* y) {
  if constexpr (kTo == Lie::kSplit && hn::MaxLanes(hn::CappedTag<T, 16>()) > 1) {
    if (pass.radix == 4 && WithWidest<16, 2, T>(pass.m, [&](auto d) HWY_ATTR {
          FirstPassAlongP(d, pass, twiddles, x, y);
        })) {
      return;
    }
  }
  PassOfRadix<Lie::kInterleaved, kTo>(hn::CappedTag<T, 1>(), pass, twiddles, x, y);
}

template <typename T>
HWY_INLINE void PassAny(const RadixPass& pass, const T* twiddles, const T* x, T* y) {
  const bool first = pass.s == 1, last = pass.m == 1;
  if (first && last) return FirstPass<Lie::kInterleaved>(pass, twiddles, x, y);
  if (first) return FirstPass<Lie::kSplit>(pass, twiddles, x, y);
  if (last) return LaterPass<Lie::kInterleaved>(pass, twiddles, x, y);
  LaterPass<Lie::kSplit>(pass, twiddles, x, y);
}

void PassFloat(const RadixPass& pass, const float* twiddles, const float* x, float* y) {
  PassAny(pass, twiddles, x, y);
}
void PassDouble(const RadixPass& pass, const double* twiddles, const double* x, double* y) {
  PassAny(pass, twiddles, x, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {

HWY_EXPORT(PassFloat);
HWY_EXPORT(PassDouble);

void run_pass(const RadixPass& pass, const float* twiddles, const float* x, float* y) {
  HWY_DYNAMIC_DISPATCH(PassFloat)(pass, twiddles, x, y);
}
void run_pass(const RadixPass& pass, const double* twiddles, const double* x, double* y) {
  HWY_DYNAMIC_DISPATCH(PassDouble)(pass, twiddles, x, y);
}

// Two passes of radix 4 come first, because then sequences lie side by side in whole vectors. The
// number of further passes is as small as possible.
std::vector<std::size_t> radices_of(std::size_t n) {
  std::vector<std::size_t> radices;
  const auto take = [&](std::size_t radix) {
    radices.push_back(radix);
    n /= radix;
  };
  const auto divides = [&](std::size_t radix) { return n % radix == 0; };
  for (int i = 0; i < 2 && divides(4); ++i) take(4);
  // 16 is split into 4 and 4, not into 8 and 2.
  while (divides(8) && (!divides(16) || divides(32))) take(8);
  while (divides(4)) take(4);
  for (const std::size_t radix : {2, 3, 5}) {
    while (divides(radix)) take(radix);
  }
  return radices;
}

template <typename T>
AlignedArray<T>& scratch_of(std::size_t n) {
  thread_local AlignedArray<T> scratch;
  if (scratch.size() < n) scratch = AlignedArray<T>(n);
  poison_scratch(scratch.data(), n * sizeof(T));
  return scratch;
}

}  // namespace

bool is_radix_length(std::size_t n) {
  for (const std::size_t radix : {2, 3, 5}) {
    while (n > 0 && n % radix == 0) n /= radix;
  }
  return n == 1;
}

template <typename T>
RadixPlan<T> make_radix_plan(std::size_t n) {
  RadixPlan<T> plan;
  std::size_t left = n, s = 1, count = 0;
  for (const std::size_t radix : radices_of(n)) {
    left /= radix;
    plan.passes.push_back({radix, left, s, count});
    count += 2 * (radix - 1) * left * plan.passes.back().copies();
    s *= radix;
  }
  plan.twiddles = AlignedArray<T>(count);
  for (const RadixPass& pass : plan.passes) {
    const std::size_t r = pass.radix, m = pass.m;
    for (std::size_t p = 0; p < m; ++p) {
      for (std::size_t k = 1; k < r; ++k) {
        const double angle =
            -2 * std::numbers::pi * static_cast<double>(p * k) / static_cast<double>(r * m);
        T* const at = plan.twiddles.data() + pass.twiddles + pass.twiddle(p, k);
        std::fill_n(at, pass.copies(), static_cast<T>(std::cos(angle)));
        std::fill_n(at + pass.imaginary(), pass.copies(), static_cast<T>(std::sin(angle)));
      }
    }
  }
  return plan;
}

// Passes alternate between the two arrays so that the last one reads `in`. If the first pass would
// then write the array that it reads, it writes to a scratch array instead.
template <typename T>
void run_radix_plan(const RadixPlan<T>& plan, std::complex<T>* in, std::complex<T>* out) {
  T* const begin = reinterpret_cast<T*>(in);
  T* const end = reinterpret_cast<T*>(out);
  if (plan.passes.empty()) {
    *out = *in;
    return;
  }
  const T* from = begin;
  const std::size_t n_passes = plan.passes.size();
  for (std::size_t i = 0; i < n_passes; ++i) {
    const RadixPass& pass = plan.passes[i];
    T* to = (n_passes - i) % 2 == 1 ? end : begin;
    if (to == from) to = scratch_of<T>(2 * pass.radix * pass.m).data();
    run_pass(pass, plan.twiddles.data() + pass.twiddles, from, to);
    from = to;
  }
}

template RadixPlan<float> make_radix_plan(std::size_t);
template RadixPlan<double> make_radix_plan(std::size_t);
template void run_radix_plan(const RadixPlan<float>&, std::complex<float>*, std::complex<float>*);
template void run_radix_plan(const RadixPlan<double>&, std::complex<double>*,
                             std::complex<double>*);

}  // namespace rholm
#endif  // HWY_ONCE
