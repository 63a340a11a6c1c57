#include "transform/mesh_block.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_block.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "shape/corner_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using M = hn::Mask<D>;
using V3 = Vector3;

HWY_INLINE V3 sub(const V3& a, const V3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V dot(const V3& a, const V3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
struct LaneSums {
  V volume6, mean, face_error2, weight2, min_d2, min_cos2, max_edge2, probe;
};

// Weight and gradient in quanta.
struct Lump {
  V weight;
  V3 gradient;
};
HWY_INLINE Lump rounded(D d, V weight, const V3& gradient, const BlockParameters& p) {
  const V per = hn::Set(d, p.per_gradient);
  return {hn::Round(hn::Mul(weight, hn::Set(d, p.per_weight))),
          {hn::Round(hn::Mul(gradient.x, per)), hn::Round(hn::Mul(gradient.y, per)),
           hn::Round(hn::Mul(gradient.z, per))}};
}
// Weights and gradients of a triangle add up to nothing; rounded ones as well, for in a lattice the
// rounding of all triangles is the same and would add up.
HWY_INLINE Lump rest_of(const Lump& a, const Lump& b) {
  return {
      hn::Neg(hn::Add(a.weight, b.weight)),
      {hn::Neg(hn::Add(a.gradient.x, b.gradient.x)), hn::Neg(hn::Add(a.gradient.y, b.gradient.y)),
       hn::Neg(hn::Add(a.gradient.z, b.gradient.z))}};
}
template <typename T>
HWY_INLINE void store_lump(D d, const Lump& lump, VertexLump<T>* to) {
  const V3& g = lump.gradient;
  if constexpr (sizeof(T) == 4) {
    const hn::Rebind<int32_t, D> di;
    hn::StoreInterleaved4(hn::DemoteTo(di, lump.weight), hn::DemoteTo(di, g.x),
                          hn::DemoteTo(di, g.y), hn::DemoteTo(di, g.z), di, to->value);
  } else {
    hn::StoreInterleaved4(lump.weight, g.x, g.y, g.z, d, to->value);
  }
}

// One vector of triangles. Lanes at and beyond n repeat others and are left out of the sums.
template <typename T>
HWY_INLINE void work_vector(D d, size_t at, size_t n, const BlockParameters& parameters,
                            TriangleBlock<T>& b, LaneSums& sums, BlockSums& counts) {
  const auto corner = [&](int i) HWY_ATTR {
    return V3{hn::Load(d, b.corner[i][0] + at), hn::Load(d, b.corner[i][1] + at),
              hn::Load(d, b.corner[i][2] + at)};
  };
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V3 p0 = corner(0), p1 = corner(1), p2 = corner(2);
  const V3 e01 = sub(p1, p0), e12 = sub(p2, p1), e20 = sub(p0, p2);
  const V3 n3 = cross(e20, e01);
  const V3 c01 = cross(p0, p1), c12 = cross(p1, p2), c20 = cross(p2, p0);
  const V d2 = dot(n3, p0), nn = dot(n3, n3);
  const V r0 = dot(p0, p0), r1 = dot(p1, p1), r2 = dot(p2, p2);  // squares
  const V nearest = hn::Min(r0, hn::Min(r1, r2)), farthest = hn::Max(r0, hn::Max(r1, r2));
  const V l01 = dot(e01, e01), l12 = dot(e12, e12), l20 = dot(e20, e20);
  const V longest = hn::Max(l01, hn::Max(l12, l20));

  // 1 / d2, 1 / n^2 and 1 / r^2 by one division; where d2 or n vanish nothing of it is used.
  const V r01 = hn::Mul(r0, r1), r012 = hn::Mul(r01, r2);
  const V dn = hn::IfThenElse(hn::Eq(hn::Mul(d2, nn), zero), one, hn::Mul(d2, nn));
  const V inverse = hn::Div(one, hn::Mul(r012, dn));
  const V over_dn = hn::Mul(inverse, r012), over_r = hn::Mul(inverse, dn);
  const V over_d = hn::Mul(over_dn, nn), over_n = hn::Mul(over_dn, d2);
  const V q2 = hn::Mul(r01, over_r), q01 = hn::Mul(r2, over_r);
  const V q0 = hn::Mul(r1, q01), q1 = hn::Mul(r0, q01);
  const V over_near = hn::Max(q0, hn::Max(q1, q2));

  // Rounding of a normal: corners are exact to 2^-53 r, so n to about 2^-52 r |e|.
  const V blur2 = hn::Mul(hn::Set(d, 0x1p-90), hn::Mul(farthest, longest));
  const M unclear = hn::Not(hn::Gt(nn, blur2));
  // The terms of (M6) are large and cancel.
  const V dd = hn::Mul(d2, d2);
  const M grazing =
      hn::Not(hn::Gt(dd, hn::Mul(hn::Set(d, parameters.grazing2), hn::Mul(nn, nearest))));

  const V w01 = hn::Mul(dot(n3, c01), over_d), w12 = hn::Mul(dot(n3, c12), over_d);
  const V w20 = hn::Mul(dot(n3, c20), over_d), face = hn::Neg(hn::Mul(nn, over_d));

  // Error of lumping: z = L theta with a part for the bending of x/|x| along the edge; the same
  // seen from both sides of an edge.
  const V ll = hn::Set(d, parameters.degree * parameters.degree), bend = hn::Set(d, 16.0);
  const auto phase2 = [&](const V3& c, V length, V over) HWY_ATTR {
    return hn::MulAdd(hn::Mul(ll, dot(c, c)), hn::Mul(over, over),
                      hn::Mul(bend, hn::Mul(length, over)));
  };
  const V z01 = phase2(c01, l01, hn::Max(q0, q1)), z12 = phase2(c12, l12, hn::Max(q1, q2));
  const V z20 = phase2(c20, l20, hn::Max(q2, q0)), z = hn::Max(z01, hn::Max(z12, z20));
  const V f01 = hn::Mul(w01, hn::Mul(z01, z01)), f12 = hn::Mul(w12, hn::Mul(z12, z12));
  const V f20 = hn::Mul(w20, hn::Mul(z20, z20)), f = hn::Mul(face, hn::Mul(z, z));
  hn::Store(f01, d, b.edge_error[0] + at);
  hn::Store(f12, d, b.edge_error[1] + at);
  hn::Store(f20, d, b.edge_error[2] + at);
  hn::Store(f, d, b.face_error + at);
  const V error2 = hn::MulAdd(f01, f01, hn::MulAdd(f12, f12, hn::MulAdd(f20, f20, hn::Mul(f, f))));
  const V weight2 =
      hn::MulAdd(w01, w01, hn::MulAdd(w12, w12, hn::MulAdd(w20, w20, hn::Mul(face, face))));
  const V cap = hn::Set(d, parameters.largest / parameters.per_weight);
  const M refused = hn::Or(hn::Or(unclear, grazing),
                           hn::Or(hn::Not(hn::Le(error2, hn::Set(d, parameters.tolerance2))),
                                  hn::Gt(weight2, hn::Mul(cap, cap))));
  const V edge2 = hn::Mul(longest, over_near);
  const M coarse = hn::Or(unclear, hn::Not(hn::Le(edge2, hn::Set(d, parameters.mean_reach2))));

  // Lumps at the corners; e leaves corner i along both edges.
  const V half = hn::Set(d, 0.5), third = hn::Mul(face, hn::Set(d, 1.0 / 3));
  const V of_face = hn::Mul(face, hn::Set(d, 1.0 / 24)), twelfth = hn::Set(d, 1.0 / 12);
  const V g01 = hn::MulAdd(w01, twelfth, of_face), g12 = hn::MulAdd(w12, twelfth, of_face);
  const V g20 = hn::MulAdd(w20, twelfth, of_face);
  const auto lump = [&](V out, V in, V g_out, const V3& e_out, V g_in, const V3& e_in) HWY_ATTR {
    const V3 gradient = {hn::NegMulAdd(g_in, e_in.x, hn::Mul(g_out, e_out.x)),
                         hn::NegMulAdd(g_in, e_in.y, hn::Mul(g_out, e_out.y)),
                         hn::NegMulAdd(g_in, e_in.z, hn::Mul(g_out, e_out.z))};
    return rounded(d, hn::MulAdd(half, hn::Add(out, in), third), gradient, parameters);
  };
  const Lump lump0 = lump(w01, w20, g01, e01, g20, e20);
  const Lump lump1 = lump(w12, w01, g12, e12, g01, e01);
  store_lump(d, lump0, b.lump[0] + at);
  store_lump(d, lump1, b.lump[1] + at);
  store_lump(d, rest_of(lump0, lump1), b.lump[2] + at);
  hn::Store(error2, d, b.error2 + at);
  hn::Store(w01, d, b.edge_weight[0] + at);
  hn::Store(w12, d, b.edge_weight[1] + at);
  hn::Store(w20, d, b.edge_weight[2] + at);
  hn::Store(face, d, b.face_weight + at);

  // The mean of 1/|x|^2 over the face by the same rule; its derivative along e is -2 (p . e)/r^4.
  const V s01 = dot(p0, p1), s12 = dot(p1, p2), s20 = dot(p2, p0);
  const auto term = [&](V q, V s, V t, V r) HWY_ATTR {
    const V along = hn::Sub(hn::Add(s, t), hn::Add(r, r));  // p . (both edges)
    return hn::Mul(q, hn::NegMulAdd(hn::Mul(q, along), hn::Set(d, 1.0 / 12), hn::Set(d, 1.0 / 3)));
  };
  const V mean =
      hn::Add(term(q0, s01, s20, r0), hn::Add(term(q1, s12, s01, r1), term(q2, s20, s12, r2)));

  const M inside = hn::FirstN(d, n);
  const M lumped = hn::AndNot(refused, inside);
  const M seen = hn::AndNot(unclear, inside);
  sums.volume6 = hn::Add(sums.volume6, hn::IfThenElseZero(seen, d2));
  sums.mean = hn::Add(
      sums.mean, hn::IfThenElseZero(hn::AndNot(coarse, inside), hn::Mul(half, hn::Mul(d2, mean))));
  sums.face_error2 = hn::Add(sums.face_error2, hn::IfThenElseZero(lumped, hn::Mul(f, f)));
  sums.weight2 = hn::Add(sums.weight2, hn::IfThenElseZero(lumped, weight2));
  // Zero times infinity is not a number.
  sums.probe = hn::MulAdd(zero, nn, sums.probe);
  const V signed_dd = hn::Mul(d2, hn::Abs(d2));
  const V dist2 = hn::Mul(signed_dd, over_n);
  const V cos2 =
      hn::Mul(dist2, hn::IfThenElse(hn::Gt(d2, zero), hn::Min(q0, hn::Min(q1, q2)), over_near));
  sums.min_d2 = hn::Min(sums.min_d2, hn::IfThenElse(seen, dist2, sums.min_d2));
  sums.min_cos2 = hn::Min(sums.min_cos2, hn::IfThenElse(seen, cos2, sums.min_cos2));
  sums.max_edge2 = hn::Max(sums.max_edge2, hn::IfThenElseZero(inside, edge2));
  // The sign of d_T means nothing below 16 2^-53 of the radius, as in the star check.
  const M bad =
      hn::And(seen, hn::Not(hn::Gt(signed_dd, hn::Mul(hn::Set(d, 0x1p-98), hn::Mul(nn, nearest)))));
  if (HWY_UNLIKELY(!hn::AllFalse(d, bad))) counts.bad += hn::CountTrue(d, bad);
  counts.nodes += hn::CountTrue(d, hn::And(refused, inside));
  uint8_t* flag = b.flag + at;
  constexpr size_t kLanes = hn::MaxLanes(D());
  if (HWY_LIKELY(hn::AllFalse(d, hn::Or(refused, coarse)))) {
    std::memset(flag, 0, kLanes);
    return;
  }
  const V flags =
      hn::Add(hn::IfThenElseZero(refused, one), hn::IfThenElseZero(coarse, hn::Set(d, 2.0)));
  alignas(64) double values[kLanes];
  hn::Store(flags, d, values);
  for (size_t i = 0; i < kLanes; ++i) flag[i] = static_cast<uint8_t>(values[i]);
}

// Sums over half-edges, and which of them are of the sample; 32-bit lanes.
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
  // Modulo 2^32, lane by lane: GCC's own sum of lanes is one of signed integers.
  alignas(64) uint32_t lanes1[kLanes], lanes2[kLanes];
  hn::Store(sum1, d, lanes1);
  hn::Store(sum2, d, lanes2);
  for (size_t i = 0; i < kLanes; ++i) {
    sums.hash1 += lanes1[i];
    sums.hash2 += lanes2[i];
  }
}

// Three coordinates to 32 bits (multiplicative hashing, Knuth; the constants are odd random
// numbers), both halves of a double alike. Minus zero counts as zero.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void store_hash(D d, const V3& corner, uint32_t* to) {
  uint64_t h = 0;
  for (const V v : {corner.x, corner.y, corner.z}) {
    const double clean = hn::GetLane(hn::Add(v, hn::Zero(d)));
    uint64_t bits;
    std::memcpy(&bits, &clean, sizeof bits);
    h = (h ^ bits) * 0x9E3779B97F4A7C15U;
    h ^= h >> 29;
  }
  *to = static_cast<uint32_t>(h >> 32);
}
#else
HWY_INLINE void store_hash(D d, const V3& corner, uint32_t* to) {
  const hn::Repartition<uint32_t, D> du;
  const hn::Rebind<uint32_t, D> dh;
  using U = hn::Vec<decltype(du)>;
  const auto bits = [&](V v) HWY_ATTR { return hn::BitCast(du, hn::Add(v, hn::Zero(d))); };
  const auto times = [&](U a, uint32_t factor) HWY_ATTR { return hn::Mul(a, hn::Set(du, factor)); };
  U h = hn::Add(times(bits(corner.x), 0x9E3779B1U),
                hn::Add(times(bits(corner.y), 0x85EBCA77U), times(bits(corner.z), 0xC2B2AE3DU)));
  h = times(hn::Xor(h, hn::ShiftRight<15>(h)), 0x2C1B3C6DU);
  // The upper half, which is all there is of a float, with the lower one turned.
  h = hn::Add(h, hn::ShiftLeft<7>(hn::Shuffle2301(h)));
  h = hn::Xor(h, hn::ShiftRight<13>(h));
  const hn::Repartition<uint64_t, D> d64;
  hn::StoreU(hn::TruncateTo(dh, hn::BitCast(d64, h)), dh, to);
}
#endif

