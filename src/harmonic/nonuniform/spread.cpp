#include "harmonic/nonuniform/spread.h"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/nonuniform/spread.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/poison.h"
#include "harmonic/nonuniform/source_place-inl.h"
#include "harmonic/nonuniform/window_values-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Neighbours in a mesh share cells, and a load that overlaps a store on its way to the cache waits
// for it. Sources are therefore taken in steps of this number. Measured (scripts/constants): 5
// instead of 8 ns for six rows of eight cells, from 0.3 to 3 cells between neighbours.
template <typename T>
constexpr size_t kApart = kBlock<T> / 4;

// Calls visit(j) for all j < n.
template <typename T, class Visit>
HWY_INLINE void visit_apart(size_t n, const Visit& visit) {
  for (size_t first = 0; first < kApart<T>; ++first) {
    for (size_t j = first; j < n; j += kApart<T>) visit(j);
  }
}

template <class D>
HWY_INLINE hn::Vec<D> in_double(D, hn::Vec<D> taps) {
  return taps;
}
template <class D>
HWY_INLINE hn::Vec<D> in_double(D d, hn::Vec<hn::Rebind<float, D>> taps) {
  return hn::PromoteTo(d, taps);
}

// Adds to kColumns columns in each row, which begin at the first tap or, for wide windows, at the
// group of the first tap. Products are in double precision: converting the taps of a source to
// double takes less time than converting all products.
template <int kColumns, int kOrders, typename T>
void spread_rows(const GridLayout& layout, const Placed<T>& p, const Windows<T>& w, size_t n,
                 double* HWY_RESTRICT grid) {
  constexpr bool kWide = kColumns > kWidestNarrow;
  using D = hn::CappedTag<double, kWide ? kGroup : kColumns>;
  const D d;
  const hn::Rebind<T, D> dt;
  constexpr size_t kLanes = hn::MaxLanes(D());
  constexpr size_t kVectors = kColumns / kLanes;
  const size_t stride = layout.stride;
  const int width = layout.width;
  visit_apart<T>(n, [&](size_t j) HWY_ATTR {
    const size_t before = kWide ? static_cast<size_t>(p.column[j]) % kGroup : 0;
    hn::Vec<D> q[kOrders * kVectors];
    for (int order = 0; order < kOrders; ++order) {
      for (size_t v = 0; v < kVectors; ++v) {
        const auto taps = kWide ? hn::LoadU(dt, w.wide[order][j] + kGroup - before + v * kLanes)
                                : load_taps(dt, w.phi[order], j, v * kLanes);
        q[order * kVectors + v] = in_double(d, taps);
      }
    }
    double* HWY_RESTRICT row = grid + static_cast<size_t>(p.row[j]) * stride + p.column[j] - before;
    for (int i = 0; i < width; ++i, row += stride) {
      hn::Vec<D> factor[kOrders];
      for (int order = 0; order < kOrders; ++order) {
        factor[order] = hn::Set(d, double{w.theta[order][i][j]});
      }
      for (size_t v = 0; v < kVectors; ++v) {
        auto cells = hn::LoadU(d, row + v * kLanes);
        for (int order = 0; order < kOrders; ++order) {
          cells = hn::MulAdd(factor[order], q[order * kVectors + v], cells);
        }
        hn::StoreU(cells, d, row + v * kLanes);
      }
    }
  });
}

// Sums of up to four remaining lanes: the function and its derivatives by theta and phi.
template <typename T>
struct Partial {
  alignas(64) T lanes[3][kBlock<T>][4];
};

// Adds halves of vectors until four lanes are left.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void store_partial(D d, V v, hn::TFromD<D>* to) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 4) {
    const hn::Half<D> half;
    return store_partial(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)), to);
  }
#endif
  hn::StoreU(v, d, to);
}

template <int kLeft, class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> sum_partial(D d, const T (*lanes)[4]) {
  using V = hn::Vec<D>;
  if constexpr (kLeft == 1) {
    T sum[hn::MaxLanes(D())];
    for (size_t i = 0; i < hn::MaxLanes(D()); ++i) sum[i] = lanes[i][0];
    return hn::LoadU(d, sum);
  } else {
    V a, b, c, e;
    hn::LoadInterleaved4(d, lanes[0], a, b, c, e);
    if constexpr (kLeft == 2) return hn::Add(a, b);
    return hn::Add(hn::Add(a, b), hn::Add(c, e));
  }
}

