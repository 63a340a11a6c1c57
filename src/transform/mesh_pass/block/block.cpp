#include "transform/mesh_pass/block/block.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_pass/block/block.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "base/poison.h"
#include "shape/queries/corner_rows-inl.h"
#include "transform/mesh_pass/block/edge_hash-inl.h"
#include "transform/mesh_pass/block/hermite_lumps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Sums over lanes. The extremes have the same value in all lanes.
struct LaneSums {
  V volume6, mean, face_error2, min_d2, min_cos2, max_edge2, probe;
};

// One vector of faces.
struct Elements {
  V d2, nn;                      // n . p_0, n . n
  V q0, q1, q2;                  // 1 / r^2
  V nearest, farthest, longest;  // squares of lengths
  M clear, lumped;
};

// Returns 24 times the mean of 1/|x|^2 over the faces, by six nodes.
HWY_INLINE V mean_by_nodes(D d, const V3& p0, const V3& p1, const V3& p2) {
  const V one = hn::Set(d, 1.0);
  V sum = hn::Zero(d);
  for (const SixNodes& orbit : kSixNodes) {
    const V near = hn::Set(d, orbit.at), far = hn::Set(d, 1 - 2 * orbit.at);
    const auto add = [&](const V3& a, const V3& b, const V3& c) HWY_ATTR {
      const auto between = [&](V x, V y, V z) HWY_ATTR {
        return hn::MulAdd(hn::Add(x, y), near, hn::Mul(z, far));
      };
      const V3 x = {between(a.x, b.x, c.x), between(a.y, b.y, c.y), between(a.z, b.z, c.z)};
      sum = hn::MulAdd(hn::Set(d, 24 * orbit.weight), hn::Div(one, Dot(x, x)), sum);
    };
    add(p0, p1, p2);
    add(p1, p2, p0);
    add(p2, p0, p1);
  }
  return sum;
}

// Treats unusual lanes: faces that are not lumped, new extremes, and lanes at and beyond n, which
// repeat others. Leaves these out of the terms of the sums.
template <typename T>
HWY_INLINE void sort_out(D d, const V3 (&p)[3], const Elements& e, size_t at, size_t n,
                         const BlockParameters& parameters, TriangleBlock<T>& b, V& volume6,
                         V& mean, V& face_error2, LaneSums& sums, BlockSums& counts) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const M inside = hn::FirstN(d, n), seen = hn::And(inside, e.clear);
  const M lumped = hn::And(inside, e.lumped), refused = hn::AndNot(e.lumped, inside);
  const V over_near = hn::Max(e.q0, hn::Max(e.q1, e.q2));
  const V edge2 = hn::Mul(e.longest, over_near);
  const auto beyond = [&](double reach2) HWY_ATTR {
    return hn::AndNot(hn::And(e.clear, hn::Le(edge2, hn::Set(d, reach2))), inside);
  };
  const M beyond_lumps = beyond(parameters.mean_reach2);
  const M coarse = hn::And(beyond_lumps, beyond(parameters.mean_nodes_reach2));
  if (!hn::AllFalse(d, hn::AndNot(coarse, beyond_lumps))) {
    mean = hn::IfThenElse(beyond_lumps, hn::Mul(e.d2, mean_by_nodes(d, p[0], p[1], p[2])), mean);
  }
  volume6 = hn::IfThenElseZero(seen, volume6);
  mean = hn::IfThenElseZero(hn::AndNot(coarse, inside), mean);
  face_error2 = hn::IfThenElseZero(lumped, face_error2);
  // Zero times infinity is not a number, so the probe shows coordinates that are not finite.
  sums.probe = hn::MulAdd(zero, e.nn, sums.probe);
  const V signed_dd = hn::Mul(e.d2, hn::Abs(e.d2));
  const V dist2 = hn::Div(signed_dd, hn::IfThenElse(e.clear, e.nn, one));
  const V cos2 = hn::Mul(
      dist2, hn::IfThenElse(hn::Gt(e.d2, zero), hn::Min(e.q0, hn::Min(e.q1, e.q2)), over_near));
  const auto least = [&](V v, V now) HWY_ATTR {
    return hn::MinOfLanes(d, hn::Min(now, hn::IfThenElse(seen, v, now)));
  };
  sums.min_d2 = least(dist2, sums.min_d2);
  sums.min_cos2 = least(cos2, sums.min_cos2);
  sums.max_edge2 = hn::MaxOfLanes(d, hn::Max(sums.max_edge2, hn::IfThenElseZero(inside, edge2)));
  // Below 16 2^-53 of the radius the sign of d_T means nothing, as in the star check.
  const M bad = hn::And(
      seen, hn::Not(hn::Gt(signed_dd, hn::Mul(hn::Set(d, 0x1p-98), hn::Mul(e.nn, e.nearest)))));
  counts.bad += hn::CountTrue(d, bad);
  counts.nodes += hn::CountTrue(d, refused);
  const V flags =
      hn::Add(hn::IfThenElseZero(refused, one), hn::IfThenElseZero(coarse, hn::Set(d, 2.0)));
  constexpr size_t kLanes = hn::MaxLanes(D());
  alignas(64) double values[kLanes];
  hn::Store(flags, d, values);
  for (size_t i = 0; i < kLanes; ++i) b.flag[at + i] = static_cast<uint8_t>(values[i]);
}

