// The windows of sources from polynomials: inner loops of spread.cpp, compiled for each target.
#include <cstddef>

#include "harmonic/nonuniform/source_place-inl.h"
#include "harmonic/nonuniform/spread.h"

#if defined(RHOLM_HARMONIC_WINDOW_VALUES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_HARMONIC_WINDOW_VALUES_INL_H_
#undef RHOLM_HARMONIC_WINDOW_VALUES_INL_H_
#else
#define RHOLM_HARMONIC_WINDOW_VALUES_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMaxTaps = kMaxSpreadWidth;

// Wide windows add whole groups of this many columns, which begin at a multiple of it. A vector
// that spans two cache lines takes twice as long.
constexpr int kGroup = 4;
constexpr int kWidestNarrow = 8;

// Windows and derivatives of a block of sources. In theta there is one array per tap, to be
// broadcast. In phi, four taps of a source are together, to be loaded as vectors; `wide`, for
// spreading wide windows, has all taps with zeros before and behind them.
template <typename T>
struct Windows {
  alignas(64) T theta[3][kMaxTaps][kBlock<T>];
  alignas(64) T phi[3][kMaxTaps / 4][kBlock<T>][4];
  alignas(64) T wide[3][kBlock<T>][kGroup + kMaxTaps + kGroup];
};

// Sets the zeros around the taps of wide windows, which are the same for all blocks.
template <int kOrders, typename T>
HWY_INLINE void clear_around_taps(int width, Windows<T>& w) {
  const hn::CappedTag<T, kGroup> d;
  const size_t behind = kGroup + static_cast<size_t>(width);
  for (int order = 0; order < kOrders; ++order) {
    for (auto& row : w.wide[order]) {
      for (size_t at = 0; at < kGroup + kMaxTaps + kGroup; at += hn::MaxLanes(d)) {
        if (at < kGroup || at >= behind) hn::Store(hn::Zero(d), d, row + at);
      }
    }
  }
}

// The window and its derivatives at one tap; lanes are sources.
template <class V>
struct Tap {
  V value, slope, curvature;
};

// Evaluates the windows at u and calls store(tap number, Tap). The taps of the other half of the
// window are the mirror images at -u.
template <int kTerms, int kOrders, class D, typename T, class Store>
HWY_INLINE void windows_at(D d, const SpreadTable<T>& table, hn::Vec<D> u, const Store& store) {
  using V = hn::Vec<D>;
  const V uu = hn::Mul(u, u);
  const int width = table.width;
  const size_t next = table.row(1, 0) - table.row(0, 0);
  for (int i = 0; 2 * i < width; ++i) {
    const T* c = table.row(0, i);
    V even[kOrders], odd[kOrders];
    for (int order = 0; order < kOrders; ++order, c += next) {
      even[order] = hn::Set(d, c[kTerms - 2]);
      odd[order] = hn::Set(d, c[kTerms - 1]);
      for (int q = kTerms - 4; q >= 0; q -= 2) {
        even[order] = hn::MulAdd(even[order], uu, hn::Set(d, c[q]));
        odd[order] = hn::MulAdd(odd[order], uu, hn::Set(d, c[q + 1]));
      }
    }
    Tap<V> tap, mirrored;
    tap.value = hn::MulAdd(odd[0], u, even[0]);
    mirrored.value = hn::NegMulAdd(odd[0], u, even[0]);
    if constexpr (kOrders > 1) {
      tap.slope = hn::MulAdd(odd[1], u, even[1]);
      mirrored.slope = hn::MulSub(odd[1], u, even[1]);
    }
    if constexpr (kOrders > 2) {
      tap.curvature = hn::MulAdd(odd[2], u, even[2]);
      mirrored.curvature = hn::NegMulAdd(odd[2], u, even[2]);
    }
    store(i, tap);
    if (2 * i + 1 < width) store(width - 1 - i, mirrored);
  }
}

// Returns the factors of the window in phi and of its derivatives, for one tap in theta.
template <int kOrders, class D, typename T = hn::TFromD<D>, class V = hn::Vec<D>>
HWY_INLINE Tap<V> apply_factors(D d, const Placed<T>& p, size_t at, const Tap<V>& tap) {
  Tap<V> by;
  by.value = hn::Mul(hn::Load(d, p.value + at), tap.value);
  if constexpr (kOrders > 1) {
    by.value = hn::MulAdd(hn::Load(d, p.theta + at), tap.slope, by.value);
    by.slope = hn::Mul(hn::Load(d, p.phi + at), tap.value);
  }
  if constexpr (kOrders > 2) {
    by.value = hn::MulAdd(hn::Load(d, p.theta_theta + at), tap.curvature, by.value);
    by.slope = hn::MulAdd(hn::Load(d, p.theta_phi + at), tap.slope, by.slope);
    by.curvature = hn::Mul(hn::Load(d, p.phi_phi + at), tap.value);
  }
  return by;
}

