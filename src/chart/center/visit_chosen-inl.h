// Visits the triangles of a vector that a mask chooses. For inner loops; included once for every
// kind of processor (Highway).
#if defined(RHOLM_CHART_VISIT_CHOSEN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_CHART_VISIT_CHOSEN_INL_H_
#undef RHOLM_CHART_VISIT_CHOSEN_INL_H_
#else
#define RHOLM_CHART_VISIT_CHOSEN_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "chart/center/local_view.h"
#include "shape/queries/triangle_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using M = hn::Mask<D>;

// Visits the chosen triangles among t ... t + n - 1, which form one vector.
inline HWY_NOINLINE void VisitChosen(D d, M chosen, std::size_t t, std::size_t n,
                                     const VisitTriangle& visit) {
  alignas(64) double flags[hn::MaxLanes(d)];
  hn::Store(hn::IfThenElseZero(chosen, hn::Set(d, 1.0)), d, flags);
  for (std::size_t i = 0; i < n; ++i) {
    if (flags[i] > 0) visit(t + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif
