#include "transform/mesh_pass/vertex_lumps.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_pass/vertex_lumps.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "base/poison.h"
#include "shape/queries/corner_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct Lumps {
  V weight, x, y, z;
};
HWY_INLINE Lumps load_lumps(D d, const VertexLump<double>* from) {
  Lumps l;
  hn::LoadInterleaved4(d, from->value, l.weight, l.x, l.y, l.z);
  return l;
}
HWY_INLINE Lumps load_lumps(D d, const VertexLump<std::int32_t>* from) {
  const hn::Rebind<std::int32_t, D> di;
  hn::Vec<decltype(di)> w, x, y, z;
  hn::LoadInterleaved4(di, from->value, w, x, y, z);
  return {hn::PromoteTo(d, w), hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
}

HWY_INLINE void store_as(D d, V v, double* to) { hn::Store(v, d, to); }
HWY_INLINE void store_as(D, V v, float* to) {
  const hn::Rebind<float, D> df;
  hn::Store(hn::DemoteTo(df, v), df, to);
}

HWY_INLINE auto are_zero(D d, const Lumps& l) {
  const V zero = hn::Zero(d);
  return hn::And(hn::And(hn::Eq(l.weight, zero), hn::Eq(l.x, zero)),
                 hn::And(hn::Eq(l.y, zero), hn::Eq(l.z, zero)));
}

// Returns the lanes in which the Hessians are zero.
template <typename L, typename T>
HWY_INLINE auto load_hessians(D d, const VertexLump<L>* lumps, const BlockParameters& p,
                              SourceBatch<T>& batch, std::size_t j, V* h) {
  const V unit = hn::Set(d, 1 / p.per_hessian);
  const Lumps a = load_lumps(d, lumps + kVerticesPerBlock);
  const Lumps b = load_lumps(d, lumps + 2 * kVerticesPerBlock);
  const V numbers[6] = {a.weight, a.x, a.y, a.z, b.weight, b.x};
  for (int k = 0; k < 6; ++k) {
    h[k] = hn::Mul(unit, numbers[k]);
    store_as(d, h[k], batch.hessian[k] + j);
  }
  return hn::And(are_zero(d, a), are_zero(d, b));
}

HWY_INLINE V inner(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
}

// Sums of squares over lanes.
struct LaneSquares {
  V weight, gradient, hessian;
};
// Adds squares of the tangential parts of derivatives, at unit distance: g^2 - (g.u)^2 for a
// gradient, |H|^2 - 2 |Hu|^2 + (u.Hu)^2 for a Hessian.
HWY_INLINE void add_squares(D d, V x, V y, V z, V weight, V gx, V gy, V gz, const V* h,
                            LaneSquares& sums) {
  const V q = hn::Div(hn::Set(d, 1.0), inner(x, y, z, x, y, z));
  const V along = inner(gx, gy, gz, x, y, z);
  sums.weight = hn::MulAdd(weight, weight, sums.weight);
  sums.gradient = hn::MulAdd(
      q, hn::NegMulAdd(q, hn::Mul(along, along), inner(gx, gy, gz, gx, gy, gz)), sums.gradient);
  const V hx = inner(h[0], h[1], h[2], x, y, z), hy = inner(h[1], h[3], h[4], x, y, z);
  const V hz = inner(h[2], h[4], h[5], x, y, z), both = inner(hx, hy, hz, x, y, z);
  const V off = inner(h[1], h[2], h[4], h[1], h[2], h[4]);
  const V one = hn::Mul(q, inner(hx, hy, hz, hx, hy, hz)), twice = hn::Mul(q, both);
  const V all = hn::Add(inner(h[0], h[3], h[5], h[0], h[3], h[5]), hn::Add(off, off));
  sums.hessian = hn::MulAdd(
      hn::Mul(q, q), hn::MulAdd(twice, twice, hn::Sub(all, hn::Add(one, one))), sums.hessian);
}

template <typename Scalar, typename L, typename T>
HWY_INLINE LumpSums load_any(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                             const BlockParameters& p, const VertexLump<L>* lumps,
                             SourceBatch<T>& batch) {
  const D d;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  // Vertices are read as corners of "triangles" whose indices follow each other.
  MeshView view = mesh;
  view.face_stride = sizeof(std::uint32_t);
  const auto* const at = reinterpret_cast<const std::byte*>(numbers);
  // A row of floats is read with 4 bytes beyond it.
  const std::size_t readable = mesh.n_vertices - (sizeof(Scalar) == sizeof(float));
  const V scale = hn::Set(d, p.scale);
  const V x0 = hn::Set(d, p.center.x), y0 = hn::Set(d, p.center.y), z0 = hn::Set(d, p.center.z);
  const V none = hn::Zero(d);
  LaneSquares squares = {none, none, none};
  const V weight = hn::Set(d, 1 / p.per_weight), slope = hn::Set(d, 1 / p.per_gradient);
  for (std::size_t j = 0; j < n; j += kLanes) {
    const Vector3 v = kWholeVectors && j + kLanes <= n && numbers[j + kLanes - 1] < readable
                          ? LoadWhole(d, view, at + 4 * j, Scalar())
                          : LoadFew<Scalar>(d, view, at + 4 * j, HWY_MIN(kLanes, n - j));
    const Lumps l = load_lumps(d, lumps + j);
    auto nothing = are_zero(d, l);
    V h[6] = {none, none, none, none, none, none};
    if (p.hessians) nothing = hn::And(nothing, load_hessians(d, lumps + j, p, batch, j, h));
    const auto position = [&](V at_file, V origin, double otherwise) HWY_ATTR {
      return hn::IfThenElse(nothing, hn::Set(d, otherwise),
                            hn::Mul(scale, hn::Sub(at_file, origin)));
    };
    const V x = position(v.x, x0, 1), y = position(v.y, y0, 0), z = position(v.z, z0, 0);
    hn::Store(x, d, batch.x[0] + j);
    hn::Store(y, d, batch.x[1] + j);
    hn::Store(z, d, batch.x[2] + j);
    const V w = hn::Mul(weight, l.weight);
    const V gx = hn::Mul(slope, l.x), gy = hn::Mul(slope, l.y), gz = hn::Mul(slope, l.z);
    store_as(d, w, batch.value + j);
    store_as(d, gx, batch.gradient[0] + j);
    store_as(d, gy, batch.gradient[1] + j);
    store_as(d, gz, batch.gradient[2] + j);
    if (p.hessians) add_squares(d, x, y, z, w, gx, gy, gz, h, squares);
  }
  LumpSums sums;
  sums.weight2 = hn::GetLane(hn::SumOfLanes(d, squares.weight));
  sums.gradient2 = hn::GetLane(hn::SumOfLanes(d, squares.gradient));
  sums.hessian2 = hn::GetLane(hn::SumOfLanes(d, squares.hessian));
  return sums;
}

template <typename L, typename T>
HWY_INLINE LumpSums load_by_type(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                                 const BlockParameters& p, const VertexLump<L>* lumps,
                                 SourceBatch<T>& batch) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    return load_any<float>(mesh, numbers, n, p, lumps, batch);
  }
  return load_any<double>(mesh, numbers, n, p, lumps, batch);
}