// Processes one vector of faces. Lanes at and beyond n repeat others and are left out of the sums.
template <bool kHessians, typename T>
HWY_INLINE void work_vector(D d, size_t at, size_t n, const BlockParameters& parameters,
                            TriangleBlock<T>& b, LaneSums& sums, BlockSums& counts) {
  const auto corner = [&](int i) HWY_ATTR {
    return V3{hn::Load(d, b.corner[i][0] + at), hn::Load(d, b.corner[i][1] + at),
              hn::Load(d, b.corner[i][2] + at)};
  };
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V3 p0 = corner(0), p1 = corner(1), p2 = corner(2);
  const V3 e01 = Minus(p1, p0), e12 = Minus(p2, p1), e20 = Minus(p0, p2);
  const V3 n3 = Cross(e20, e01), across = Cross(n3, p0);
  const V d2 = Dot(n3, p0), nn = Dot(n3, n3);
  const V r0 = Dot(p0, p0), r1 = Dot(p1, p1), r2 = Dot(p2, p2);  // squares of radii
  const V l01 = Dot(e01, e01), l12 = Dot(e12, e12), l20 = Dot(e20, e20);
  Elements e;
  e.d2 = d2;
  e.nn = nn;
  e.nearest = hn::Min(r0, hn::Min(r1, r2));
  e.farthest = hn::Max(r0, hn::Max(r1, r2));
  e.longest = hn::Max(l01, hn::Max(l12, l20));

  // One division gives 1 / d2 and 1 / r^2. Where d2 vanishes, their values are not used.
  const V r01 = hn::Mul(r0, r1), r012 = hn::Mul(r01, r2);
  const V dn = hn::IfThenElse(hn::Eq(d2, zero), one, d2);
  const V inverse = hn::Div(one, hn::Mul(r012, dn));
  const V over_d = hn::Mul(inverse, r012), over_r = hn::Mul(inverse, dn);
  const V q2 = hn::Mul(r01, over_r), q01 = hn::Mul(r2, over_r);
  const V q0 = hn::Mul(r1, q01), q1 = hn::Mul(r0, q01);
  e.q0 = q0;
  e.q1 = q1;
  e.q2 = q2;

  // n . (p_i x p_j) = (n x p_i) . e_ij, and all weights add up to zero.
  const V over_f = hn::Mul(nn, over_d), face = hn::Neg(over_f);
  const V w01 = hn::Mul(Dot(across, e01), over_d), w20 = hn::Mul(Dot(across, e20), over_d);
  const V w12 = hn::Sub(over_f, hn::Add(w01, w20));

  // Error of lumping: z = L theta with a term for the bending of x/|x| along the edge. Both faces
  // of an edge have the same z. |p_i x p_j|^2 = r_i^2 e^2 - (p_i . e)^2.
  const V quarter = hn::Set(d, 0.25 * parameters.degree * parameters.degree);
  const V bend = hn::Set(d, kHessians ? kHermiteBend : 16.0);
  const auto phase2 = [&](V ri, V rj, V length, V over) HWY_ATTR {
    const V along = hn::Sub(hn::Sub(rj, ri), length);  // 2 p_i . e
    const V sine2 = hn::NegMulAdd(along, along, hn::Mul(hn::Mul(hn::Set(d, 4.0), ri), length));
    return hn::Mul(over, hn::MulAdd(hn::Mul(quarter, over), sine2, hn::Mul(bend, length)));
  };
  const Weights w = {w01, w12, w20, face};
  const Weights z = {phase2(r0, r1, l01, hn::Max(q0, q1)), phase2(r1, r2, l12, hn::Max(q1, q2)),
                     phase2(r2, r0, l20, hn::Max(q2, q0)), zero};
  const Weights f = kHessians ? lump_hessians(d, at, parameters, w, z, e01, e12, e20, b)
                              : lump_gradients(d, at, parameters, w, z, e01, e12, e20, b);
  const auto squares = [&](const Weights& v) HWY_ATTR {
    return hn::MulAdd(v.e01, v.e01,
                      hn::MulAdd(v.e12, v.e12, hn::MulAdd(v.e20, v.e20, hn::Mul(v.face, v.face))));
  };
  store_weights(d, f, b.edge_error, b.face_error, at);
  store_weights(d, w, b.edge_weight, b.face_weight, at);
  V face_error2 = hn::Mul(f.face, f.face);
  const V error2 = squares(f), weight2 = squares(w);
  hn::Store(error2, d, b.error2 + at);

  // Takes the mean of 1/|x|^2 over the face by the same rule. Its derivative along e is -2
  // (p . e)/r^4, and p_0 . (both edges) = (r_1 + r_2 - 2 r_0 - l_01 - l_20) / 2. So the terms of
  // corner i are
  //   1/3 q - 1/12 q^2 p . (both edges) = q/24 (11 - q (sum of r - sum of l + l opposite)).
  const V rest = hn::Sub(hn::Add(r0, hn::Add(r1, r2)), hn::Add(l01, hn::Add(l12, l20)));
  const V eleven = hn::Set(d, 11.0);
  const auto term = [&](V q, V opposite)
                        HWY_ATTR { return hn::NegMulAdd(q, hn::Add(rest, opposite), eleven); };
  const V mean24 =
      hn::MulAdd(q0, term(q0, l12), hn::MulAdd(q1, term(q1, l20), hn::Mul(q2, term(q2, l01))));
  V volume6 = d2, mean = hn::Mul(d2, mean24);

  // Rounding of a normal: corners are exact to 2^-53 r, so n is exact to about 2^-52 r |e|.
  e.clear = hn::Gt(nn, hn::Mul(hn::Set(d, 0x1p-90), hn::Mul(e.farthest, e.longest)));
  // At grazing angles the terms of (M6) are large and cancel.
  const V cap = hn::Set(d, parameters.largest / parameters.per_weight);
  e.lumped = hn::And(
      hn::And(e.clear, hn::Gt(hn::Mul(d2, d2),
                              hn::Mul(hn::Set(d, parameters.grazing2), hn::Mul(nn, e.nearest)))),
      hn::And(hn::Le(error2, hn::Set(d, parameters.tolerance2)),
              hn::Le(weight2, hn::Mul(cap, cap))));
  // True where no value is a new extreme, up to rounding, and the face is not bad.
  const V more = hn::Set(d, 1 + 0x1p-40);
  const V least_cos2 = hn::Max(sums.min_cos2, hn::Set(d, 0x1p-98));
  const V far_enough = hn::Mul(hn::Max(sums.min_d2, hn::Mul(least_cos2, e.farthest)), more);
  const M usual = hn::And(
      hn::And(e.lumped, hn::Gt(hn::Mul(d2, hn::Abs(d2)), hn::Mul(nn, far_enough))),
      hn::Le(hn::Mul(e.longest, more),
             hn::Mul(e.nearest, hn::Min(sums.max_edge2, hn::Set(d, parameters.mean_reach2)))));
  if (HWY_UNLIKELY(n < hn::MaxLanes(D()) || !hn::AllTrue(d, usual))) {
    const V3 p[3] = {p0, p1, p2};
    sort_out(d, p, e, at, n, parameters, b, volume6, mean, face_error2, sums, counts);
  }
  sums.volume6 = hn::Add(sums.volume6, volume6);
  sums.mean = hn::Add(sums.mean, mean);
  sums.face_error2 = hn::Add(sums.face_error2, face_error2);
}

