// Loads corners of triangles of a MeshView as vectors of double precision. For inner loops;
// included once for every kind of processor (Highway).
//
// Corners are loaded row by row, x, y, z of one vertex at a time. They are turned into vectors of
// x, y and z in registers. This needs a third of the loads of a gather, and a quarter of the time
// where gathers are slow. Gathers take 13 ns a triangle on a Cascade Lake with the mitigation of
// gather data sampling (measured).
#if defined(RHOLM_SHAPE_CORNER_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_SHAPE_CORNER_ROWS_INL_H_
#undef RHOLM_SHAPE_CORNER_ROWS_INL_H_
#else
#define RHOLM_SHAPE_CORNER_ROWS_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "rholm/mesh_view.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

struct Vector3 {
  V x, y, z;
};
HWY_INLINE Vector3 Minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V Dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}

// Returns the row of a vertex. The index of corner k is at `indices + triangle *
// mesh.face_stride`, where indices = mesh.faces + 4 k.
HWY_INLINE const std::byte* Row(const MeshView& mesh, const std::byte* index) {
  std::uint32_t i;
  std::memcpy(&i, index, sizeof i);
  return mesh.vertices + i * mesh.vertex_stride;
}

// Number of bytes of triangles prefetched ahead; saves a tenth of a pass over a large
// mesh (scripts/constants).
constexpr std::size_t kFarAhead = 2048;
// Returns the largest index of the triangles [begin, end), and prefetches their corners.
HWY_INLINE std::uint32_t LookAhead(const MeshView& mesh, std::size_t begin, std::size_t end) {
  if (begin == end) return 0;
  using Four [[gnu::vector_size(16)]] = std::uint32_t;
  Four largest = {}, corners = {};
  const std::size_t stride = mesh.face_stride, vertex_stride = mesh.vertex_stride;
  const std::byte* const vertices = mesh.vertices;
  const std::byte* at = mesh.faces + begin * stride;
  // Loads 16 bytes per triangle, except for the last one, behind which the memory may end.
  for (const std::byte* const last = at + (end - 1 - begin) * stride; at != last; at += stride) {
    std::memcpy(&corners, at, 16);
    largest = largest > corners ? largest : corners;
    for (int k = 0; k < 3; ++k) hwy::Prefetch(vertices + std::size_t{corners[k]} * vertex_stride);
    hwy::Prefetch(at + kFarAhead);
  }
  std::memcpy(&corners, at, 12);
  largest = largest > corners ? largest : corners;
  return HWY_MAX(largest[0], HWY_MAX(largest[1], largest[2]));
}

// Loads up to a vector's number of triangles; missing ones repeat the last.
template <class T>
HWY_INLINE Vector3 LoadFew(D d, const MeshView& mesh, const std::byte* indices, std::size_t n) {
  alignas(64) double rows[3][hn::MaxLanes(d)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    T row[3];
    std::memcpy(row, Row(mesh, indices + std::min(i, n - 1) * mesh.face_stride), sizeof row);
    for (std::size_t k = 0; k < 3; ++k) rows[k][i] = row[k];
  }
  return {hn::Load(d, rows[0]), hn::Load(d, rows[1]), hn::Load(d, rows[2])};
}

// Coordinates in the mesh's own precision, of twice as many triangles as a vector of doubles has.
using DF = hn::CappedTag<float, 16>;
struct FloatRows {
  hn::Vec<DF> x, y, z;
};
HWY_INLINE FloatRows LoadFewRows(const MeshView& mesh, const std::byte* indices, std::size_t n) {
  const DF df;
  alignas(64) float rows[3][hn::MaxLanes(DF())];
  for (std::size_t i = 0; i < hn::MaxLanes(DF()); ++i) {
    float row[3];
    std::memcpy(row, Row(mesh, indices + std::min(i, n - 1) * mesh.face_stride), sizeof row);
    for (std::size_t k = 0; k < 3; ++k) rows[k][i] = row[k];
  }
  return {hn::Load(df, rows[0]), hn::Load(df, rows[1]), hn::Load(df, rows[2])};
}
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Vector3 Lower(D d, const FloatRows& rows) {
  return {hn::PromoteTo(d, rows.x), hn::PromoteTo(d, rows.y), hn::PromoteTo(d, rows.z)};
}
HWY_INLINE Vector3 Upper(D d, const FloatRows& rows) { return Lower(d, rows); }
#else
HWY_INLINE Vector3 Lower(D d, const FloatRows& rows) {
  const hn::Half<DF> half;
  const auto to = [&](hn::Vec<DF> v) HWY_ATTR { return hn::PromoteTo(d, hn::LowerHalf(half, v)); };
  return {to(rows.x), to(rows.y), to(rows.z)};
}
HWY_INLINE Vector3 Upper(D d, const FloatRows& rows) {
  const hn::Half<DF> half;
  const auto to = [&](hn::Vec<DF> v) HWY_ATTR { return hn::PromoteTo(d, hn::UpperHalf(half, v)); };
  return {to(rows.x), to(rows.y), to(rows.z)};
}
#endif

#if HWY_MAX_BYTES >= 32 && !HWY_HAVE_SCALABLE
constexpr bool kWholeVectors = true;