// Interpolates the function and, for two orders, its derivatives by grid steps.
template <int kPadded, int kOrders, typename T>
void interpolate_rows(const GridLayout& layout, Placed<T>& p, const Windows<T>& w, size_t n,
                      const T* HWY_RESTRICT grid) {
  using D = hn::CappedTag<T, kPadded>;
  using V = hn::Vec<D>;
  const D d;
  constexpr size_t kLanes = hn::MaxLanes(D());
  constexpr size_t kVectors = kPadded / kLanes;
  const size_t stride = layout.stride;
  const int width = layout.width;
  Partial<T> partial;
  poison_all(partial);
  for (size_t j = 0; j < n; ++j) {
    // Sums over rows with the window in theta, and with the derivative of the window.
    V sum[kVectors], slope[kVectors];
    for (size_t v = 0; v < kVectors; ++v) sum[v] = slope[v] = hn::Zero(d);
    const T* HWY_RESTRICT row = grid + static_cast<size_t>(p.row[j]) * stride + p.column[j];
    for (int i = 0; i < width; ++i, row += stride) {
      for (size_t v = 0; v < kVectors; ++v) {
        const V cells = hn::LoadU(d, row + v * kLanes);
        sum[v] = hn::MulAdd(hn::Set(d, w.theta[0][i][j]), cells, sum[v]);
        if constexpr (kOrders > 1) {
          slope[v] = hn::MulAdd(hn::Set(d, w.theta[1][i][j]), cells, slope[v]);
        }
      }
    }
    V f = hn::Zero(d), f_theta = hn::Zero(d), f_phi = hn::Zero(d);
    for (size_t v = 0; v < kVectors; ++v) {
      const V taps = load_taps(d, w.phi[0], j, v * kLanes);
      f = hn::MulAdd(sum[v], taps, f);
      if constexpr (kOrders > 1) {
        f_theta = hn::MulAdd(slope[v], taps, f_theta);
        f_phi = hn::MulAdd(sum[v], load_taps(d, w.phi[1], j, v * kLanes), f_phi);
      }
    }
    store_partial(d, f, partial.lanes[0][j]);
    if constexpr (kOrders > 1) {
      store_partial(d, f_theta, partial.lanes[1][j]);
      store_partial(d, f_phi, partial.lanes[2][j]);
    }
  }
  const hn::CappedTag<T, 16> dn;
  constexpr int kLeft = kLanes < 4 ? static_cast<int>(kLanes) : 4;
  for (size_t at = 0; at < n; at += hn::MaxLanes(dn)) {
    hn::Store(sum_partial<kLeft>(dn, partial.lanes[0] + at), dn, p.value + at);
    if constexpr (kOrders > 1) {
      hn::Store(sum_partial<kLeft>(dn, partial.lanes[1] + at), dn, p.theta + at);
      hn::Store(sum_partial<kLeft>(dn, partial.lanes[2] + at), dn, p.phi + at);
    }
  }
}

// Calls work with the padded width as a constant.
template <class Work>
HWY_INLINE void with_padded_width(int width, const Work& work) {
  const int padded = padded_width(width);
  if (padded == 4) return work(std::integral_constant<int, 4>());
  if (padded == 8) return work(std::integral_constant<int, 8>());
  work(std::integral_constant<int, 16>());
}

// Calls work with the number of columns of spread_rows() as a constant.
template <class Work>
HWY_INLINE void with_columns(int width, const Work& work) {
  if (width <= 4) return work(std::integral_constant<int, 4>());
  if (width <= kWidestNarrow) return work(std::integral_constant<int, kWidestNarrow>());
  // The first tap may be the last column of its group, so that width + 3 columns are needed.
  if (width <= 9) return work(std::integral_constant<int, 12>());
  if (width <= 13) return work(std::integral_constant<int, 16>());
  work(std::integral_constant<int, 20>());
}