// Scales corners by a power of two, so that one rounding is left.
struct Frame {
  V scale, x, y, z;  // the centre, scaled
};
HWY_INLINE Frame frame_of(D d, const BlockParameters& p) {
  return {hn::Set(d, p.scale), hn::Set(d, p.scale * p.center.x), hn::Set(d, p.scale * p.center.y),
          hn::Set(d, p.scale * p.center.z)};
}
HWY_INLINE void store_corner(D d, const Frame& f, const V3& v, size_t at,
                             double (*to)[kTrianglesPerBlock]) {
  hn::Store(hn::MulSub(v.x, f.scale, f.x), d, to[0] + at);
  hn::Store(hn::MulSub(v.y, f.scale, f.y), d, to[1] + at);
  hn::Store(hn::MulSub(v.z, f.scale, f.z), d, to[2] + at);
}

// Loads corners relative to the centre, scaled, and hashes of the corners as in the file.
template <typename T>
HWY_INLINE void load_corners(const MeshView& mesh, size_t first, size_t n,
                             const BlockParameters& parameters, TriangleBlock<T>& block, double) {
  const D d;
  constexpr size_t kLanes = hn::MaxLanes(D());
  const Frame frame = frame_of(d, parameters);
  const std::byte* indices = mesh.faces + first * mesh.face_stride;
  for (size_t at = 0; at < n; at += kLanes, indices += kLanes * mesh.face_stride) {
    for (size_t i = 0; i < 3; ++i) {
      const V3 v = kWholeVectors && at + kLanes <= n
                       ? LoadWhole(d, mesh, indices + 4 * i, double())
                       : LoadFew<double>(d, mesh, indices + 4 * i, HWY_MIN(kLanes, n - at));
      store_hash(hn::Rebind<uint32_t, D>(), words_of(d, v.x), words_of(d, v.y), words_of(d, v.z),
                 block.hash[i] + at);
      store_corner(d, frame, v, at, block.corner[i]);
    }
  }
}
template <typename T>
HWY_INLINE void load_corners(const MeshView& mesh, size_t first, size_t n,
                             const BlockParameters& parameters, TriangleBlock<T>& block, float) {
  const D d;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const Frame frame = frame_of(d, parameters);
  const std::byte* indices = mesh.faces + first * mesh.face_stride;
  // A row of floats is read with 4 bytes beyond it: only in a block without the last vertex.
  const bool whole = kWholeVectors && parameters.largest_index + 1 < mesh.n_vertices;
  for (size_t at = 0; at < n; at += kLanes, indices += kLanes * mesh.face_stride) {
    for (size_t i = 0; i < 3; ++i) {
      const FloatRows rows = whole && at + kLanes <= n
                                 ? LoadWholeRows(mesh, indices + 4 * i)
                                 : LoadFewRows(mesh, indices + 4 * i, HWY_MIN(kLanes, n - at));
      store_hash(hn::RebindToUnsigned<DF>(), words_of(rows.x), words_of(rows.y), words_of(rows.z),
                 block.hash[i] + at);
      store_corner(d, frame, Lower(d, rows), at, block.corner[i]);
      if (kLanes > hn::MaxLanes(D()))
        store_corner(d, frame, Upper(d, rows), at + hn::MaxLanes(D()), block.corner[i]);
    }
  }
}

