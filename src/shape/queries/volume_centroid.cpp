#include <array>
#include <vector>

#include "base/parallel.h"
#include "shape/measure.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/queries/volume_centroid.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shape/queries/triangle_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Sums over tetrahedra with the frame's middle as apex: six times the volumes, then the moduli of
// these. Then x, y, z of each volume times the sum of its three corners.
using Sums = std::array<double, 5>;

template <class T>
void SumSolidOf(const MeshView& mesh, const UnitFrame& frame, std::size_t begin, std::size_t end,
                Sums& sums) {
  const D d;
  const V scale = hn::Set(d, frame.scale);
  const Vector3 middle = Same(d, frame.center);
  V volumes = hn::Zero(d), moduli = volumes;
  Vector3 moment = {volumes, volumes, volumes};
  const auto local = [&](const Vector3& raw) HWY_ATTR -> Vector3 {
    return {hn::MulSub(raw.x, scale, middle.x), hn::MulSub(raw.y, scale, middle.y),
            hn::MulSub(raw.z, scale, middle.z)};
  };
  ForVectors<T>(mesh, begin, end,
                [&](const Vector3& raw0, const Vector3& raw1, const Vector3& raw2, std::size_t,
                    std::size_t n) HWY_ATTR {
                  const Vector3 a = local(raw0), b = local(raw1), c = local(raw2);
                  V volume = Dot(Cross(Minus(b, a), Minus(c, a)), a);
                  if (n < hn::Lanes(d)) volume = hn::IfThenElseZero(hn::FirstN(d, n), volume);
                  volumes = hn::Add(volumes, volume);
                  moduli = hn::Add(moduli, hn::Abs(volume));
                  moment = {hn::MulAdd(volume, hn::Add(a.x, hn::Add(b.x, c.x)), moment.x),
                            hn::MulAdd(volume, hn::Add(a.y, hn::Add(b.y, c.y)), moment.y),
                            hn::MulAdd(volume, hn::Add(a.z, hn::Add(b.z, c.z)), moment.z)};
                });
  const auto whole = [&](V sum) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, sum)); };
  sums = {whole(volumes), whole(moduli), whole(moment.x), whole(moment.y), whole(moment.z)};
}

void SumSolid(const MeshView& mesh, const UnitFrame& frame, std::size_t begin, std::size_t end,
              Sums& sums) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    return SumSolidOf<float>(mesh, frame, begin, end, sums);
  }
  SumSolidOf<double>(mesh, frame, begin, end, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SumSolid);

Vec3 volume_centroid(const MeshView& mesh, const UnitFrame& frame, const Context& context) {
  constexpr std::size_t kGrain = 8192;  // chosen: some 50 us
  std::vector<std::array<double, 5>> parts((mesh.n_faces + kGrain - 1) / kGrain);
  parallel_for(mesh.n_faces, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(SumSolid)(mesh, frame, begin, end, parts[begin / kGrain]);
  });
  double volumes = 0, moduli = 0;
  Vec3 moment;
  for (const auto& [volume, modulus, x, y, z] : parts) {
    volumes += volume, moduli += modulus;
    moment += Vec3{x, y, z};
  }
  // The centroid of a tetrahedron is a quarter of the sum of its corners.
  if (!has_volume(volumes, moduli)) return frame.to_shape({});
  return frame.to_shape(moment / (4 * volumes));
}

}  // namespace rholm
#endif  // HWY_ONCE
