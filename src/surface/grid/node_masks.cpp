#include "surface/grid/node_masks.h"

#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surface/grid/node_masks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;

HWY_INLINE std::uint64_t BitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | std::uint64_t{bytes[1]} << 8;
}

void MasksOf(const float* HWY_RESTRICT values, std::size_t n_blocks, NodeMasks* masks) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);  // a divisor of 64
  for (std::size_t b = 0; b < n_blocks; ++b) {
    for (std::size_t z = 0; z < 8; ++z, values += 64) {
      std::uint64_t known = 0;
      std::uint64_t inside = 0;
      for (std::size_t i = 0; i < 64; i += lanes) {
        const auto v = hn::LoadU(d, values + i);
        const auto finite = hn::IsFinite(v);
        known |= BitsOf(d, finite) << i;
        inside |= BitsOf(d, hn::And(finite, hn::Lt(v, hn::Zero(d)))) << i;
      }
      masks[b].known[z] = known;
      masks[b].inside[z] = inside;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(MasksOf);

void node_masks(const float* values, std::size_t n_blocks, NodeMasks* masks) {
  HWY_DYNAMIC_DISPATCH(MasksOf)(values, n_blocks, masks);
}

}  // namespace rholm
#endif  // HWY_ONCE