template <int kOrders, class D, class V = hn::Vec<D>>
HWY_INLINE void store_tap(D d, const Tap<V>& tap, hn::TFromD<D>* to, size_t stride) {
  hn::Store(tap.value, d, to);
  if constexpr (kOrders > 1) hn::Store(tap.slope, d, to + stride);
  if constexpr (kOrders > 2) hn::Store(tap.curvature, d, to + 2 * stride);
}

// Stores four taps of Lanes(d) sources, given tap by tap in `taps`, source by source.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void store_fours(D d, const T* taps, T* to) {
  constexpr size_t kLanes = hn::MaxLanes(D());
  hn::StoreInterleaved4(hn::Load(d, taps), hn::Load(d, taps + kLanes),
                        hn::Load(d, taps + 2 * kLanes), hn::Load(d, taps + 3 * kLanes), d, to);
}
template <class D, typename T = hn::TFromD<D>, size_t kRow>
HWY_INLINE void store_fours(D d, const T* taps, T (*rows)[kRow], int first) {
  constexpr size_t kLanes = hn::MaxLanes(D());
  const hn::CappedTag<T, 4> four;
  alignas(64) T fours[4 * kLanes];
  store_fours(d, taps, fours);
  for (size_t i = 0; i < kLanes; ++i) {
    for (size_t v = 0; v < 4; v += hn::MaxLanes(four)) {
      hn::Store(hn::Load(four, fours + 4 * i + v), four, rows[i] + first + v);
    }
  }
}

// Evaluates the windows of n placed sources, rounded up to whole vectors. If kFactors, the windows
// in theta are multiplied by the factors of the sources.
template <int kTerms, int kOrders, bool kFactors, typename T>
void evaluate_windows(const GridKernel<T>& kernel, const Placed<T>& p, size_t n, Windows<T>& out) {
  const hn::CappedTag<T, 16> d;
  using V = hn::Vec<decltype(d)>;
  constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<T, 16>());
  constexpr size_t kThetaStride = kMaxTaps * kBlock<T>, kPhiStride = kMaxTaps * kLanes;
  // Taps beyond the width are zeros, as far as they are loaded.
  const bool wide = kFactors && kernel.layout.width > kWidestNarrow;
  const int blocks = (wide ? kernel.layout.width + 3 : padded_width(kernel.layout.width)) / 4;
  alignas(64) T taps[kOrders * kPhiStride] = {};
  for (size_t at = 0; at < n; at += kLanes) {
    windows_at<kTerms, kOrders>(
        d, kernel.theta, hn::Load(d, p.u_theta + at), [&](int i, const Tap<V>& tap) HWY_ATTR {
          T* to = out.theta[0][i] + at;
          if constexpr (kFactors) {
            store_tap<kOrders>(d, apply_factors<kOrders>(d, p, at, tap), to, kThetaStride);
          } else {
            store_tap<kOrders>(d, tap, to, kThetaStride);
          }
        });
    windows_at<kTerms, kOrders>(d, kernel.phi, hn::Load(d, p.u_phi + at),
                                [&](int i, const Tap<V>& tap) HWY_ATTR {
                                  store_tap<kOrders>(d, tap, taps + i * kLanes, kPhiStride);
                                });
    for (int order = 0; order < kOrders; ++order) {
      for (int block = 0; block < blocks; ++block) {
        const T* first = taps + order * kPhiStride + 4 * (block * kLanes);
        if (wide) {
          store_fours(d, first, out.wide[order] + at, kGroup + 4 * block);
        } else {
          store_fours(d, first, out.phi[order][block][at]);
        }
      }
    }
  }
}

// Evaluates the windows for the number of terms of the kernel.
template <int kOrders, bool kFactors, typename T>
HWY_INLINE void evaluate_windows(const GridKernel<T>& kernel, const Placed<T>& p, size_t n,
                                 Windows<T>& out) {
  static_assert(kMaxSpreadTerms == 14);
  switch (kernel.phi.terms) {
    case 4:
      return evaluate_windows<4, kOrders, kFactors>(kernel, p, n, out);
    case 6:
      return evaluate_windows<6, kOrders, kFactors>(kernel, p, n, out);
    case 8:
      return evaluate_windows<8, kOrders, kFactors>(kernel, p, n, out);
    case 10:
      return evaluate_windows<10, kOrders, kFactors>(kernel, p, n, out);
    case 12:
      return evaluate_windows<12, kOrders, kFactors>(kernel, p, n, out);
    default:
      return evaluate_windows<14, kOrders, kFactors>(kernel, p, n, out);
  }
}

// Loads the taps lane ... lane + Lanes(d) - 1 of source j in phi.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> load_taps(D d, const T (*phi)[kBlock<T>][4], size_t j, size_t lane) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 4) {
    const hn::Half<D> half;
    return hn::Combine(d, load_taps(half, phi, j, lane + hn::MaxLanes(half)),
                       load_taps(half, phi, j, lane));
  }
#endif
  return hn::LoadU(d, phi[lane / 4][j] + lane % 4);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif  // include guard, for each target
