#include "harmonic/nonuniform/circle_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/nonuniform/circle_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Calls visit(row, index, index of the mirror image, shared) for all rows; `shared` tells that
// another row may use one of the two indices. The circle has n points: row r is at -r, its mirror
// image at r - w. No other row uses the indices of rows w + 1 ... n/2.
template <class Visit>
HWY_INLINE void visit_rows(const GridLayout& layout, const Visit& visit) {
  const size_t n = layout.n_theta, w = static_cast<size_t>(layout.width);
  for (size_t row = 0; row < layout.rows; ++row) {
    const size_t here = row == 0 ? 0 : n - row;
    const size_t there = row < w ? n + row - w : row - w;
    visit(row, here, there, row <= w || row > n / 2);
  }
}

// Rows are a page or more apart, where the processor does not prefetch by itself.
constexpr size_t kRowsAhead = 12;  // measured (scripts/constants): 8 to 16 are equally fast

template <typename T>
HWY_INLINE void GatherAny(const GridLayout& layout, const T* HWY_RESTRICT rows,
                          T* const* HWY_RESTRICT circles) {
  using D = hn::CappedTag<T, 2>;  // one complex number
  const D d;
  const size_t n = layout.n_theta, w = static_cast<size_t>(layout.width);
  for (int pair = 0; pair < kPairs; ++pair) {
    T* circle = circles[pair];
    std::fill(circle, circle + 2, T{0});
    std::fill(circle + 2 * (n - w), circle + 2 * n, T{0});
    std::fill(circle + 2 * (n / 2 + 1 - w), circle + n, T{0});
  }
  visit_rows(layout, [&](size_t row, size_t here, size_t there, bool shared) HWY_ATTR {
    const T* HWY_RESTRICT values = rows + row * layout.stride;
    if (row + kRowsAhead < layout.rows) hwy::Prefetch(values + kRowsAhead * layout.stride);
    for (int pair = 0; pair < kPairs; ++pair) {
      for (size_t i = 0; i < 2; i += hn::MaxLanes(D())) {
        const auto a = hn::LoadU(d, values + 4 * pair + i);
        const auto b = hn::LoadU(d, values + 4 * pair + 2 + i);
        T *to_here = circles[pair] + 2 * here + i, *to_there = circles[pair] + 2 * there + i;
        auto sum = hn::Add(a, b), difference = hn::Sub(a, b);
        if (HWY_UNLIKELY(shared)) {
          hn::StoreU(hn::Add(sum, hn::LoadU(d, to_here)), d, to_here);
          difference = hn::Add(difference, hn::LoadU(d, to_there));
        } else {
          hn::StoreU(sum, d, to_here);
        }
        hn::StoreU(difference, d, to_there);
      }
    }
  });
}

template <typename T>
HWY_INLINE void ScatterAny(const GridLayout& layout, const T* const* HWY_RESTRICT circles,
                           T* HWY_RESTRICT rows) {
  using D = hn::CappedTag<T, 2>;
  const D d;
  visit_rows(layout, [&](size_t row, size_t here, size_t there, bool) HWY_ATTR {
    T* HWY_RESTRICT values = rows + row * layout.stride;
    if (row + kRowsAhead < layout.rows) hwy::Prefetch(values + kRowsAhead * layout.stride);
    for (int pair = 0; pair < kPairs; ++pair) {
      for (size_t i = 0; i < 2; i += hn::MaxLanes(D())) {
        const auto a = hn::LoadU(d, circles[pair] + 2 * here + i);
        const auto b = hn::LoadU(d, circles[pair] + 2 * there + i);
        hn::StoreU(hn::Add(a, b), d, values + 4 * pair + i);
        hn::StoreU(hn::Sub(a, b), d, values + 4 * pair + 2 + i);
      }
    }
  });
}

template <typename T>
HWY_INLINE void MultiplyAny(const Factors<T>& factors, const T* HWY_RESTRICT in,
                            T* HWY_RESTRICT out) {
  const hn::CappedTag<T, 16> d;
  constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<T, 16>());
  const T *re = factors.re.data(), *im = factors.im.data();
  const size_t n = 2 * factors.size;
  size_t i = 0;
  if constexpr (kLanes > 1) {
    for (; i + kLanes <= n; i += kLanes) {
      const auto v = hn::LoadU(d, in + i);
      const auto crossed = hn::Mul(hn::Reverse2(d, v), hn::Load(d, im + i));
      hn::StoreU(hn::MulAdd(v, hn::Load(d, re + i), crossed), d, out + i);
    }
  }
  for (; i < n; i += 2) {
    const T a = in[i], b = in[i + 1];
    out[i] = a * re[i] + b * im[i];
    out[i + 1] = b * re[i + 1] + a * im[i + 1];
  }
}

