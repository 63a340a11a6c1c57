#include "transform/error/corner_bounds.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/error/corner_bounds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shape/queries/triangle_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using M = hn::Mask<D>;

// For edges of at most this angle, each point of a face is within 0.6 of the longest edge from a
// corner (0.58 for three equal edges).
constexpr double kMostAngle = 0.5, kNearestCorner = 0.6;

template <class T>
void BoundsOf(const MeshView& mesh, std::size_t begin, std::size_t end, const Vec3& center,
              double scale, double model_bend, double* bounds) {
  const D d;
  const V unit = hn::Set(d, scale), one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const V infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const Vector3 shift = Same(d, scale * center);
  // Seen from the centre, an edge e has an angle of at most 2 asin(e / 2 nearest) < 1.02 e /
  // nearest.
  const V length2 = hn::Set(d, 1.02 * 1.02), most2 = hn::Set(d, kMostAngle * kMostAngle);
  const V part = hn::Set(d, kNearestCorner * kNearestCorner / 2), bend = hn::Set(d, model_bend);
  const auto local = [&](const Vector3& raw) HWY_ATTR -> Vector3 {
    return {hn::MulSub(raw.x, unit, shift.x), hn::MulSub(raw.y, unit, shift.y),
            hn::MulSub(raw.z, unit, shift.z)};
  };
  const auto most = [&](V x, V y, V z) HWY_ATTR { return hn::Max(x, hn::Max(y, z)); };
  ForVectors<T>(
      mesh, begin, end,
      [&](const Vector3& raw0, const Vector3& raw1, const Vector3& raw2, std::size_t at,
          std::size_t n) HWY_ATTR {
        const Vector3 a = local(raw0), b = local(raw1), c = local(raw2);
        const Vector3 ab = Minus(b, a), bc = Minus(c, b), ca = Minus(a, c), normal = Cross(ab, bc);
        const V nn = Dot(normal, normal), height = Dot(normal, a);
        const V edge2 = most(Dot(ab, ab), Dot(bc, bc), Dot(ca, ca));
        const V ra = Dot(a, a), rb = Dot(b, b), rc = Dot(c, c);
        const V farthest2 = most(ra, rb, rc), nearest2 = hn::Min(ra, hn::Min(rb, rc));
        const V angle2 = hn::Div(hn::Mul(length2, edge2), nearest2);
        // Shorter normals are mostly rounding error.
        const M clear = hn::Gt(nn, hn::Mul(hn::Set(d, 0x1p-80), hn::Mul(farthest2, edge2)));
        const M seen = hn::And(hn::And(clear, hn::Gt(height, zero)), hn::Le(angle2, most2));
        // This is r (2 / c^2 - 1) at the farthest corner, where the cosine c is least: c^2 r^2
        // |n|^2 = h^2.
        const V over_c2 =
            hn::Div(hn::Mul(nn, farthest2), hn::IfThenElse(seen, hn::Mul(height, height), one));
        const V face = hn::Mul(hn::Sqrt(farthest2), hn::Sub(hn::Add(over_c2, over_c2), one));
        const V bound = hn::Mul(hn::Mul(part, angle2), hn::Add(face, bend));
        alignas(64) double lanes[hn::MaxLanes(D())];
        hn::Store(hn::IfThenElse(seen, bound, infinity), d, lanes);
        std::copy(lanes, lanes + n, bounds + (at - begin));
      });
}

void Bounds(const MeshView& mesh, std::size_t begin, std::size_t end, const Vec3& center,
            double scale, double model_bend, double* bounds) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    return BoundsOf<float>(mesh, begin, end, center, scale, model_bend, bounds);
  }
  BoundsOf<double>(mesh, begin, end, center, scale, model_bend, bounds);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Bounds);

void corner_bounds(const MeshView& mesh, std::size_t begin, std::size_t end, const Vec3& center,
                   double scale, double model_bend, double* bounds) {
  HWY_DYNAMIC_DISPATCH(Bounds)(mesh, begin, end, center, scale, model_bend, bounds);
}

}  // namespace rholm
#endif  // HWY_ONCE
