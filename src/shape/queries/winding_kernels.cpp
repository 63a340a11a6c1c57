#include "shape/queries/winding_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/queries/winding_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

struct Vector3 {
  V x, y, z;
};
HWY_INLINE Vector3 FromTo(D d, const Vector3& from, const Vec3& to) {
  return {hn::Sub(hn::Set(d, to.x), from.x), hn::Sub(hn::Set(d, to.y), from.y),
          hn::Sub(hn::Set(d, to.z), from.z)};
}
HWY_INLINE V Dot(D d, const Vector3& a, const Vec3& b) {
  return hn::MulAdd(a.x, hn::Set(d, b.x),
                    hn::MulAdd(a.y, hn::Set(d, b.y), hn::Mul(a.z, hn::Set(d, b.z))));
}
HWY_INLINE V Square(const Vector3& a) {
  return hn::MulAdd(a.x, a.x, hn::MulAdd(a.y, a.y, hn::Mul(a.z, a.z)));
}

HWY_INLINE V Near(D d, const WindingPoint& point, const Vector3& x) {
  const Vector3 r = FromTo(d, x, point.at);
  const V square = hn::Max(Square(r), hn::Set(d, point.least2));
  return hn::Div(Dot(d, r, point.area_normal), hn::Mul(square, hn::Sqrt(square)));
}

// The field of a dipole is a . F(r), F(r) = r / |r|^3 = -grad 1/|r|.
// Taylor's series of sum a . F(r + o), with r = center - x, R = |r| and the forms p, q of the node:
//   a . r / R^3   +   tr p / R^3 - 3 p(r) / R^5   +   15/2 q(r) / R^7 - 3/4 (laplacian q)(r) / R^5.
// The second derivatives of 1/|r| are 3 r r / R^5 - 1 / R^3. On a symmetric form, the third ones
// are -15 q(r) / R^7 + 9/6 (laplacian q)(r) / R^5.
HWY_INLINE V Far(D d, const WindingNode& node, const Vector3& r, V square) {
  const V inverse = hn::Div(hn::Set(d, 1.0), square);
  const auto& p = node.first;
  const V px = Dot(d, r, {p[0], p[3], p[4]});
  const V py = hn::MulAdd(r.y, hn::Set(d, p[1]), hn::Mul(r.z, hn::Set(d, p[5])));
  const V first =
      hn::MulAdd(r.x, px, hn::MulAdd(r.y, py, hn::Mul(hn::Mul(r.z, r.z), hn::Set(d, p[2]))));
  const auto& q = node.second;
  const V qx = Dot(d, r, {q[0], q[3], q[4]});  // xx (..)
  const V qy = Dot(d, r, {q[5], q[1], q[6]});  // yy (..)
  const V qz = Dot(d, r, {q[7], q[8], q[2]});  // zz (..)
  const V mixed = hn::Mul(hn::Mul(r.x, r.y), hn::Mul(r.z, hn::Set(d, q[9])));
  const V second =
      hn::MulAdd(hn::Mul(r.x, r.x), qx,
                 hn::MulAdd(hn::Mul(r.y, r.y), qy, hn::MulAdd(hn::Mul(r.z, r.z), qz, mixed)));
  // Evaluates by Horner's rule in 1 / R^2.
  const V fifth =
      hn::MulAdd(hn::Mul(hn::Set(d, 7.5), inverse), second,
                 hn::NegMulAdd(hn::Set(d, 3.0), first,
                               hn::Mul(hn::Set(d, -0.75), Dot(d, r, node.second_laplacian))));
  const V third = hn::Add(Dot(d, r, node.area_normal), hn::Set(d, p[0] + p[1] + p[2]));
  return hn::Mul(hn::MulAdd(fifth, inverse, third), hn::Mul(inverse, hn::Sqrt(inverse)));
}

// Queries of one vector walk through the tree together. A lane that sees a node from far enough
// skips all nodes below it, and waits until the walk has passed them. So a query's result does not
// depend on the other lanes.
HWY_INLINE V Walk(D d, std::span<const WindingNode> nodes, std::span<const WindingPoint> points,
                  const Vector3& x, double opening) {
  V sum = hn::Zero(d);
  V resume = hn::Zero(d);  // node at which a lane continues
  for (std::size_t i = 0; i < nodes.size();) {
    const WindingNode& node = nodes[i];
    const Vector3 r = FromTo(d, x, node.center);
    const V square = Square(r);
    const double least = opening * node.radius;
    const auto active = hn::Le(resume, hn::Set(d, static_cast<double>(i)));
    const auto far = hn::And(active, hn::Gt(square, hn::Set(d, least * least)));
    const auto near = hn::AndNot(far, active);
    if (!hn::AllFalse(d, far)) {
      sum = hn::Add(sum, hn::IfThenElseZero(far, Far(d, node, r, square)));
      resume = hn::IfThenElse(far, hn::Set(d, static_cast<double>(node.skip)), resume);
    }
    if (node.leaf && !hn::AllFalse(d, near)) {
      V terms = hn::Zero(d);
      for (std::size_t j = node.begin; j < node.end; ++j)
        terms = hn::Add(terms, Near(d, points[j], x));
      sum = hn::Add(sum, hn::IfThenElseZero(near, terms));
    }
    i = node.leaf || hn::AllFalse(d, near) ? node.skip : i + 1;
  }
  return sum;
}

void SumAll(std::span<const WindingNode> nodes, std::span<const WindingPoint> points,
            std::span<const Vec3> x, double opening, double* sums) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  alignas(64) double rows[4][hn::MaxLanes(d)];
  for (std::size_t first = 0; first < x.size(); first += lanes) {
    const std::size_t n = std::min(lanes, x.size() - first);
    for (std::size_t i = 0; i < lanes; ++i) {
      const Vec3& at = x[first + std::min(i, n - 1)];
      rows[0][i] = at.x;
      rows[1][i] = at.y;
      rows[2][i] = at.z;
    }
    const Vector3 here = {hn::Load(d, rows[0]), hn::Load(d, rows[1]), hn::Load(d, rows[2])};
    hn::Store(Walk(d, nodes, points, here, opening), d, rows[3]);
    std::copy(rows[3], rows[3] + n, sums + first);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SumAll);

void sum_winding(std::span<const WindingNode> nodes, std::span<const WindingPoint> points,
                 std::span<const Vec3> x, double opening, double* sums) {
  HWY_DYNAMIC_DISPATCH(SumAll)(nodes, points, x, opening, sums);
}

}  // namespace rholm
#endif  // HWY_ONCE
