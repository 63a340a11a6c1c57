#include "harmonic/fft/fft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "harmonic/fft/complex_plan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/fft/fft.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Calls visit(d, k) for runs of Lanes(d) numbers that begin at k and together cover 0 ... n - 1.
// The last run may overlap the one before. Requires n - 1 < limit, the number of readable values.
template <typename T, class Visit>
HWY_INLINE void visit_vectors(size_t n, size_t limit, const Visit& visit) {
  const hn::CappedTag<T, 16> d;
  constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<T, 16>());
  if (limit >= kLanes) {
    size_t k = 0;
    for (; k + kLanes < n; k += kLanes) visit(d, k);
    visit(d, n < kLanes ? 0 : n - kLanes);
  } else {
    for (size_t k = 0; k < n; ++k) visit(hn::CappedTag<T, 1>(), k);
  }
}

// With z_j = x_2j + i x_{2j+1} and its transform Z of length n/2: X_k = E_k + w^k O_k. Here
// 2 E_k = Z_k + conj(Z_{n/2-k}) and 2i O_k = Z_k - conj(Z_{n/2-k}).
template <typename T>
HWY_INLINE void UntangleAny(const T* HWY_RESTRICT z, const T* HWY_RESTRICT cosine,
                            const T* HWY_RESTRICT sine, size_t half, size_t used,
                            T* HWY_RESTRICT row) {
  visit_vectors<T>(used, half + 1, [&](auto d, size_t k) HWY_ATTR {
    using V = hn::Vec<decltype(d)>;
    V a_re, a_im, b_re, b_im;
    hn::LoadInterleaved2(d, z + 2 * k, a_re, a_im);
    hn::LoadInterleaved2(d, z + 2 * (half - k + 1 - hn::Lanes(d)), b_re, b_im);
    b_re = hn::Reverse(d, b_re);
    b_im = hn::Reverse(d, b_im);
    const V c = hn::LoadU(d, cosine + k), s = hn::LoadU(d, sine + k);
    const V even_re = hn::Add(a_re, b_re), even_im = hn::Sub(a_im, b_im);
    const V odd_re = hn::Add(a_im, b_im), odd_im = hn::Sub(b_re, a_re);
    const V re = hn::NegMulAdd(s, odd_im, hn::MulAdd(c, odd_re, even_re));
    const V im = hn::MulAdd(s, odd_re, hn::MulAdd(c, odd_im, even_im));
    const V share = hn::Set(d, T(0.5));
    hn::StoreInterleaved2(hn::Mul(share, re), hn::Mul(share, im), d, row + 2 * k);
  });
}

// Inverts UntangleAny() and exchanges the real and imaginary parts.
template <typename T>
HWY_INLINE void TangleAny(const T* HWY_RESTRICT row, const T* HWY_RESTRICT cosine,
                          const T* HWY_RESTRICT sine, size_t half, T* HWY_RESTRICT z) {
  visit_vectors<T>(half, half, [&](auto d, size_t k) HWY_ATTR {
    using V = hn::Vec<decltype(d)>;
    V a_re, a_im, b_re, b_im;
    hn::LoadInterleaved2(d, row + 2 * k, a_re, a_im);
    hn::LoadInterleaved2(d, row + 2 * (half - k + 1 - hn::Lanes(d)), b_re, b_im);
    b_re = hn::Reverse(d, b_re);
    b_im = hn::Reverse(d, b_im);
    const V c = hn::LoadU(d, cosine + k), s = hn::LoadU(d, sine + k);
    const V even_re = hn::Add(a_re, b_re), even_im = hn::Sub(a_im, b_im);
    const V back_re = hn::Sub(a_re, b_re), back_im = hn::Add(a_im, b_im);
    // re and im hold i conj(w^k) times the difference.
    const V re = hn::NegMulAdd(c, back_im, hn::MulAdd(s, back_re, even_re));
    const V im = hn::MulAdd(s, back_im, hn::MulAdd(c, back_re, even_im));
    hn::StoreInterleaved2(im, re, d, z + 2 * k);
  });
}

template <typename T>
HWY_INLINE void ExchangeAny(size_t half, T* row) {
  const hn::CappedTag<T, 16> d;
  constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<T, 16>());
  size_t i = 0;
  if constexpr (kLanes > 1) {
    for (; i + kLanes <= 2 * half; i += kLanes) {
      hn::StoreU(hn::Reverse2(d, hn::LoadU(d, row + i)), d, row + i);
    }
  }
  for (; i < 2 * half; i += 2) std::swap(row[i], row[i + 1]);
}