template <int kOrders, typename T>
HWY_INLINE void place_block(const GridKernel<T>& kernel, const SourceBatch<T>& batch, size_t from,
                            size_t count, size_t n, T polar_sine, Placed<T>& placed,
                            PolarSources& polar) {
  const hn::CappedTag<T, 16> d;
  const GridLayout& layout = kernel.layout;
  const size_t already = polar.count;
  place(layout, batch, from, count, placed);
  for (size_t at = 0; at < count; at += hn::MaxLanes(d)) {
    hn::Store(hn::Load(d, batch.value + from + at), d, placed.value + at);
    if constexpr (kOrders > 1) {
      const auto frame = frame_of(d, placed, at);
      place_gradient(d, layout, batch, from, at, frame, placed);
      if constexpr (kOrders > 2) place_hessian(d, layout, batch, from, at, frame, placed);
      list_polar(d, frame, polar_sine, from + at, n, polar);
    }
  }
  for (size_t i = already; i < polar.count; ++i) {
    const size_t j = polar.index[i] - from;
    placed.value[j] = placed.theta[j] = placed.phi[j] = T{0};
    placed.theta_theta[j] = placed.theta_phi[j] = placed.phi_phi[j] = T{0};
  }
}

template <int kOrders, typename T>
void spread_batch(const GridKernel<T>& kernel, const SourceBatch<T>& batch, size_t n,
                  double polar_sine, double* grid, PolarSources& polar) {
  Placed<T> placed;
  Windows<T> windows;
  poison_all(windows);
  const GridLayout& layout = kernel.layout;
  if (layout.width > kWidestNarrow) clear_around_taps<kOrders>(layout.width, windows);
  for (size_t from = 0; from < n; from += kBlock<T>) {
    const size_t count = HWY_MIN(kBlock<T>, n - from);
    poison_all(placed);
    place_block<kOrders>(kernel, batch, from, count, n, static_cast<T>(polar_sine), placed, polar);
    evaluate_windows<kOrders, true>(kernel, placed, count, windows);
    with_columns(layout.width, [&](auto columns) {
      spread_rows<columns.value, kOrders>(layout, placed, windows, count, grid);
    });
  }
}

// Computes the gradient by position from the derivatives by grid steps.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void store_gradient(D d, const GridLayout& layout, const Placed<T>& placed, size_t at,
                               size_t from, SourceBatch<T>& batch) {
  using V = hn::Vec<D>;
  const auto frame = frame_of(d, placed, at);
  const V by_theta = hn::Mul(hn::Load(d, placed.theta + at),
                             hn::Mul(frame.inverse_r, hn::Set(d, steps<T>(layout.n_theta))));
  const V by_phi = hn::Mul(
      hn::Load(d, placed.phi + at),
      hn::Mul(hn::Mul(frame.inverse_r, frame.inverse_sine), hn::Set(d, steps<T>(layout.n_phi))));
  const V outward = hn::Mul(by_theta, frame.cos_theta);
  hn::Store(hn::NegMulAdd(by_phi, frame.sin_phi, hn::Mul(outward, frame.cos_phi)), d,
            batch.gradient[0] + from + at);
  hn::Store(hn::MulAdd(by_phi, frame.cos_phi, hn::Mul(outward, frame.sin_phi)), d,
            batch.gradient[1] + from + at);
  hn::Store(hn::Neg(hn::Mul(by_theta, frame.sin_theta)), d, batch.gradient[2] + from + at);
}

template <int kOrders, typename T>
void interpolate_batch(const GridKernel<T>& kernel, const T* grid, size_t n, double polar_sine,
                       SourceBatch<T>& batch, PolarSources& polar) {
  const hn::CappedTag<T, 16> d;
  const GridLayout& layout = kernel.layout;
  Placed<T> placed;
  Windows<T> windows;
  for (size_t from = 0; from < n; from += kBlock<T>) {
    const size_t count = HWY_MIN(kBlock<T>, n - from);
    poison_all(placed);
    poison_all(windows);
    place(layout, batch, from, count, placed);
    evaluate_windows<kOrders, false>(kernel, placed, count, windows);
    with_padded_width(layout.width, [&](auto padded) {
      interpolate_rows<padded.value, kOrders>(layout, placed, windows, count, grid);
    });
    for (size_t at = 0; at < count; at += hn::MaxLanes(d)) {
      hn::Store(hn::Load(d, placed.value + at), d, batch.value + from + at);
      if constexpr (kOrders > 1) {
        store_gradient(d, layout, placed, at, from, batch);
        list_polar(d, frame_of(d, placed, at), static_cast<T>(polar_sine), from + at, n, polar);
      }
    }
  }
}

