// Hashes of corners and half-edges, which show in the pass whether a surface is closed, and name
// edges. Inner loops of block.cpp, compiled for each target.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "transform/mesh_pass/block/block.h"

#if defined(RHOLM_TRANSFORM_EDGE_HASH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_TRANSFORM_EDGE_HASH_INL_H_
#undef RHOLM_TRANSFORM_EDGE_HASH_INL_H_
#else
#define RHOLM_TRANSFORM_EDGE_HASH_INL_H_
#endif

#include <hwy/highway.h>

#include "shape/queries/corner_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Returns the 32 bits of a float. For a double, returns the bits of the same number as a float, if
// there is one: the last 29 bits, which a float does not have, are mixed in. Exponents differ by
// 896. Minus zero counts as zero.
constexpr uint64_t kExponents = uint64_t{896} << 23, kLastBits = (uint64_t{1} << 29) - 1;
constexpr uint32_t kLastFactor = 0x27D4EB2FU;
HWY_INLINE hn::Vec<hn::RebindToUnsigned<DF>> words_of(hn::Vec<DF> v) {
  return hn::BitCast(hn::RebindToUnsigned<DF>(), hn::Add(v, hn::Zero(DF())));
}
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE hn::Vec<hn::Rebind<uint32_t, D>> words_of(D, V v) {
  const double clean = hn::GetLane(v) + 0.0;
  uint64_t bits;
  std::memcpy(&bits, &clean, sizeof bits);
  const uint64_t top = clean == 0 ? 0 : (bits >> 29) - kExponents + (bits >> 63 << 31);
  return hn::Set(hn::Rebind<uint32_t, D>(),
                 static_cast<uint32_t>(top + (bits & kLastBits) * kLastFactor));
}
#else
HWY_INLINE hn::Vec<hn::Rebind<uint32_t, D>> words_of(D d, V v) {
  const hn::Repartition<uint32_t, D> du;
  const hn::RebindToUnsigned<D> d64;
  const auto bits = hn::BitCast(d64, hn::Add(v, hn::Zero(d)));
  const auto sign = hn::And(hn::ShiftRight<32>(bits), hn::Set(d64, 0x80000000U));
  const auto top = hn::Add(hn::Sub(hn::ShiftRight<29>(bits), hn::Set(d64, kExponents)), sign);
  const auto last = hn::BitCast(du, hn::And(bits, hn::Set(d64, kLastBits)));
  const auto zero = hn::RebindMask(d64, hn::Eq(v, hn::Zero(d)));
  return hn::TruncateTo(
      hn::Rebind<uint32_t, D>(),
      hn::Add(hn::IfThenZeroElse(zero, top), hn::MulEven(last, hn::Set(du, kLastFactor))));
}
#endif

// Combines three words (multiplicative hashing, Knuth; the constants are odd random numbers).
template <class DU, class U = hn::Vec<DU>>
HWY_INLINE void store_hash(DU d, U x, U y, U z, uint32_t* to) {
  const auto times = [&](U a, uint32_t factor) HWY_ATTR { return hn::Mul(a, hn::Set(d, factor)); };
  // The words are rotated differently, because round numbers end with zeros.
  U h = hn::Add(times(x, 0x9E3779B1U), hn::Add(hn::RotateRight<16>(times(y, 0x85EBCA77U)),
                                               hn::RotateRight<24>(times(z, 0xC2B2AE3DU))));
  h = times(hn::Xor(h, hn::ShiftRight<15>(h)), 0x2C1B3C6DU);
  hn::StoreU(hn::Xor(h, hn::ShiftRight<13>(h)), d, to);
}

// Adds sums over half-edges, and marks the half-edges of the sample; 32-bit lanes.
template <typename T>
HWY_INLINE void add_hashes(size_t n, uint32_t sampled_names, TriangleBlock<T>& block,
                           BlockSums& sums) {
  const hn::CappedTag<uint32_t, 16> d;
  using U = hn::Vec<decltype(d)>;
  constexpr size_t kLanes = hn::MaxLanes(hn::CappedTag<uint32_t, 16>());
  U sum1 = hn::Zero(d), sum2 = hn::Zero(d);
  std::memset(block.sampled, 0, sizeof block.sampled);
  for (size_t at = 0; at < n; at += kLanes) {
    const auto inside = hn::FirstN(d, n - at);
    const U h[3] = {hn::Load(d, block.hash[0] + at), hn::Load(d, block.hash[1] + at),
                    hn::Load(d, block.hash[2] + at)};
    for (int i = 0; i < 3; ++i) {
      const U a = h[i], b = h[i == 2 ? 0 : i + 1];
      const U product = hn::Mul(a, b);
      const U odd = hn::Mul(product, hn::Sub(a, b));
      sum1 = hn::Add(sum1, hn::IfThenElseZero(inside, odd));
      sum2 = hn::Add(sum2, hn::IfThenElseZero(inside, hn::Mul(odd, product)));
      const auto sampled = hn::And(inside, hn::Lt(product, hn::Set(d, sampled_names)));
      if (HWY_LIKELY(hn::AllFalse(d, sampled))) continue;
      uint8_t bits[8] = {};
      hn::StoreMaskBits(d, sampled, bits);
      for (size_t k = 0; k < kLanes; k += 8) {
        uint8_t& byte = block.sampled[i][(at + k) / 8];
        byte = static_cast<uint8_t>(byte | bits[k / 8] << at % 8);
      }
    }
  }
  // Sums modulo 2^32, lane by lane: GCC's own sum of lanes is for signed integers.
  alignas(64) uint32_t lanes1[kLanes], lanes2[kLanes];
  hn::Store(sum1, d, lanes1);
  hn::Store(sum2, d, lanes2);
  for (size_t i = 0; i < kLanes; ++i) {
    sums.hash1 += lanes1[i];
    sums.hash2 += lanes2[i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif  // include guard, for each target
