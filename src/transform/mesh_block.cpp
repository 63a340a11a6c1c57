#include "transform/mesh_block.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_block.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

struct V3 {
  V x, y, z;
};
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
HWY_INLINE V fourth_power(V z) {
  const V zz = hn::Mul(z, z);
  return hn::Mul(zz, zz);
}

struct LaneSums {
  V volume6, solid_angle, mean, error2, weight2, min_d2, min_cos2, max_edge2, probe;
};

template <typename T>
HWY_INLINE void store_lumps(D d, V weight, const V3& gradient, const BlockParameters& p,
                            VertexLump<T>* to) {
  const V w = hn::Round(hn::Mul(weight, hn::Set(d, p.per_weight)));
  const V per = hn::Set(d, p.per_gradient);
  const V x = hn::Round(hn::Mul(gradient.x, per)), y = hn::Round(hn::Mul(gradient.y, per));
  const V z = hn::Round(hn::Mul(gradient.z, per));
  if constexpr (sizeof(T) == 4) {
    const hn::Rebind<int32_t, D> di;
    hn::StoreInterleaved4(hn::DemoteTo(di, w), hn::DemoteTo(di, x), hn::DemoteTo(di, y),
                          hn::DemoteTo(di, z), di, to->value);
  } else {
    hn::StoreInterleaved4(w, x, y, z, d, to->value);
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

  // 1 / d2, 1 / r^2 and their like by two divisions.
  const V r01 = hn::Mul(r0, r1), over_r = hn::Div(one, hn::Mul(r01, r2));
  const V q2 = hn::Mul(r01, over_r), q01 = hn::Mul(r2, over_r);
  const V q0 = hn::Mul(r1, q01), q1 = hn::Mul(r0, q01);
  const V over_d = hn::Div(one, d2);
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

  // Error of lumping: z = L theta with a part for the bending of x/|x| along the edge.
  const V ll = hn::Set(d, parameters.degree * parameters.degree), bend = hn::Set(d, 16.0);
  const V near2 = hn::Mul(over_near, over_near);
  const auto phase2 = [&](const V3& c, V length) HWY_ATTR {
    return hn::MulAdd(hn::Mul(ll, dot(c, c)), near2, hn::Mul(bend, hn::Mul(length, over_near)));
  };
  const V z01 = phase2(c01, l01), z12 = phase2(c12, l12), z20 = phase2(c20, l20);
  const V z = hn::Max(z01, hn::Max(z12, z20));
  V error2 = hn::Mul(hn::Mul(w01, w01), fourth_power(z01));
  error2 = hn::MulAdd(hn::Mul(w12, w12), fourth_power(z12), error2);
  error2 = hn::MulAdd(hn::Mul(w20, w20), fourth_power(z20), error2);
  error2 = hn::MulAdd(hn::Mul(face, face), fourth_power(z), error2);
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
  const auto lump = [&](int i, V out, V in, V g_out, const V3& e_out, V g_in,
                        const V3& e_in) HWY_ATTR {
    const V3 gradient = {hn::NegMulAdd(g_in, e_in.x, hn::Mul(g_out, e_out.x)),
                         hn::NegMulAdd(g_in, e_in.y, hn::Mul(g_out, e_out.y)),
                         hn::NegMulAdd(g_in, e_in.z, hn::Mul(g_out, e_out.z))};
    store_lumps(d, hn::MulAdd(half, hn::Add(out, in), third), gradient, parameters, b.lump[i] + at);
  };
  lump(0, w01, w20, g01, e01, g20, e20);
  lump(1, w12, w01, g12, e12, g01, e01);
  lump(2, w20, w12, g20, e20, g12, e12);
  hn::Store(error2, d, b.error2 + at);
  hn::Store(weight2, d, b.weight2 + at);

  // Means over the face by the same rule: of 1/|x|^2, whose derivative along e is -2 (p . e)/r^4,
  // and, at the corners only, of 1/|x|^3.
  const V s01 = dot(p0, p1), s12 = dot(p1, p2), s20 = dot(p2, p0);
  const auto term = [&](V q, V s, V t, V r) HWY_ATTR {
    const V along = hn::Sub(hn::Add(s, t), hn::Add(r, r));  // p . (both edges)
    return hn::Mul(q, hn::NegMulAdd(hn::Mul(q, along), hn::Set(d, 1.0 / 12), hn::Set(d, 1.0 / 3)));
  };
  const V mean =
      hn::Add(term(q0, s01, s20, r0), hn::Add(term(q1, s12, s01, r1), term(q2, s20, s12, r2)));
  const V cubes = hn::Mul(mean, hn::Sqrt(hn::Abs(mean)));

  const M inside = hn::FirstN(d, n);
  const M lumped = hn::AndNot(refused, inside);
  const M seen = hn::AndNot(unclear, inside);
  sums.volume6 = hn::Add(sums.volume6, hn::IfThenElseZero(seen, d2));
  sums.solid_angle = hn::Add(sums.solid_angle, hn::IfThenElseZero(seen, hn::Mul(d2, cubes)));
  sums.mean = hn::Add(
      sums.mean, hn::IfThenElseZero(hn::AndNot(coarse, inside), hn::Mul(half, hn::Mul(d2, mean))));
  sums.error2 = hn::Add(sums.error2, hn::IfThenElseZero(lumped, error2));
  sums.weight2 = hn::Add(sums.weight2, hn::IfThenElseZero(lumped, weight2));
  // Zero times infinity is not a number.
  sums.probe = hn::MulAdd(zero, nn, sums.probe);
  const V signed_dd = hn::Mul(d2, hn::Abs(d2));
  const V dist2 = hn::Div(signed_dd, nn);
  const V cos2 =
      hn::Mul(dist2, hn::IfThenElse(hn::Gt(d2, zero), hn::Div(one, farthest), over_near));
  sums.min_d2 = hn::Min(sums.min_d2, hn::IfThenElse(seen, dist2, sums.min_d2));
  sums.min_cos2 = hn::Min(sums.min_cos2, hn::IfThenElse(seen, cos2, sums.min_cos2));
  sums.max_edge2 = hn::Max(sums.max_edge2, hn::IfThenElseZero(inside, edge2));
  // The sign of d_T means nothing below 16 2^-53 of the radius, as in the star check.
  const M bad =
      hn::And(seen, hn::Not(hn::Gt(signed_dd, hn::Mul(hn::Set(d, 0x1p-98), hn::Mul(nn, nearest)))));
  if (HWY_UNLIKELY(!hn::AllFalse(d, bad))) counts.bad += hn::CountTrue(d, bad);
  counts.nodes += hn::CountTrue(d, hn::And(refused, inside));
  const V flags =
      hn::Add(hn::IfThenElseZero(refused, one), hn::IfThenElseZero(coarse, hn::Set(d, 2.0)));
  alignas(64) double flag[hn::MaxLanes(D())];
  hn::Store(flags, d, flag);
  for (size_t i = 0; i < hn::MaxLanes(D()); ++i) b.flag[at + i] = static_cast<uint8_t>(flag[i]);
}

// Hash of a vertex's coordinates, half-edge sums; 32-bit lanes.
HWY_INLINE void add_hashes(const uint32_t (*hash)[kTrianglesPerBlock], size_t n, BlockSums& sums) {
  const hn::ScalableTag<uint32_t> d;
  using U = hn::Vec<decltype(d)>;
  U sum1 = hn::Zero(d), sum2 = hn::Zero(d);
  for (size_t at = 0; at < n; at += hn::MaxLanes(d)) {
    const auto inside = hn::FirstN(d, n - at);
    const U h[3] = {hn::Load(d, hash[0] + at), hn::Load(d, hash[1] + at),
                    hn::Load(d, hash[2] + at)};
    for (int i = 0; i < 3; ++i) {
      const U a = h[i], b = h[i == 2 ? 0 : i + 1];
      const U product = hn::Mul(a, b);
      const U odd = hn::Mul(product, hn::Sub(a, b));
      sum1 = hn::Add(sum1, hn::IfThenElseZero(inside, odd));
      sum2 = hn::Add(sum2, hn::IfThenElseZero(inside, hn::Mul(odd, product)));
    }
  }
  sums.hash1 += hn::GetLane(hn::SumOfLanes(d, sum1));
  sums.hash2 += hn::GetLane(hn::SumOfLanes(d, sum2));
}

template <typename T>
HWY_INLINE void work_loaded(size_t n, const BlockParameters& parameters, TriangleBlock<T>& block,
                            BlockSums& sums) {
  const D d;
  const V zero = hn::Zero(d), infinite = hn::Set(d, std::numeric_limits<double>::infinity());
  LaneSums lanes = {zero, zero, zero, zero, zero, infinite, infinite, zero, zero};
  for (size_t at = 0; at < n; at += hn::MaxLanes(d)) {
    work_vector(d, at, n - at, parameters, block, lanes, sums);
  }
  const auto total = [&](V v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, v)); };
  sums.volume6 += total(lanes.volume6);
  sums.solid_angle += total(lanes.solid_angle) / 2;
  sums.mean += total(lanes.mean);
  sums.error2 += total(lanes.error2);
  sums.weight2 += total(lanes.weight2);
  sums.probe += total(lanes.probe);
  sums.min_d2 = HWY_MIN(sums.min_d2, hn::GetLane(hn::MinOfLanes(d, lanes.min_d2)));
  sums.min_cos2 = HWY_MIN(sums.min_cos2, hn::GetLane(hn::MinOfLanes(d, lanes.min_cos2)));
  sums.max_edge2 = HWY_MAX(sums.max_edge2, hn::GetLane(hn::MaxOfLanes(d, lanes.max_edge2)));
  add_hashes(block.hash, n, sums);
}