template <typename T>
HWY_INLINE void SpreadAny(const GridKernel<T>& kernel, const SourceBatch<T>& batch, size_t n,
                          int derivatives, double polar_sine, double* grid, PolarSources& polar) {
  polar.count = 0;
  if (derivatives == 0) return spread_batch<1>(kernel, batch, n, polar_sine, grid, polar);
  if (derivatives == 1) return spread_batch<2>(kernel, batch, n, polar_sine, grid, polar);
  spread_batch<3>(kernel, batch, n, polar_sine, grid, polar);
}

template <typename T>
HWY_INLINE void InterpolateAny(const GridKernel<T>& kernel, const T* grid, size_t n,
                               int derivatives, double polar_sine, SourceBatch<T>& batch,
                               PolarSources& polar) {
  polar.count = 0;
  if (derivatives == 0) return interpolate_batch<1>(kernel, grid, n, polar_sine, batch, polar);
  interpolate_batch<2>(kernel, grid, n, polar_sine, batch, polar);
}

void SpreadFloat(const GridKernel<float>& kernel, const SourceBatch<float>& batch, size_t n,
                 int derivatives, double polar_sine, double* grid, PolarSources& polar) {
  SpreadAny(kernel, batch, n, derivatives, polar_sine, grid, polar);
}
void SpreadDouble(const GridKernel<double>& kernel, const SourceBatch<double>& batch, size_t n,
                  int derivatives, double polar_sine, double* grid, PolarSources& polar) {
  SpreadAny(kernel, batch, n, derivatives, polar_sine, grid, polar);
}
void InterpolateFloat(const GridKernel<float>& kernel, const float* grid, size_t n, int derivatives,
                      double polar_sine, SourceBatch<float>& batch, PolarSources& polar) {
  InterpolateAny(kernel, grid, n, derivatives, polar_sine, batch, polar);
}
void InterpolateDouble(const GridKernel<double>& kernel, const double* grid, size_t n,
                       int derivatives, double polar_sine, SourceBatch<double>& batch,
                       PolarSources& polar) {
  InterpolateAny(kernel, grid, n, derivatives, polar_sine, batch, polar);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SpreadFloat);
HWY_EXPORT(SpreadDouble);
HWY_EXPORT(InterpolateFloat);
HWY_EXPORT(InterpolateDouble);

GridLayout grid_layout(int width, std::size_t n_phi, std::size_t n_theta) {
  GridLayout layout{
      .width = width, .n_phi = n_phi, .n_theta = n_theta, .rows = n_theta / 2 + width, .stride = 0};
  constexpr std::size_t kLine = 16;  // a cache line of floats, two of doubles
  // The groups of the widest windows reach at most to column n_phi + 19; the transform needs
  // n_phi + 2 columns.
  layout.stride = (n_phi + 20 + kLine - 1) / kLine * kLine;
  // Rows at distances of a multiple of 4 KiB would share the same sets of the cache.
  if (layout.stride * sizeof(float) % 2048 == 0) layout.stride += kLine;
  return layout;
}

template <>
void spread(const GridKernel<float>& kernel, const SourceBatch<float>& batch, std::size_t n,
            int derivatives, double polar_sine, double* grid, PolarSources& polar) {
  HWY_DYNAMIC_DISPATCH(SpreadFloat)(kernel, batch, n, derivatives, polar_sine, grid, polar);
}
template <>
void spread(const GridKernel<double>& kernel, const SourceBatch<double>& batch, std::size_t n,
            int derivatives, double polar_sine, double* grid, PolarSources& polar) {
  HWY_DYNAMIC_DISPATCH(SpreadDouble)(kernel, batch, n, derivatives, polar_sine, grid, polar);
}
template <>
void interpolate(const GridKernel<float>& kernel, const float* grid, std::size_t n, int derivatives,
                 double polar_sine, SourceBatch<float>& batch, PolarSources& polar) {
  HWY_DYNAMIC_DISPATCH(InterpolateFloat)(kernel, grid, n, derivatives, polar_sine, batch, polar);
}
template <>
void interpolate(const GridKernel<double>& kernel, const double* grid, std::size_t n,
                 int derivatives, double polar_sine, SourceBatch<double>& batch,
                 PolarSources& polar) {
  HWY_DYNAMIC_DISPATCH(InterpolateDouble)(kernel, grid, n, derivatives, polar_sine, batch, polar);
}

}  // namespace rholm
#endif  // HWY_ONCE