template <bool kHessians, typename T>
HWY_INLINE void work_loaded(size_t n, const BlockParameters& parameters, TriangleBlock<T>& block,
                            BlockSums& sums) {
  const D d;
  const V zero = hn::Zero(d);
  LaneSums lanes = {zero,
                    zero,
                    zero,
                    hn::Set(d, sums.min_d2),
                    hn::Set(d, sums.min_cos2),
                    hn::Set(d, sums.max_edge2),
                    zero};
  std::memset(block.flag, 0, sizeof block.flag);
  block.has_nodes_between = false;
  if (kHessians) {
    std::memset(block.edge_rule, 0, sizeof block.edge_rule);
    std::memset(block.face_rule, 0, sizeof block.face_rule);
  }
  for (size_t at = 0; at < n; at += hn::MaxLanes(d)) {
    work_vector<kHessians>(d, at, n - at, parameters, block, lanes, sums);
  }
  const auto total = [&](V v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, v)); };
  sums.volume6 += total(lanes.volume6);
  sums.mean += total(lanes.mean) / 48;
  sums.face_error2 += total(lanes.face_error2);
  sums.probe += total(lanes.probe);
  sums.min_d2 = hn::GetLane(lanes.min_d2);
  sums.min_cos2 = hn::GetLane(lanes.min_cos2);
  sums.max_edge2 = hn::GetLane(lanes.max_edge2);
  add_hashes(n, parameters.sampled_names, block, sums);
}

