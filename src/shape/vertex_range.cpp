#include "shape/vertex_range.h"

#include <limits>
#include <vector>

#include "base/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/vertex_range.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Reads rows without gaps as vectors of scalars, in which x, y and z alternate.
template <class T>
HWY_INLINE std::size_t PackedRange(const std::byte* at, std::size_t n, VertexRange& range) {
  const hn::CappedTag<T, 16> d;
  using W = hn::Vec<decltype(d)>;
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  W low[3], high[3], nothing[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = hn::Set(d, kInfinity);
    high[k] = hn::Set(d, -kInfinity);
    nothing[k] = hn::Zero(d);
  }
  const std::size_t lanes = hn::Lanes(d), rounds = n / lanes;
  const T* scalars = reinterpret_cast<const T*>(at);
  for (std::size_t i = 0; i < rounds; ++i, scalars += 3 * lanes) {
    for (std::size_t k = 0; k < 3; ++k) {
      const W v = hn::LoadU(d, scalars + k * lanes);
      low[k] = hn::Min(low[k], v);
      high[k] = hn::Max(high[k], v);
      nothing[k] = hn::Add(nothing[k], hn::Sub(v, v));  // NaN for a coordinate that is not finite
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    alignas(64) T lows[hn::MaxLanes(d)], highs[hn::MaxLanes(d)], nothings[hn::MaxLanes(d)];
    hn::Store(low[k], d, lows);
    hn::Store(high[k], d, highs);
    hn::Store(nothing[k], d, nothings);
    for (std::size_t i = 0; i < lanes; ++i) {
      range.add((k * lanes + i) % 3, lows[i], highs[i]);
      range.finite = range.finite && nothings[i] == 0;
    }
  }
  return rounds * lanes;
}

template <class T>
HWY_INLINE VertexRange RangeOf(const MeshView& mesh, std::size_t begin, std::size_t end) {
  VertexRange range;
  if (mesh.vertex_stride == 3 * sizeof(T)) {
    begin += PackedRange<T>(mesh.vertices + begin * mesh.vertex_stride, end - begin, range);
  }
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 v = mesh.vertex(i);
    range.add(0, v.x, v.x);
    range.add(1, v.y, v.y);
    range.add(2, v.z, v.z);
    range.finite = range.finite && is_finite(v);
  }
  return range;
}

VertexRange Range(const MeshView& mesh, std::size_t begin, std::size_t end) {
  return mesh.coordinate == ScalarType::kFloat32 ? RangeOf<float>(mesh, begin, end)
                                                 : RangeOf<double>(mesh, begin, end);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Range);

VertexRange vertex_range(const MeshView& mesh, std::size_t begin, std::size_t end) {
  return HWY_DYNAMIC_DISPATCH(Range)(mesh, begin, end);
}

VertexRange vertex_range(const MeshView& mesh, const Context& context) {
  constexpr std::size_t kGrain = 1 << 15;  // chosen: some 10 us
  std::vector<VertexRange> parts((mesh.n_vertices + kGrain - 1) / kGrain);
  parallel_for(mesh.n_vertices, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    parts[begin / kGrain] = vertex_range(mesh, begin, end);
  });
  VertexRange all;
  for (const VertexRange& part : parts) {
    for (std::size_t k = 0; k < 3; ++k) all.add(k, part.min[k], part.max[k]);
    all.finite = all.finite && part.finite;
  }
  return all;
}

double diagonal_of(const MeshView& mesh, const Context& context) {
  const VertexRange range = vertex_range(mesh, context);
  return norm(
      {range.max[0] - range.min[0], range.max[1] - range.min[1], range.max[2] - range.min[2]});
}

}  // namespace rholm
#endif  // HWY_ONCE
