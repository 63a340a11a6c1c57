#include "shape/queries/closest_kernels.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/queries/closest_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kTreeWidth>;
using V = hn::Vec<D>;

// Squares of lengths below this lose bits.
constexpr float kLeastSquare = 1e-30F;

struct Vector3 {
  V x, y, z;
};
HWY_INLINE Vector3 Load3(D d, const TreeRows3& rows, std::size_t k) {
  return {hn::Load(d, &rows[0][k]), hn::Load(d, &rows[1][k]), hn::Load(d, &rows[2][k])};
}
HWY_INLINE void Store3(D d, const Vector3& v, TreeRows3& rows, std::size_t k) {
  hn::Store(v.x, d, &rows[0][k]);
  hn::Store(v.y, d, &rows[1][k]);
  hn::Store(v.z, d, &rows[2][k]);
}
HWY_INLINE Vector3 Minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 Times(V s, const Vector3& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE V Dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
// Returns a vector of unit length, or 0 where the square is not above `least`.
HWY_INLINE Vector3 Unit(D d, const Vector3& a, V least) {
  const V square = Dot(a, a);
  const V inverse = hn::Div(hn::Set(d, 1.0F), hn::Sqrt(square));
  return Times(hn::IfThenElseZero(hn::Gt(square, least), inverse), a);
}
HWY_INLINE V Max3(V a, V b, V c) { return hn::Max(a, hn::Max(b, c)); }

void SetPlanes(const std::array<TreeRows3, 3>& corners, PlaneGroup& planes) {
  const D d;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const Vector3 q[3] = {Load3(d, corners[0], k), Load3(d, corners[1], k),
                          Load3(d, corners[2], k)};
    const Vector3 edges[3] = {Minus(q[1], q[0]), Minus(q[2], q[1]), Minus(q[0], q[2])};
    const Vector3 normal = Unit(d, Cross(edges[0], edges[1]), hn::Set(d, kLeastSquare));
    const V along[3] = {Dot(normal, q[0]), Dot(normal, q[1]), Dot(normal, q[2])};
    Store3(d, normal, planes.normal, k);
    hn::Store(hn::Min(along[0], hn::Min(along[1], along[2])), d, &planes.low[k]);
    hn::Store(Max3(along[0], along[1], along[2]), d, &planes.high[k]);
    for (int side = 0; side < 3; ++side) {
      // A sliver's normal may be parallel to its edge; then the cross product is not orthogonal.
      const V square = Dot(edges[side], edges[side]);
      const V least = hn::Max(hn::Mul(hn::Set(d, 0.9F), square), hn::Set(d, kLeastSquare));
      const Vector3 out = Unit(d, Cross(edges[side], normal), least);
      Store3(d, out, planes.side[side], k);
      hn::Store(Max3(Dot(out, q[0]), Dot(out, q[1]), Dot(out, q[2])), d, &planes.limit[side][k]);
    }
  }
}

// Squared distances to eight boxes or triangles; `bits` marks the near ones.
struct Near {
  alignas(32) TreeRow squares;
  unsigned bits = 0;
};

HWY_INLINE void Note(D d, V square, float least, std::size_t k, Near& near) {
  hn::Store(square, d, &near.squares[k]);
  std::array<std::uint8_t, 8> bits = {};  // as many bytes as Highway requires
  hn::StoreMaskBits(d, hn::Le(square, hn::Set(d, least)), bits.data());
  near.bits |= static_cast<unsigned>(bits[0]) << k;
}

HWY_INLINE Near NearBoxes(const BoxGroup& boxes, const std::array<float, 3>& point, float square) {
  const D d;
  Near near;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    V sum = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const V x = hn::Set(d, point[axis]);
      const V gap = Max3(hn::Sub(hn::Load(d, &boxes.low[axis][k]), x),
                         hn::Sub(x, hn::Load(d, &boxes.high[axis][k])), hn::Zero(d));
      sum = hn::MulAdd(gap, gap, sum);
    }
    Note(d, sum, square, k, near);
  }
  return near;
}

HWY_INLINE Near NearTriangles(const PlaneGroup& planes, const std::array<float, 3>& point,
                              float square) {
  const D d;
  const Vector3 p = {hn::Set(d, point[0]), hn::Set(d, point[1]), hn::Set(d, point[2])};
  Near near;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const V along = Dot(Load3(d, planes.normal, k), p);
    const V above = Max3(hn::Sub(along, hn::Load(d, &planes.high[k])),
                         hn::Sub(hn::Load(d, &planes.low[k]), along), hn::Zero(d));
    V beside = hn::Zero(d);
    for (int side = 0; side < 3; ++side) {
      beside = hn::Max(beside, hn::Sub(Dot(Load3(d, planes.side[side], k), p),
                                       hn::Load(d, &planes.limit[side][k])));
    }
    Note(d, hn::MulAdd(above, above, hn::Mul(beside, beside)), square, k, near);
  }
  return near;
}

// Packs a node with its squared distance >= 0, so that numbers are ordered by distance.
HWY_INLINE std::uint64_t Waiting(float square, std::size_t node) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(square)} << 32 | node;
}

HWY_INLINE unsigned NearestOf(const Near& near) {
  unsigned nearest = std::countr_zero(near.bits);
  for (unsigned rest = near.bits; rest != 0; rest &= rest - 1) {
    const unsigned k = std::countr_zero(rest);
    if (near.squares[k] < near.squares[nearest]) nearest = k;
  }
  return nearest;
}

void WalkNear(const TriangleTreeNodes& tree, const std::array<float, 3>& point, float radius,
              TryTriangle try_triangle, void* search) {
  const auto squared = [](float r) { return std::min(r * r, std::numeric_limits<float>::max()); };
  constexpr std::size_t kMostLevels = 11;  // 8^11 = 2^33 triangles
  std::array<std::uint64_t, kMostLevels * kTreeWidth> stack;
  std::size_t n = 0;
  float square = squared(radius);
  const std::size_t leaves = tree.leaves.size();
  stack[n++] = Waiting(0, leaves + tree.inner.size() - 1);
  while (n > 0) {
    const std::uint64_t at = stack[--n];
    const auto node = static_cast<std::uint32_t>(at);
    if (at > Waiting(square, 0xFFFFFFFFU)) continue;
    if (node < leaves) {
      Near near = NearTriangles(tree.leaves[node], point, square);
      while (near.bits != 0) {
        const unsigned k = NearestOf(near);
        if (near.squares[k] > square) break;
        near.bits &= ~(1U << k);
        square = squared(try_triangle(search, node, k));
      }
      continue;
    }
    const BoxGroup& group = tree.inner[node - leaves];
    const Near near = NearBoxes(group, point, square);
    const std::size_t first = n;
    for (unsigned rest = near.bits; rest != 0; rest &= rest - 1) {  // the nearest on top
      const unsigned k = std::countr_zero(rest);
      const std::uint64_t child = Waiting(near.squares[k], group.first + k);
      std::size_t i = n++;
      for (; i > first && stack[i - 1] < child; --i) stack[i] = stack[i - 1];
      stack[i] = child;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SetPlanes);
HWY_EXPORT(WalkNear);

void set_planes(const std::array<TreeRows3, 3>& corners, PlaneGroup& planes) {
  HWY_DYNAMIC_DISPATCH(SetPlanes)(corners, planes);
}

void walk_near(const TriangleTreeNodes& tree, const std::array<float, 3>& point, float radius,
               TryTriangle try_triangle, void* search) {
  HWY_DYNAMIC_DISPATCH(WalkNear)(tree, point, radius, try_triangle, search);
}

}  // namespace rholm
#endif  // HWY_ONCE