// Loads the rows of triangles i and, for vectors of eight, i + 4. It reads 4 bytes beyond a row.
HWY_INLINE auto LoadRows(const MeshView& mesh, const std::byte* indices, std::size_t i, float) {
  const hn::FixedTag<float, 4> d4;
  const auto load = [&](std::size_t j) HWY_ATTR {
    return hn::LoadU(d4, reinterpret_cast<const float*>(Row(mesh, indices + j * mesh.face_stride)));
  };
#if HWY_MAX_BYTES >= 64
  return hn::Combine(hn::FixedTag<float, 8>(), load(i + 4), load(i));
#else
  return load(i);
#endif
}

HWY_INLINE Vector3 LoadWhole(D d, const MeshView& mesh, const std::byte* indices, float tag) {
  const hn::Rebind<float, D> df;
  const auto row0 = LoadRows(mesh, indices, 0, tag), row1 = LoadRows(mesh, indices, 1, tag);
  const auto row2 = LoadRows(mesh, indices, 2, tag), row3 = LoadRows(mesh, indices, 3, tag);
  const auto even = hn::InterleaveLower(df, row0, row2);  // x0 x2 y0 y2
  const auto odd = hn::InterleaveLower(df, row1, row3);   // x1 x3 y1 y3
  const auto z = hn::InterleaveLower(df, hn::InterleaveUpper(df, row0, row2),
                                     hn::InterleaveUpper(df, row1, row3));
  return {hn::PromoteTo(d, hn::InterleaveLower(df, even, odd)),
          hn::PromoteTo(d, hn::InterleaveUpper(df, even, odd)), hn::PromoteTo(d, z)};
}

// Loads the rows i, i + 4, and with vectors of 16 also i + 8 and i + 12.
HWY_INLINE auto LoadManyRows(const MeshView& mesh, const std::byte* indices, std::size_t i) {
  const hn::FixedTag<float, 4> d4;
  const hn::FixedTag<float, 8> d8;
  const auto load = [&](std::size_t j) HWY_ATTR {
    return hn::LoadU(d4, reinterpret_cast<const float*>(Row(mesh, indices + j * mesh.face_stride)));
  };
#if HWY_MAX_BYTES >= 64
  return hn::Combine(DF(), hn::Combine(d8, load(i + 12), load(i + 8)),
                     hn::Combine(d8, load(i + 4), load(i)));
#else
  return hn::Combine(d8, load(i + 4), load(i));
#endif
}
HWY_INLINE FloatRows LoadWholeRows(const MeshView& mesh, const std::byte* indices) {
  const DF df;
  const auto row0 = LoadManyRows(mesh, indices, 0), row1 = LoadManyRows(mesh, indices, 1);
  const auto row2 = LoadManyRows(mesh, indices, 2), row3 = LoadManyRows(mesh, indices, 3);
  const auto even = hn::InterleaveLower(df, row0, row2);  // x0 x2 y0 y2
  const auto odd = hn::InterleaveLower(df, row1, row3);   // x1 x3 y1 y3
  const auto z = hn::InterleaveLower(df, hn::InterleaveUpper(df, row0, row2),
                                     hn::InterleaveUpper(df, row1, row3));
  return {hn::InterleaveLower(df, even, odd), hn::InterleaveUpper(df, even, odd), z};
}

// Loads corners of four triangles.
HWY_INLINE void LoadFour(const MeshView& mesh, const std::byte* indices,
                         hn::Vec<hn::FixedTag<double, 4>>* xyz) {
  const hn::FixedTag<double, 2> d2;
  const hn::FixedTag<double, 4> d4;
  const auto row = [&](std::size_t j) HWY_ATTR {  // x y y z
    const auto* at = reinterpret_cast<const double*>(Row(mesh, indices + j * mesh.face_stride));
    return hn::Combine(d4, hn::LoadU(d2, at + 1), hn::LoadU(d2, at));
  };
  const auto row0 = row(0), row1 = row(1), row2 = row(2), row3 = row(3);
  const auto lower = hn::InterleaveLower(d4, row0, row1);  // x0 x1 y0 y1
  const auto lower2 = hn::InterleaveLower(d4, row2, row3);
  const auto upper = hn::InterleaveUpper(d4, row0, row1);  // y0 y1 z0 z1
  const auto upper2 = hn::InterleaveUpper(d4, row2, row3);
  xyz[0] = hn::ConcatLowerLower(d4, lower2, lower);
  xyz[1] = hn::ConcatUpperUpper(d4, lower2, lower);
  xyz[2] = hn::ConcatUpperUpper(d4, upper2, upper);
}

HWY_INLINE Vector3 LoadWhole(D d, const MeshView& mesh, const std::byte* indices, double) {
  hn::Vec<hn::FixedTag<double, 4>> first[3];
  LoadFour(mesh, indices, first);
#if HWY_MAX_BYTES >= 64
  hn::Vec<hn::FixedTag<double, 4>> second[3];
  LoadFour(mesh, indices + 4 * mesh.face_stride, second);
  return {hn::Combine(d, second[0], first[0]), hn::Combine(d, second[1], first[1]),
          hn::Combine(d, second[2], first[2])};
#else
  (void)d;
  return {first[0], first[1], first[2]};
#endif
}
#else
constexpr bool kWholeVectors = false;
HWY_INLINE FloatRows LoadWholeRows(const MeshView& mesh, const std::byte* indices) {
  return LoadFewRows(mesh, indices, hn::MaxLanes(DF()));
}
template <class T>
HWY_INLINE Vector3 LoadWhole(D d, const MeshView& mesh, const std::byte* indices, T) {
  return LoadFew<T>(d, mesh, indices, hn::Lanes(d));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif
