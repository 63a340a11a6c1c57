#include "shape/points/gauss_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/points/gauss_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kGaussLanes>;
using V = hn::Vec<D>;

struct Offset {
  V x, y, z, square;
};

HWY_INLINE Offset OffsetOf(D d, const GaussSources& s, std::size_t i, const V (&at)[3]) {
  Offset r;
  r.x = hn::Sub(hn::LoadU(d, s.x + i), at[0]);
  r.y = hn::Sub(hn::LoadU(d, s.y + i), at[1]);
  r.z = hn::Sub(hn::LoadU(d, s.z + i), at[2]);
  r.square = hn::MulAdd(r.x, r.x, hn::MulAdd(r.y, r.y, hn::Mul(r.z, r.z)));
  return r;
}

// The three components of a vector sum.
struct Sum3 {
  V x, y, z;
  explicit Sum3(D d) : x(hn::Zero(d)), y(hn::Zero(d)), z(hn::Zero(d)) {}
  HWY_INLINE void Store(D d, float out[3]) const {
    out[0] = hn::GetLane(hn::SumOfLanes(d, x));
    out[1] = hn::GetLane(hn::SumOfLanes(d, y));
    out[2] = hn::GetLane(hn::SumOfLanes(d, z));
  }
};

HWY_INLINE V Product(D d, const GaussSources& s, std::size_t i, const Offset& r) {
  return hn::MulAdd(
      r.x, hn::LoadU(d, s.a[0] + i),
      hn::MulAdd(r.y, hn::LoadU(d, s.a[1] + i), hn::Mul(r.z, hn::LoadU(d, s.a[2] + i))));
}

HWY_INLINE V InverseCube(D d, V square) {
  return hn::Div(hn::Set(d, 1.0f), hn::Mul(square, hn::Sqrt(square)));
}

float Value(const GaussSources& s, const float place[3]) {
  const D d;
  const V at[3] = {hn::Set(d, place[0]), hn::Set(d, place[1]), hn::Set(d, place[2])};
  V sum = hn::Zero(d);
  for (std::size_t i = 0; i < s.n; i += hn::Lanes(d)) {
    const Offset r = OffsetOf(d, s, i, at);
    const V square = hn::Max(r.square, hn::LoadU(d, s.width2 + i));
    sum = hn::MulAdd(Product(d, s, i, r), InverseCube(d, square), sum);
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

void Adjoint(const GaussSources& s, const float place[3], float width2, float out[3]) {
  const D d;
  const V at[3] = {hn::Set(d, place[0]), hn::Set(d, place[1]), hn::Set(d, place[2])};
  const V least = hn::Set(d, width2);
  Sum3 sum(d);
  for (std::size_t i = 0; i < s.n; i += hn::Lanes(d)) {
    const Offset r = OffsetOf(d, s, i, at);
    const V factor = hn::Mul(hn::LoadU(d, s.a[0] + i), InverseCube(d, hn::Max(r.square, least)));
    sum.x = hn::MulAdd(factor, r.x, sum.x);
    sum.y = hn::MulAdd(factor, r.y, sum.y);
    sum.z = hn::MulAdd(factor, r.z, sum.z);
  }
  sum.Store(d, out);
}

void Fall(const GaussSources& s, const float place[3], float width2, float out[3]) {
  const D d;
  const V at[3] = {hn::Set(d, place[0]), hn::Set(d, place[1]), hn::Set(d, place[2])};
  const V least = hn::Set(d, width2);
  Sum3 sum(d);
  for (std::size_t i = 0; i < s.n; i += hn::Lanes(d)) {
    const Offset r = OffsetOf(d, s, i, at);
    const V square = hn::Max(r.square, least);
    const V cube = InverseCube(d, square);
    const V along = hn::IfThenElseZero(
        hn::Ge(r.square, least),
        hn::Div(hn::Mul(hn::Set(d, -3.0f), hn::Mul(Product(d, s, i, r), cube)), square));
    sum.x = hn::Add(sum.x, hn::MulAdd(hn::LoadU(d, s.a[0] + i), cube, hn::Mul(along, r.x)));
    sum.y = hn::Add(sum.y, hn::MulAdd(hn::LoadU(d, s.a[1] + i), cube, hn::Mul(along, r.y)));
    sum.z = hn::Add(sum.z, hn::MulAdd(hn::LoadU(d, s.a[2] + i), cube, hn::Mul(along, r.z)));
  }
  sum.Store(d, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Value);
HWY_EXPORT(Adjoint);
HWY_EXPORT(Fall);

float gauss_value(const GaussSources& sources, const float place[3]) {
  return HWY_DYNAMIC_DISPATCH(Value)(sources, place);
}
void gauss_adjoint(const GaussSources& sources, const float place[3], float width2, float sum[3]) {
  HWY_DYNAMIC_DISPATCH(Adjoint)(sources, place, width2, sum);
}
void gauss_fall(const GaussSources& sources, const float place[3], float width2, float sum[3]) {
  HWY_DYNAMIC_DISPATCH(Fall)(sources, place, width2, sum);
}

}  // namespace rholm
#endif  // HWY_ONCE