HWY_INLINE V load_numbers(D d, const double* from) { return hn::LoadU(d, from); }
HWY_INLINE V load_numbers(D d, const std::int32_t* from) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::int32_t, D>(), from));
}

// Weight and gradient of a vertex follow each other in the lanes of one or more vectors.
template <typename L>
HWY_INLINE LumpSums sum_any(const VertexLump<L>* lumps, std::size_t n) {
  const D d;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  constexpr std::size_t kParts = kLanes < 4 ? 4 / kLanes : 1, kStep = kParts * kLanes;
  V sum[kParts], square[kParts];
  for (std::size_t i = 0; i < kParts; ++i) sum[i] = square[i] = hn::Zero(d);
  const L* numbers = lumps->value;
  std::size_t at = 0;
  for (; at + kStep <= 4 * n; at += kStep) {
    for (std::size_t i = 0; i < kParts; ++i) {
      const V v = load_numbers(d, numbers + at + i * kLanes);
      sum[i] = hn::Add(sum[i], v);
      square[i] = hn::MulAdd(v, v, square[i]);
    }
  }
  alignas(64) double sums[kStep], squares[kStep];
  for (std::size_t i = 0; i < kParts; ++i) {
    hn::Store(sum[i], d, sums + i * kLanes);
    hn::Store(square[i], d, squares + i * kLanes);
  }
  LumpSums total;
  const auto add = [&](std::size_t i, double v, double vv) {
    if (i % 4 == 0) total.weight += v;
    (i % 4 == 0 ? total.weight2 : total.gradient2) += vv;
  };
  for (std::size_t i = 0; i < kStep; ++i) add(i, sums[i], squares[i]);
  for (; at < 4 * n; ++at) {
    const double v = static_cast<double>(numbers[at]);
    add(at, v, v * v);
  }
  return total;
}

