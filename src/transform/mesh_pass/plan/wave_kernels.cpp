#include "transform/mesh_pass/plan/wave_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_pass/plan/wave_kernels.cpp"
#include <hwy/foreach_target.h>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void WaveValues(const Vec3& k, std::size_t n, const double* x, const double* y, const double* z,
                double* cosine, double* sine) {
  const hn::CappedTag<double, 8> d;
  const auto dot = [&](auto ax, auto ay, auto az, auto bx, auto by, auto bz)
                       HWY_ATTR { return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz))); };
  const auto kx = hn::Set(d, k.x), ky = hn::Set(d, k.y), kz = hn::Set(d, k.z);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const auto px = hn::LoadU(d, x + i), py = hn::LoadU(d, y + i), pz = hn::LoadU(d, z + i);
    const auto r = hn::Sqrt(dot(px, py, pz, px, py, pz));
    const auto phase = hn::Div(dot(kx, ky, kz, px, py, pz), r);
    hn::StoreU(hn::Cos(d, phase), d, cosine + i);
    hn::StoreU(hn::Sin(d, phase), d, sine + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(WaveValues);

void wave_values(const Vec3& k, std::size_t n, const double* x, const double* y, const double* z,
                 double* cosine, double* sine) {
  HWY_DYNAMIC_DISPATCH(WaveValues)(k, n, x, y, z, cosine, sine);
}

}  // namespace rholm
#endif  // HWY_ONCE