// Vectors of double, and vectors with as many elements of the type of the circles.
using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
template <typename T>
using Narrow = hn::Rebind<T, D>;
constexpr size_t kLanes = hn::MaxLanes(D());

HWY_INLINE V widen(V v) { return v; }
HWY_INLINE V widen(hn::Vec<Narrow<float>> v) { return hn::PromoteTo(D(), v); }
HWY_INLINE V narrow(Narrow<double>, V v) { return v; }
HWY_INLINE hn::Vec<Narrow<float>> narrow(Narrow<float> d, V v) { return hn::DemoteTo(d, v); }

template <typename T>
HWY_INLINE void load_complex(const T* from, V& re, V& im) {
  hn::Vec<Narrow<T>> a, b;
  hn::LoadInterleaved2(Narrow<T>(), from, a, b);
  re = widen(a);
  im = widen(b);
}
template <typename T>
HWY_INLINE void store_complex(V re, V im, T* to) {
  const Narrow<T> d;
  hn::StoreInterleaved2(narrow(d, re), narrow(d, im), d, to);
}
// Loads numbers in descending order of their index, from `last` on.
template <typename T>
HWY_INLINE void load_down(const T* last, V& re, V& im) {
  load_complex(last + 2 - 2 * kLanes, re, im);
  re = hn::Reverse(D(), re);
  im = hn::Reverse(D(), im);
}
template <typename T>
HWY_INLINE void store_down(V re, V im, T* last) {
  store_complex(hn::Reverse(D(), re), hn::Reverse(D(), im), last + 2 - 2 * kLanes);
}

// Calls visit(q) for the start indices of vectors that cover 0 ... n - 1, n >= kLanes. The last two
// vectors may overlap.
template <class Visit>
HWY_INLINE void visit_vectors(size_t n, const Visit& visit) {
  for (size_t q = 0; q + kLanes < n; q += kLanes) visit(q);
  visit(n - kLanes);
}

// Northern ring q is at index q and, on the other half of the circle, at 2 n - 1 - q. Its southern
// mirror image is at n - 1 - q and at n + q.
template <typename T>
HWY_INLINE void SplitAny(const T* HWY_RESTRICT circle, size_t n, const RingParts& even,
                         const RingParts& odd) {
  const D d;
  visit_vectors(n / 2, [&](size_t q) HWY_ATTR {
    V a_re, a_im, b_re, b_im, c_re, c_im, e_re, e_im;
    load_complex(circle + 2 * q, a_re, a_im);
    load_down(circle + 2 * (2 * n - 1 - q), b_re, b_im);
    load_down(circle + 2 * (n - 1 - q), c_re, c_im);
    load_complex(circle + 2 * (n + q), e_re, e_im);
    const auto store = [&](V north, V south, double* sum, double* difference) HWY_ATTR {
      hn::StoreU(hn::Add(north, south), d, sum + q);
      hn::StoreU(hn::Sub(north, south), d, difference + q);
    };
    store(hn::Add(a_re, b_re), hn::Add(c_re, e_re), even.even_re, even.odd_re);
    store(hn::Add(a_im, b_im), hn::Add(c_im, e_im), even.even_im, even.odd_im);
    store(hn::Sub(a_re, b_re), hn::Sub(c_re, e_re), odd.even_re, odd.odd_re);
    store(hn::Sub(a_im, b_im), hn::Sub(c_im, e_im), odd.even_im, odd.odd_im);
  });
}