LumpSums SumSingle(const VertexLump<std::int32_t>* lumps, std::size_t n) {
  return sum_any(lumps, n);
}
LumpSums SumDouble(const VertexLump<double>* lumps, std::size_t n) { return sum_any(lumps, n); }

LumpSums LoadSingle(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                    const BlockParameters& p, const VertexLump<std::int32_t>* lumps,
                    SourceBatch<float>& batch) {
  return load_by_type(mesh, numbers, n, p, lumps, batch);
}
LumpSums LoadDouble(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                    const BlockParameters& p, const VertexLump<double>* lumps,
                    SourceBatch<double>& batch) {
  return load_by_type(mesh, numbers, n, p, lumps, batch);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SumSingle);
HWY_EXPORT(SumDouble);
HWY_EXPORT(LoadSingle);
HWY_EXPORT(LoadDouble);

LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<std::int32_t>* lumps,
                       SourceBatch<float>& batch) {
  poison_all(batch);
  return HWY_DYNAMIC_DISPATCH(LoadSingle)(mesh, numbers, n, parameters, lumps, batch);
}
LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<double>* lumps,
                       SourceBatch<double>& batch) {
  poison_all(batch);
  return HWY_DYNAMIC_DISPATCH(LoadDouble)(mesh, numbers, n, parameters, lumps, batch);
}

namespace {

std::int32_t sum_of(std::int32_t a, std::int32_t b) {  // modulo 2^32
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
double sum_of(double a, double b) { return a + b; }

}  // namespace

void LumpSums::add(const LumpSums& other) {
  weight += other.weight;
  weight2 += other.weight2;
  gradient2 += other.gradient2;
  hessian2 += other.hessian2;
}

LumpSums sum_lumps(const VertexLump<std::int32_t>* lumps, std::size_t n) {
  return HWY_DYNAMIC_DISPATCH(SumSingle)(lumps, n);
}
LumpSums sum_lumps(const VertexLump<double>* lumps, std::size_t n) {
  return HWY_DYNAMIC_DISPATCH(SumDouble)(lumps, n);
}

template <typename L>
void add_lumps(const VertexLump<L>* lumps, std::size_t n, VertexLump<L>* sums) {
  for (std::size_t k = 0; k < n; ++k) {
    for (int c = 0; c < 4; ++c) sums[k].value[c] = sum_of(sums[k].value[c], lumps[k].value[c]);
  }
}

template <typename L>
const VertexLump<L>* arranged(const VertexLump<L>* lumps, std::size_t n, bool hessians,
                              VertexLump<L>* room) {
  if (!hessians && n == kVerticesPerBlock) return lumps;
  constexpr std::size_t kLanes = 8;  // lumps are read this many at a time
  const std::size_t padded = (n + kLanes - 1) / kLanes * kLanes;
  const std::size_t per_vertex = lumps_per_vertex(hessians);
  for (std::size_t k = 0; k < per_vertex; ++k) {
    VertexLump<L>* to = room + k * kVerticesPerBlock;
    for (std::size_t i = 0; i < n; ++i) to[i] = lumps[i * per_vertex + k];
    std::fill(to + n, to + padded, VertexLump<L>{});
  }
  return room;
}

template void add_lumps(const VertexLump<std::int32_t>*, std::size_t, VertexLump<std::int32_t>*);
template void add_lumps(const VertexLump<double>*, std::size_t, VertexLump<double>*);
template const VertexLump<std::int32_t>* arranged(const VertexLump<std::int32_t>*, std::size_t,
                                                  bool, VertexLump<std::int32_t>*);
template const VertexLump<double>* arranged(const VertexLump<double>*, std::size_t, bool,
                                            VertexLump<double>*);

}  // namespace rholm
#endif  // HWY_ONCE