void UntangleFloat(const float* z, const float* cosine, const float* sine, size_t half, size_t used,
                   float* row) {
  UntangleAny(z, cosine, sine, half, used, row);
}
void UntangleDouble(const double* z, const double* cosine, const double* sine, size_t half,
                    size_t used, double* row) {
  UntangleAny(z, cosine, sine, half, used, row);
}
void TangleFloat(const float* row, const float* cosine, const float* sine, size_t half, float* z) {
  TangleAny(row, cosine, sine, half, z);
}
void TangleDouble(const double* row, const double* cosine, const double* sine, size_t half,
                  double* z) {
  TangleAny(row, cosine, sine, half, z);
}
void ExchangeFloat(size_t half, float* row) { ExchangeAny(half, row); }
void ExchangeDouble(size_t half, double* row) { ExchangeAny(half, row); }

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {

HWY_EXPORT(UntangleFloat);
HWY_EXPORT(UntangleDouble);
HWY_EXPORT(TangleFloat);
HWY_EXPORT(TangleDouble);
HWY_EXPORT(ExchangeFloat);
HWY_EXPORT(ExchangeDouble);

}  // namespace

std::size_t smooth_length(std::size_t n, std::size_t multiple) {
  if (n >= 128) multiple = std::max<std::size_t>(multiple, 16);
  std::size_t best = std::numeric_limits<std::size_t>::max();
  for (const std::size_t odd : {1, 5, 25}) {
    std::size_t length = odd * multiple;
    while (length < n) length *= 2;
    best = std::min(best, length);
  }
  return best;
}

template <typename T>
ComplexFft<T>::ComplexFft(std::size_t n) : plan_(complex_plan<T>(n)) {}

template <typename T>
void ComplexFft<T>::forward(std::complex<T>* in, std::complex<T>* out) const {
  execute_plan(plan_, in, out);
}

template <typename T>
RealFft<T>::RealFft(std::size_t n)
    : half_(n / 2), fft_(half_), cosine_(half_ + 1), sine_(half_ + 1) {
  for (std::size_t k = 0; k <= half_; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(half_);
    cosine_[k] = static_cast<T>(std::cos(angle));
    sine_[k] = static_cast<T>(-std::sin(angle));
  }
}

template <typename T>
void RealFft<T>::forward(T* row, std::size_t used, T* work) const {
  fft_.forward(reinterpret_cast<std::complex<T>*>(row), reinterpret_cast<std::complex<T>*>(work));
  work[2 * half_] = work[0];
  work[2 * half_ + 1] = work[1];
  if constexpr (sizeof(T) == sizeof(float)) {
    HWY_DYNAMIC_DISPATCH(UntangleFloat)(work, cosine_.data(), sine_.data(), half_, used, row);
  } else {
    HWY_DYNAMIC_DISPATCH(UntangleDouble)(work, cosine_.data(), sine_.data(), half_, used, row);
  }
}

// The inverse transform is a forward transform of numbers whose parts are exchanged.
template <typename T>
void RealFft<T>::backward(T* row, std::size_t used, T* work) const {
  std::fill(row + 2 * used, row + 2 * half_ + 2, T{0});
  row[1] = 0;
  if constexpr (sizeof(T) == sizeof(float)) {
    HWY_DYNAMIC_DISPATCH(TangleFloat)(row, cosine_.data(), sine_.data(), half_, work);
  } else {
    HWY_DYNAMIC_DISPATCH(TangleDouble)(row, cosine_.data(), sine_.data(), half_, work);
  }
  fft_.forward(reinterpret_cast<std::complex<T>*>(work), reinterpret_cast<std::complex<T>*>(row));
  if constexpr (sizeof(T) == sizeof(float)) {
    HWY_DYNAMIC_DISPATCH(ExchangeFloat)(half_, row);
  } else {
    HWY_DYNAMIC_DISPATCH(ExchangeDouble)(half_, row);
  }
}

template class ComplexFft<float>;
template class ComplexFft<double>;
template class RealFft<float>;
template class RealFft<double>;

}  // namespace rholm
#endif  // HWY_ONCE