// Corners relative to the centre, scaled, and the hashes of the corners as they are in the file.
template <typename Scalar, typename T>
HWY_INLINE void load_corners(const MeshView& mesh, size_t first, size_t n,
                             const BlockParameters& parameters, TriangleBlock<T>& block) {
  const D d;
  constexpr size_t kLanes = hn::MaxLanes(D());
  const V scale = hn::Set(d, parameters.scale);
  const V x0 = hn::Set(d, parameters.center.x), y0 = hn::Set(d, parameters.center.y);
  const V z0 = hn::Set(d, parameters.center.z);
  const std::byte* indices = mesh.triangles + first * mesh.triangle_stride;
  // Rows of floats are read with 4 bytes more: only from a block that does without the last vertex.
  const bool whole =
      kWholeVectors && (sizeof(Scalar) == 8 || parameters.largest_index + 1 < mesh.n_vertices);
  for (size_t at = 0; at < n; at += kLanes, indices += kLanes * mesh.triangle_stride) {
    for (size_t i = 0; i < 3; ++i) {
      const V3 v = whole && at + kLanes <= n
                       ? LoadWhole(d, mesh, indices + 4 * i, Scalar())
                       : LoadFew<Scalar>(d, mesh, indices + 4 * i, HWY_MIN(kLanes, n - at));
      store_hash(d, v, block.hash[i] + at);
      hn::Store(hn::Mul(scale, hn::Sub(v.x, x0)), d, block.corner[i][0] + at);
      hn::Store(hn::Mul(scale, hn::Sub(v.y, y0)), d, block.corner[i][1] + at);
      hn::Store(hn::Mul(scale, hn::Sub(v.z, z0)), d, block.corner[i][2] + at);
    }
  }
}