void WorkSingle(size_t n, const BlockParameters& parameters, TriangleBlock<int32_t>& block,
                BlockSums& sums) {
  work_loaded(n, parameters, block, sums);
}
void WorkDouble(size_t n, const BlockParameters& parameters, TriangleBlock<double>& block,
                BlockSums& sums) {
  work_loaded(n, parameters, block, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(WorkSingle);
HWY_EXPORT(WorkDouble);

namespace {

void work(std::size_t n, const BlockParameters& parameters, TriangleBlock<std::int32_t>& block,
          BlockSums& sums) {
  HWY_DYNAMIC_DISPATCH(WorkSingle)(n, parameters, block, sums);
}
void work(std::size_t n, const BlockParameters& parameters, TriangleBlock<double>& block,
          BlockSums& sums) {
  HWY_DYNAMIC_DISPATCH(WorkDouble)(n, parameters, block, sums);
}

// Three coordinates to 32 bits (multiplicative hashing, Knuth; the constants are odd random
// numbers). Minus zero counts as zero.
std::uint32_t hash_of(const float* v) {
  std::uint32_t bits[3];
  const float clean[3] = {v[0] + 0.0F, v[1] + 0.0F, v[2] + 0.0F};
  std::memcpy(bits, clean, sizeof bits);
  std::uint32_t h = bits[0] * 0x9E3779B1U + bits[1] * 0x85EBCA77U + bits[2] * 0xC2B2AE3DU;
  h ^= h >> 15;
  h *= 0x2C1B3C6DU;
  return h ^ (h >> 13);
}
std::uint32_t hash_of(const double* v) {
  std::uint64_t bits[3];
  const double clean[3] = {v[0] + 0.0, v[1] + 0.0, v[2] + 0.0};
  std::memcpy(bits, clean, sizeof bits);
  std::uint64_t h =
      bits[0] * 0x9E3779B97F4A7C15U + bits[1] * 0xC2B2AE3D27D4EB4FU + bits[2] * 0x165667B19E3779F9U;
  h ^= h >> 29;
  h *= 0xBF58476D1CE4E5B9U;
  return static_cast<std::uint32_t>(h >> 32);
}

template <typename Scalar, typename T>
void load_corners(const MeshView& mesh, std::size_t first, std::size_t n,
                  const BlockParameters& parameters, TriangleBlock<T>& block) {
  const std::byte* record = mesh.triangles + first * mesh.triangle_stride;
  const double scale = parameters.scale;
  const Vec3 center = parameters.center;
  for (std::size_t t = 0; t < n; ++t, record += mesh.triangle_stride) {
    std::uint32_t corners[3];
    std::memcpy(corners, record, sizeof corners);
    for (int i = 0; i < 3; ++i) {
      Scalar v[3];
      std::memcpy(v, mesh.vertices + corners[i] * mesh.vertex_stride, sizeof v);
      block.index[i][t] = corners[i];
      block.hash[i][t] = hash_of(v);
      block.corner[i][0][t] = scale * (v[0] - center.x);
      block.corner[i][1][t] = scale * (v[1] - center.y);
      block.corner[i][2][t] = scale * (v[2] - center.z);
    }
  }
  // Whole vectors: what is beyond the last triangle repeats it.
  const std::size_t end = std::min((n + 15) / 16 * 16, TriangleBlock<T>::kSize);
  for (std::size_t t = n; t < end; ++t) {
    for (int i = 0; i < 3; ++i) {
      block.hash[i][t] = 0;
      for (int k = 0; k < 3; ++k) block.corner[i][k][t] = block.corner[i][k][n - 1];
    }
  }
}

}  // namespace

BlockSums no_triangles() {
  BlockSums sums;
  sums.min_d2 = sums.min_cos2 = std::numeric_limits<double>::infinity();
  return sums;
}

void BlockSums::add(const BlockSums& other) {
  volume6 += other.volume6;
  solid_angle += other.solid_angle;
  mean += other.mean;
  error2 += other.error2;
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
  if (mesh.coordinate == ScalarType::kFloat32) {
    load_corners<float>(mesh, first, n, parameters, block);
  } else {
    load_corners<double>(mesh, first, n, parameters, block);
  }
  work(n, parameters, block, sums);
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
static std::int32_t add(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
static double add(double a, double b) { return a + b; }

template <typename T>
void scatter_lumps(const TriangleBlock<T>& block, std::size_t n, VertexLump<T>* vertices) {
  for (std::size_t t = 0; t < n; ++t) {
    if ((block.flag[t] & kNodes) != 0) continue;
    for (int i = 0; i < 3; ++i) {
      T* to = vertices[block.index[i][t]].value;
      const T* from = block.lump[i][t].value;
      for (int k = 0; k < 4; ++k) to[k] = add(to[k], from[k]);
    }
  }
}

template void scatter_lumps(const TriangleBlock<std::int32_t>&, std::size_t,
                            VertexLump<std::int32_t>*);
template void scatter_lumps(const TriangleBlock<double>&, std::size_t, VertexLump<double>*);

}  // namespace rholm
#endif  // HWY_ONCE