template <typename T>
HWY_INLINE void JoinAny(const RingParts& even, const RingParts& odd, size_t n,
                        T* HWY_RESTRICT circle) {
  const D d;
  visit_vectors(n / 2, [&](size_t q) HWY_ATTR {
    const auto load = [&](const double* from) HWY_ATTR { return hn::LoadU(d, from + q); };
    const V ee_re = load(even.even_re), eo_re = load(even.odd_re);
    const V ee_im = load(even.even_im), eo_im = load(even.odd_im);
    const V oe_re = load(odd.even_re), oo_re = load(odd.odd_re);
    const V oe_im = load(odd.even_im), oo_im = load(odd.odd_im);
    const V north_re = hn::Add(ee_re, eo_re), north_im = hn::Add(ee_im, eo_im);
    const V south_re = hn::Sub(ee_re, eo_re), south_im = hn::Sub(ee_im, eo_im);
    const V odd_north_re = hn::Add(oe_re, oo_re), odd_north_im = hn::Add(oe_im, oo_im);
    const V odd_south_re = hn::Sub(oe_re, oo_re), odd_south_im = hn::Sub(oe_im, oo_im);
    store_complex(hn::Add(north_re, odd_north_re), hn::Add(north_im, odd_north_im), circle + 2 * q);
    store_down(hn::Sub(north_re, odd_north_re), hn::Sub(north_im, odd_north_im),
               circle + 2 * (2 * n - 1 - q));
    store_down(hn::Add(south_re, odd_south_re), hn::Add(south_im, odd_south_im),
               circle + 2 * (n - 1 - q));
    store_complex(hn::Sub(south_re, odd_south_re), hn::Sub(south_im, odd_south_im),
                  circle + 2 * (n + q));
  });
}

// Defines the functions of both types under names that can be exported.
#define RHOLM_CIRCLE_KERNELS(T, Name)                                                        \
  void Gather##Name(const GridLayout& layout, const T* rows, T* const* circles) {            \
    GatherAny(layout, rows, circles);                                                        \
  }                                                                                          \
  void Scatter##Name(const GridLayout& layout, const T* const* circles, T* rows) {           \
    ScatterAny(layout, circles, rows);                                                       \
  }                                                                                          \
  void Multiply##Name(const Factors<T>& factors, const T* in, T* out) {                      \
    MultiplyAny(factors, in, out);                                                           \
  }                                                                                          \
  void Split##Name(const T* circle, size_t n, const RingParts& even, const RingParts& odd) { \
    SplitAny(circle, n, even, odd);                                                          \
  }                                                                                          \
  void Join##Name(const RingParts& even, const RingParts& odd, size_t n, T* circle) {        \
    JoinAny(even, odd, n, circle);                                                           \
  }
RHOLM_CIRCLE_KERNELS(float, Float)
RHOLM_CIRCLE_KERNELS(double, Double)

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

#define RHOLM_CIRCLE_DISPATCH(T, Name)                                                             \
  HWY_EXPORT(Gather##Name);                                                                        \
  HWY_EXPORT(Scatter##Name);                                                                       \
  HWY_EXPORT(Multiply##Name);                                                                      \
  HWY_EXPORT(Split##Name);                                                                         \
  HWY_EXPORT(Join##Name);                                                                          \
  template <>                                                                                      \
  void gather_circles(const GridLayout& layout, const T* rows, T* const* circles) {                \
    HWY_DYNAMIC_DISPATCH(Gather##Name)(layout, rows, circles);                                     \
  }                                                                                                \
  template <>                                                                                      \
  void scatter_circles(const GridLayout& layout, const T* const* circles, T* rows) {               \
    HWY_DYNAMIC_DISPATCH(Scatter##Name)(layout, circles, rows);                                    \
  }                                                                                                \
  template <>                                                                                      \
  void multiply(const Factors<T>& factors, const T* in, T* out) {                                  \
    HWY_DYNAMIC_DISPATCH(Multiply##Name)(factors, in, out);                                        \
  }                                                                                                \
  template <>                                                                                      \
  void split_circle(const T* circle, std::size_t n, const RingParts& even, const RingParts& odd) { \
    HWY_DYNAMIC_DISPATCH(Split##Name)(circle, n, even, odd);                                       \
  }                                                                                                \
  template <>                                                                                      \
  void join_circle(const RingParts& even, const RingParts& odd, std::size_t n, T* circle) {        \
    HWY_DYNAMIC_DISPATCH(Join##Name)(even, odd, n, circle);                                        \
  }
RHOLM_CIRCLE_DISPATCH(float, Float)
RHOLM_CIRCLE_DISPATCH(double, Double)

}  // namespace rholm
#endif  // HWY_ONCE