template <typename T>
HWY_INLINE void work_loaded(size_t n, const BlockParameters& parameters, TriangleBlock<T>& block,
                            BlockSums& sums) {
  const D d;
  const V zero = hn::Zero(d), infinite = hn::Set(d, std::numeric_limits<double>::infinity());
  LaneSums lanes = {zero, zero, zero, zero, infinite, infinite, zero, zero};
  for (size_t at = 0; at < n; at += hn::MaxLanes(d)) {
    work_vector(d, at, n - at, parameters, block, lanes, sums);
  }
  const auto total = [&](V v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, v)); };
  sums.volume6 += total(lanes.volume6);
  sums.mean += total(lanes.mean);
  sums.face_error2 += total(lanes.face_error2);
  sums.weight2 += total(lanes.weight2);
  sums.probe += total(lanes.probe);
  sums.min_d2 = HWY_MIN(sums.min_d2, hn::GetLane(hn::MinOfLanes(d, lanes.min_d2)));
  sums.min_cos2 = HWY_MIN(sums.min_cos2, hn::GetLane(hn::MinOfLanes(d, lanes.min_cos2)));
  sums.max_edge2 = HWY_MAX(sums.max_edge2, hn::GetLane(hn::MaxOfLanes(d, lanes.max_edge2)));
  add_hashes(n, parameters.sampled_names, block, sums);
}

