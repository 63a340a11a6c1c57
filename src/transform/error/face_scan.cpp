#include "transform/error/face_scan.h"

#include <algorithm>
#include <atomic>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/error/face_scan.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/parallel.h"
#include "shape/face.h"
#include "shape/queries/corner_rows-inl.h"
#include "shape/vertex_range.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of the lanes of a run, which repeat its last faces where it has fewer.
struct LaneSums {
  V twice_area, longest2, nearest2;
};

// Lanes at and beyond n count no area.
HWY_INLINE void AddFaces(D d, const Vector3& p0, const Vector3& p1, const Vector3& p2,
                         std::size_t n, LaneSums& sums) {
  const Vector3 e0 = Minus(p2, p1), e1 = Minus(p0, p2), e2 = Minus(p1, p0);
  const Vector3 normal = Cross(e1, e2);
  const V area = hn::Sqrt(Dot(normal, normal));
  sums.twice_area = hn::Add(sums.twice_area, hn::IfThenElseZero(hn::FirstN(d, n), area));
  sums.longest2 = hn::Max(hn::Max(sums.longest2, Dot(e0, e0)), hn::Max(Dot(e1, e1), Dot(e2, e2)));
  sums.nearest2 = hn::Min(hn::Min(sums.nearest2, Dot(p0, p0)), hn::Min(Dot(p1, p1), Dot(p2, p2)));
}

template <class T>
HWY_INLINE void ScanRunsOf(const MeshView& mesh, const Vec3& center, std::size_t begin,
                           std::size_t end, FaceScan& scan) {
  const D d;
  const std::size_t lanes = hn::Lanes(d), stride = mesh.triangle_stride;
  const V scale = hn::Set(d, scan.scale);
  const Vector3 middle = {hn::Set(d, center.x), hn::Set(d, center.y), hn::Set(d, center.z)};
  const auto local = [&](const Vector3& v) HWY_ATTR {
    const Vector3 moved = Minus(v, middle);
    return Vector3{hn::Mul(moved.x, scale), hn::Mul(moved.y, scale), hn::Mul(moved.z, scale)};
  };
  // Rows of floats are read with 4 bytes more: not the last one.
  const auto whole = [&](std::uint32_t largest) {
    return kWholeVectors && (sizeof(T) == 8 || largest + 1 < mesh.n_vertices);
  };
  constexpr std::size_t kRun = FaceScan::kRun;
  const auto last_of = [&](std::size_t run) { return HWY_MIN(mesh.n_triangles, (run + 1) * kRun); };
  std::uint32_t next_largest = LookAhead(mesh, begin * kRun, last_of(begin));
  for (std::size_t run = begin; run < end; ++run) {
    const std::size_t first = run * kRun, last = last_of(run);
    const std::uint32_t largest = next_largest;
    if (run + 1 < end) next_largest = LookAhead(mesh, last, last_of(run + 1));
    LaneSums sums = {hn::Zero(d), hn::Zero(d), hn::Set(d, std::numeric_limits<double>::infinity())};
    const std::byte* indices = mesh.triangles + first * stride;
    for (std::size_t t = first; t < last; t += lanes, indices += lanes * stride) {
      const std::size_t n = HWY_MIN(lanes, last - t);
      const bool all = n == lanes && whole(largest);
      const auto corner = [&](std::size_t k) HWY_ATTR {
        return local(all ? LoadWhole(d, mesh, indices + 4 * k, T())
                         : LoadFew<T>(d, mesh, indices + 4 * k, n));
      };
      AddFaces(d, corner(0), corner(1), corner(2), n, sums);
    }
    const double nearest2 = hn::GetLane(hn::MinOfLanes(d, sums.nearest2));
    scan.twice_areas[run] = hn::GetLane(hn::SumOfLanes(d, sums.twice_area));
    scan.angles2[run] = nearest2 > 0 ? hn::GetLane(hn::MaxOfLanes(d, sums.longest2)) / nearest2
                                     : std::numeric_limits<double>::infinity();
  }
}

void ScanRuns(const MeshView& mesh, const Vec3& center, std::size_t begin, std::size_t end,
              FaceScan& scan) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    ScanRunsOf<float>(mesh, center, begin, end, scan);
  } else {
    ScanRunsOf<double>(mesh, center, begin, end, scan);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(ScanRuns);

FaceScan scan_faces(const MeshView& mesh, const Vec3& center, const Context& context) {
  const VertexRange r = vertex_range(mesh, 0, mesh.n_vertices);
  const std::size_t runs = (mesh.n_triangles + FaceScan::kRun - 1) / FaceScan::kRun;
  FaceScan scan;
  scan.scale = unit_frame({{r.min[0], r.min[1], r.min[2]}, {r.max[0], r.max[1], r.max[2]}}).scale;
  scan.twice_areas.resize(runs);
  scan.angles2.resize(runs);
  scan.used.resize(mesh.n_vertices);
  constexpr std::size_t kRuns = 512;  // of a task: some 50 us
  parallel_for(runs, kRuns, context, {}, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(ScanRuns)(mesh, center, begin, end, scan);
    const std::size_t last = std::min(mesh.n_triangles, end * FaceScan::kRun);
    for (std::size_t t = begin * FaceScan::kRun; t < last; ++t) {
      for (const std::uint32_t i : mesh.triangle(t)) {
        std::atomic_ref(scan.used[i]).store(1, std::memory_order_relaxed);
      }
    }
  });
  return scan;
}

}  // namespace rholm
#endif  // HWY_ONCE