template <typename T>
HWY_INLINE void work_any(const MeshView& mesh, size_t first, size_t n,
                         const BlockParameters& parameters, TriangleBlock<T>& block,
                         BlockSums& sums) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    load_corners(mesh, first, n, parameters, block, 0.0F);
  } else {
    load_corners(mesh, first, n, parameters, block, 0.0);
  }
  if (parameters.hessians) return work_loaded<true>(n, parameters, block, sums);
  work_loaded<false>(n, parameters, block, sums);
}

// Each record but the last is read with 4 bytes beyond it. Prefetches corners, so that they are in
// the cache when the block is processed.
uint32_t LargestIndex(const MeshView& mesh, size_t first, size_t n) {
  const size_t stride = mesh.face_stride;
  const std::byte* record = mesh.faces + first * stride;
  size_t t = 0;
  uint32_t largest = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<uint32_t, 4> d;
  using U = hn::Vec<decltype(d)>;
  U most[2] = {hn::Zero(d), hn::Zero(d)};
  for (; t + 2 < n; t += 2) {
    for (size_t i = 0; i < 2; ++i, record += stride) {
      most[i] = hn::Max(most[i], hn::LoadU(d, reinterpret_cast<const uint32_t*>(record)));
      for (size_t k = 0; k < 3; ++k) hwy::Prefetch(Row(mesh, record + 4 * k));
    }
  }
  alignas(16) uint32_t corners[4];
  hn::Store(hn::Max(most[0], most[1]), d, corners);
  largest = HWY_MAX(corners[0], HWY_MAX(corners[1], corners[2]));
#endif
  for (; t < n; ++t, record += stride) {
    uint32_t index[3];
    std::memcpy(index, record, sizeof index);
    largest = HWY_MAX(largest, HWY_MAX(index[0], HWY_MAX(index[1], index[2])));
  }
  return largest;
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

HWY_EXPORT(LargestIndex);
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
  poison_all(block);
  work(mesh, first, n, parameters, block, sums);
}

template void work_block(const MeshView&, std::size_t, std::size_t, const BlockParameters&,
                         TriangleBlock<std::int32_t>&, BlockSums&);
template void work_block(const MeshView&, std::size_t, std::size_t, const BlockParameters&,
                         TriangleBlock<double>&, BlockSums&);

std::uint32_t largest_index(const MeshView& mesh, std::size_t first, std::size_t n) {
  return HWY_DYNAMIC_DISPATCH(LargestIndex)(mesh, first, n);
}

}  // namespace rholm
#endif  // HWY_ONCE