template <typename T>
HWY_INLINE void work_any(const MeshView& mesh, size_t first, size_t n,
                         const BlockParameters& parameters, TriangleBlock<T>& block,
                         BlockSums& sums) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    load_corners<float>(mesh, first, n, parameters, block);
  } else {
    load_corners<double>(mesh, first, n, parameters, block);
  }
  work_loaded(n, parameters, block, sums);
}

void WorkSingle(const MeshView& mesh, size_t first, size_t n, const BlockParameters& parameters,
                TriangleBlock<int32_t>& block, BlockSums& sums) {
  work_any(mesh, first, n, parameters, block, sums);
}
void WorkDouble(const MeshView& mesh, size_t first, size_t n, const BlockParameters& parameters,
                TriangleBlock<double>& block, BlockSums& sums) {
  work_any(mesh, first, n, parameters, block, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(WorkSingle);
HWY_EXPORT(WorkDouble);

namespace {

void work(const MeshView& mesh, std::size_t first, std::size_t n, const BlockParameters& parameters,
          TriangleBlock<std::int32_t>& block, BlockSums& sums) {
  HWY_DYNAMIC_DISPATCH(WorkSingle)(mesh, first, n, parameters, block, sums);
}
void work(const MeshView& mesh, std::size_t first, std::size_t n, const BlockParameters& parameters,
          TriangleBlock<double>& block, BlockSums& sums) {
  HWY_DYNAMIC_DISPATCH(WorkDouble)(mesh, first, n, parameters, block, sums);
}

}  // namespace

BlockSums no_triangles() {
  BlockSums sums;
  sums.min_d2 = sums.min_cos2 = std::numeric_limits<double>::infinity();
  return sums;
}

void BlockSums::add(const BlockSums& other) {
  volume6 += other.volume6;
  mean += other.mean;
  face_error2 += other.face_error2;
  weight2 += other.weight2;
  probe += other.probe;
  min_d2 = std::min(min_d2, other.min_d2);
  min_cos2 = std::min(min_cos2, other.min_cos2);
  max_edge2 = std::max(max_edge2, other.max_edge2);
  bad += other.bad;
  nodes += other.nodes;
  hash1 += other.hash1;
  hash2 += other.hash2;
}

template <typename T>
void work_block(const MeshView& mesh, std::size_t first, std::size_t n,
                const BlockParameters& parameters, TriangleBlock<T>& block, BlockSums& sums) {
  work(mesh, first, n, parameters, block, sums);
}

template void work_block(const MeshView&, std::size_t, std::size_t, const BlockParameters&,
                         TriangleBlock<std::int32_t>&, BlockSums&);
template void work_block(const MeshView&, std::size_t, std::size_t, const BlockParameters&,
                         TriangleBlock<double>&, BlockSums&);

std::uint32_t largest_index(const MeshView& mesh, std::size_t first, std::size_t n) {
  const std::byte* record = mesh.triangles + first * mesh.triangle_stride;
  std::uint32_t largest = 0;
  for (std::size_t t = 0; t < n; ++t, record += mesh.triangle_stride) {
    std::uint32_t corners[3];
    std::memcpy(corners, record, sizeof corners);
    largest = std::max({largest, corners[0], corners[1], corners[2]});
  }
  return largest;
}

// Sums beyond 32 bits wrap around, which the pass finds out.
template <typename T>
void scatter_lumps(const MeshView& mesh, std::size_t first, std::size_t n,
                   const TriangleBlock<T>& block, VertexLump<T>* vertices) {
  using Unit = std::conditional_t<sizeof(T) == 4, std::uint32_t, double>;
  using Four [[gnu::vector_size(4 * sizeof(T))]] = Unit;
  const std::byte* record = mesh.triangles + first * mesh.triangle_stride;
  for (std::size_t t = 0; t < n; ++t, record += mesh.triangle_stride) {
    if ((block.flag[t] & kNodes) != 0) continue;
    std::uint32_t corners[3];
    std::memcpy(corners, record, sizeof corners);
    for (int i = 0; i < 3; ++i) {
      T* to = vertices[corners[i]].value;
      Four sum, lump;
      std::memcpy(&sum, to, sizeof sum);
      std::memcpy(&lump, block.lump[i][t].value, sizeof lump);
      sum += lump;
      std::memcpy(to, &sum, sizeof sum);
    }
  }
}

template <typename T>
void sample_half_edges(const TriangleBlock<T>& block, std::size_t n,
                       std::vector<SampledHalfEdge>& sample) {
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t *a = block.hash[i], *b = block.hash[i == 2 ? 0 : i + 1];
    for (std::size_t byte = 0; 8 * byte < n; ++byte) {
      for (unsigned bits = block.sampled[i][byte]; bits != 0; bits &= bits - 1) {
        const std::size_t t = 8 * byte + static_cast<std::size_t>(std::countr_zero(bits));
        sample.push_back({.name = std::uint64_t{a[t] * b[t]} << 32 | (a[t] + b[t]),
                          .error = block.edge_error[i][t],
                          .lumped = (block.flag[t] & kNodes) == 0});
      }
    }
  }
}

template void sample_half_edges(const TriangleBlock<std::int32_t>&, std::size_t,
                                std::vector<SampledHalfEdge>&);
template void sample_half_edges(const TriangleBlock<double>&, std::size_t,
                                std::vector<SampledHalfEdge>&);

template void scatter_lumps(const MeshView&, std::size_t, std::size_t,
                            const TriangleBlock<std::int32_t>&, VertexLump<std::int32_t>*);
template void scatter_lumps(const MeshView&, std::size_t, std::size_t, const TriangleBlock<double>&,
                            VertexLump<double>*);

}  // namespace rholm
#endif  // HWY_ONCE
