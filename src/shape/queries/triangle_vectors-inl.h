// Loops over vectors of triangles of a view, in double precision. For inner loops; included once
// for every kind of processor (Highway).
#if defined(RHOLM_SHAPE_TRIANGLE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_SHAPE_TRIANGLE_VECTORS_INL_H_
#undef RHOLM_SHAPE_TRIANGLE_VECTORS_INL_H_
#else
#define RHOLM_SHAPE_TRIANGLE_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "shape/queries/corner_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Number of triangles whose indices are checked, and whose corners are prefetched, ahead of use.
// Measured (scripts/constants): 32 to 256 are alike.
constexpr std::size_t kBlock = 128;

// Calls look(a, b, c, t, n) for the triangles t ... t + n - 1 of each vector, in order. Corners
// have the view's coordinates, read as type T; behind the n-th, the last one is repeated. Throws
// InvalidInput for an index out of range.
template <class T, class Look>
HWY_INLINE void ForVectors(const MeshView& mesh, std::size_t begin, std::size_t end, Look look) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t t = begin, block_end = std::min(end, begin + kBlock);
  std::uint32_t next_largest = LookAhead(mesh, t, block_end);
  while (t < end) {
    const std::uint32_t largest = next_largest;
    if (largest >= mesh.n_vertices) validate(mesh);  // throws with the index
    next_largest = LookAhead(mesh, block_end, std::min(end, block_end + kBlock));
    const std::byte* at = mesh.faces + t * mesh.face_stride;
    // Rows of floats are read with 4 bytes more, so the last row is excluded.
    if (kWholeVectors && (sizeof(T) == 8 || largest + 1 < mesh.n_vertices)) {
      for (; t + lanes <= block_end; t += lanes, at += lanes * mesh.face_stride) {
        look(LoadWhole(d, mesh, at, T()), LoadWhole(d, mesh, at + 4, T()),
             LoadWhole(d, mesh, at + 8, T()), t, lanes);
      }
    }
    for (; t < block_end; t += lanes, at += lanes * mesh.face_stride) {
      const std::size_t n = std::min(lanes, block_end - t);
      look(LoadFew<T>(d, mesh, at, n), LoadFew<T>(d, mesh, at + 4, n),
           LoadFew<T>(d, mesh, at + 8, n), t, n);
    }
    t = block_end;
    block_end = std::min(end, block_end + kBlock);
  }
}

HWY_INLINE Vector3 Same(D d, const Vec3& v) {
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif
