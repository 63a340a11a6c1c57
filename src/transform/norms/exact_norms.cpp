#include "transform/norms/exact_norms.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/norms/exact_norms.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/bytes.h"
#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/poison.h"
#include "base/progress.h"
#include "parts/threads.h"
#include "shape/queries/corner_rows-inl.h"
#include "transform/geometry/star_geometry.h"
#include "transform/norms/exact_norms_rules.h"

#ifndef RHOLM_EXACT_NORMS_ONCE
#define RHOLM_EXACT_NORMS_ONCE
namespace rholm {
namespace {

// Number of faces in a block. Their indices are checked, and their corners prefetched, ahead of
// use. Sums over a block are plain sums, as in view_scan.cpp.
constexpr std::size_t kBlock = FaceSizes::kRun;

// Coefficients of the series (1 + v)^(-1/2) = sum_k binomial(-1/2, k) v^k.
struct Binomials {
  double value[kTerms8 + 1] = {1};
  constexpr Binomials() {
    for (int k = 1; k <= kTerms8; ++k) value[k] = value[k - 1] * (0.5 - k) / k;
  }
};
constexpr Binomials kBinomials;

// Maps the mesh's coordinates to the coordinates in which sums are made.
struct Frame {
  Vec3 shift;        // -scale * center
  double scale = 1;  // a power of two
};

// Values of a block's faces for the means. In units of g: squares of corners less 1, squares of
// edges, and the largest square of an edge. Further 1/sqrt(g), d2 and twice the area.
struct Block {
  alignas(64) double r[3][kBlock], l[3][kBlock];
  alignas(64) double longest[kBlock];  // infinite where rounding may decide the normal
  alignas(64) double inverse[kBlock], d2[kBlock];
  alignas(64) double twice_area[kBlock];
};

std::array<Vec3, 3> corners_of(const MeshView& mesh, const Frame& frame, std::size_t t) {
  const Triangle triangle = mesh.triangle(t);
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = frame.scale * mesh.vertex(triangle[i]) + frame.shift;
  return p;
}

void add_sums(const NormSums& part, CompensatedSum* sums) {
  sums[0].add(part.first);
  sums[1].add(part.third);
  sums[2].add(part.volume6);
}

}  // namespace
}  // namespace rholm
#endif

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using M = hn::Mask<D>;

// Squares of corners and edges in units of g, as in Block.
struct LaneSquares {
  V r0, r1, r2, l0, l1, l2;
};
// Means <1/|x|> and <1/|x|^3> without their powers of g^(1/2).
struct Means {
  V first, third;
};
HWY_INLINE V CenterSquare(D d, V r0, V r1, V r2, V edges) {
  return hn::NegMulAdd(hn::Set(d, 1.0 / 9), edges,
                       hn::Mul(hn::Set(d, 1.0 / 3), hn::Add(hn::Add(r0, r1), r2)));
}

// Returns f = (1+v)^(-1/2) - 1.
template <int kTerms>
HWY_INLINE V InverseRoot(D d, V v) {
  V p = hn::Set(d, kBinomials.value[kTerms]);
  for (int k = kTerms - 1; k >= 1; --k) p = hn::MulAdd(p, v, hn::Set(d, kBinomials.value[k]));
  return hn::Mul(p, v);
}

// Sums over the nodes of an orbit of f and of (1+f)^3 - 1 = f (3 + f (3 + f)).
struct OrbitSums {
  V first, third;
  HWY_INLINE void Add(D d, V f) {
    const V three = hn::Set(d, 3.0);
    first = hn::Add(first, f);
    third = hn::MulAdd(hn::MulAdd(hn::Add(f, three), f, three), f, third);
  }
  HWY_INLINE void AddTo(D d, double weight, OrbitSums& all) const {
    all.first = hn::MulAdd(hn::Set(d, weight), first, all.first);
    all.third = hn::MulAdd(hn::Set(d, weight), third, all.third);
  }
};

template <int kTerms>
HWY_INLINE void AddTriples(D d, const TripleOrbit& orbit, const LaneSquares& s, V edges,
                           OrbitSums& all) {
  const double a = orbit.a, b = 1 - 2 * a;
  // The common part is a sum(r - 1) - a b sum(l), where sum(r - 1) = sum(l) / 3.
  const V common = hn::Mul(edges, hn::Set(d, a * (1.0 / 3 - b)));
  const V of_corner = hn::Set(d, b - a), of_edge = hn::Set(d, (b - a) * a);
  const auto f = [&](V r, V l) HWY_ATTR {
    return InverseRoot<kTerms>(d, hn::MulAdd(of_corner, r, hn::MulAdd(of_edge, l, common)));
  };
  OrbitSums sums = {hn::Zero(d), hn::Zero(d)};
  sums.Add(d, f(s.r0, s.l0));
  sums.Add(d, f(s.r1, s.l1));
  sums.Add(d, f(s.r2, s.l2));
  sums.AddTo(d, orbit.weight, all);
}

// Adds the two points of a sextuple at which the first given corner has the coordinate a.
template <int kTerms>
HWY_INLINE void AddTwins(D d, V r0, V r1, V r2, V l0, V l1, V l2, OrbitSums& sums) {
  constexpr double a = kDegree8Six.a, b = kDegree8Six.b, c = 1 - a - b;
  const V common = hn::NegMulAdd(hn::Set(d, b * c), l0, hn::Mul(hn::Set(d, a), r0));
  const auto f = [&](double b1, double b2) HWY_ATTR {
    const V corners = hn::MulAdd(hn::Set(d, b1), r1, hn::MulAdd(hn::Set(d, b2), r2, common));
    return InverseRoot<kTerms>(
        d, hn::NegMulAdd(hn::Set(d, a * b1), l2, hn::NegMulAdd(hn::Set(d, a * b2), l1, corners)));
  };
  sums.Add(d, f(b, c));
  sums.Add(d, f(c, b));
}

template <bool kHigh>
HWY_INLINE Means MeansOf(D d, const LaneSquares& s) {
  constexpr int kTerms = kHigh ? kTerms8 : kTerms5;
  const V edges = hn::Add(hn::Add(s.l0, s.l1), s.l2), one = hn::Set(d, 1.0), zero = hn::Zero(d);
  OrbitSums sums = {zero, zero};
  if constexpr (kHigh) {
    for (const TripleOrbit& orbit : kDegree8) AddTriples<kTerms>(d, orbit, s, edges, sums);
    OrbitSums six = {zero, zero};
    AddTwins<kTerms>(d, s.r0, s.r1, s.r2, s.l0, s.l1, s.l2, six);
    AddTwins<kTerms>(d, s.r1, s.r2, s.r0, s.l1, s.l2, s.l0, six);
    AddTwins<kTerms>(d, s.r2, s.r0, s.r1, s.l2, s.l0, s.l1, six);
    six.AddTo(d, kDegree8Six.weight, sums);
  } else {
    for (const TripleOrbit& orbit : kDegree5) AddTriples<kTerms>(d, orbit, s, edges, sums);
  }
  return {hn::Add(sums.first, one), hn::Add(sums.third, one)};
}

// Computes the same means from the four triangles between the edges' midpoints.
HWY_NOINLINE Means MeansOfQuarters(D d, const LaneSquares& s) {
  const V quarter = hn::Set(d, 0.25), half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);
  const V l0 = hn::Mul(quarter, s.l0), l1 = hn::Mul(quarter, s.l1), l2 = hn::Mul(quarter, s.l2);
  const V edges = hn::Add(hn::Add(l0, l1), l2);
  const V m0 = hn::MulSub(half, hn::Add(s.r1, s.r2), l0);
  const V m1 = hn::MulSub(half, hn::Add(s.r2, s.r0), l1);
  const V m2 = hn::MulSub(half, hn::Add(s.r0, s.r1), l2);
  Means sum = {hn::Zero(d), hn::Zero(d)};
  const auto add = [&](V r0, V r1, V r2) HWY_ATTR {
    const V g = CenterSquare(d, r0, r1, r2, edges);  // g less 1
    const V inverse = hn::Div(one, hn::Sqrt(hn::Add(one, g))), q = hn::Mul(inverse, inverse);
    const auto unit = [&](V r) HWY_ATTR { return hn::Mul(hn::Sub(r, g), q); };
    const Means means = MeansOf<true>(
        d, {unit(r0), unit(r1), unit(r2), hn::Mul(l0, q), hn::Mul(l1, q), hn::Mul(l2, q)});
    const V weight = hn::Mul(quarter, inverse);
    sum.first = hn::MulAdd(weight, means.first, sum.first);
    sum.third = hn::MulAdd(hn::Mul(weight, q), means.third, sum.third);
  };
  add(m0, m1, m2);
  add(s.r0, m2, m1);
  add(m2, s.r1, m0);
  add(m1, m0, s.r2);
  return sum;
}

// Squares of the longest edge and of the nearest corner's distance, over all faces of a block.
struct Extents {
  V longest, nearest;
};

// Computes the block's values for one vector of faces.
HWY_INLINE void Prepare(D d, const Vector3& p0, const Vector3& p1, const Vector3& p2,
                        std::size_t at, Block& block, Extents& extents) {
  const Vector3 e0 = Minus(p2, p1), e1 = Minus(p0, p2), e2 = Minus(p1, p0);
  const Vector3 normal = Cross(e1, e2);
  const V d2 = Dot(normal, p0), nn = Dot(normal, normal);
  const V r0 = Dot(p0, p0), r1 = Dot(p1, p1), r2 = Dot(p2, p2);
  const V l0 = Dot(e0, e0), l1 = Dot(e1, e1), l2 = Dot(e2, e2);
  const V g = CenterSquare(d, r0, r1, r2, hn::Add(hn::Add(l0, l1), l2));
  const V longest = hn::Max(l0, hn::Max(l1, l2)), farthest = hn::Max(r0, hn::Max(r1, r2));
  // Corners are exact to 2^-53 r, so normals to about 2^-52 r |e|. Beyond, the exact normal
  // decides.
  const M clear = hn::Gt(nn, hn::Mul(hn::Set(d, 0x1p-90), hn::Mul(farthest, longest)));
  const V one = hn::Set(d, 1.0), inverse = hn::Div(one, hn::Sqrt(g)), q = hn::Mul(inverse, inverse);
  hn::Store(hn::MulSub(r0, q, one), d, block.r[0] + at);
  hn::Store(hn::MulSub(r1, q, one), d, block.r[1] + at);
  hn::Store(hn::MulSub(r2, q, one), d, block.r[2] + at);
  hn::Store(hn::Mul(l0, q), d, block.l[0] + at);
  hn::Store(hn::Mul(l1, q), d, block.l[1] + at);
  hn::Store(hn::Mul(l2, q), d, block.l[2] + at);
  const V infinite = hn::Set(d, std::numeric_limits<double>::infinity());
  hn::Store(hn::IfThenElse(clear, hn::Mul(longest, q), infinite), d, block.longest + at);
  hn::Store(inverse, d, block.inverse + at);
  hn::Store(d2, d, block.d2 + at);
  hn::Store(hn::Sqrt(nn), d, block.twice_area + at);
  extents.longest = hn::Max(extents.longest, longest);
  extents.nearest = hn::Min(extents.nearest, hn::Min(r0, hn::Min(r1, r2)));
}

struct LaneSums {
  V first, third, volume6;
};

// Adds one vector of faces and returns the lanes that are left out.
HWY_INLINE M AddTriangles(D d, const Block& block, std::size_t at, LaneSums& sums) {
  const LaneSquares s = {hn::Load(d, block.r[0] + at), hn::Load(d, block.r[1] + at),
                         hn::Load(d, block.r[2] + at), hn::Load(d, block.l[0] + at),
                         hn::Load(d, block.l[1] + at), hn::Load(d, block.l[2] + at)};
  const V longest = hn::Load(d, block.longest + at);
  const auto beyond = [&](double reach)
                          HWY_ATTR { return hn::Not(hn::Le(longest, hn::Set(d, reach))); };
  Means means;
  M left = beyond(kReach5);
  if (HWY_LIKELY(hn::AllFalse(d, left))) {
    means = MeansOf<false>(d, s);
  } else {
    left = beyond(kReach8);
    if (HWY_LIKELY(hn::AllFalse(d, left))) {
      means = MeansOf<true>(d, s);
    } else {
      // A quarter's edges are half as long, and it is nearer by at most (theta/2)^2.
      left = beyond(3.9 * kReach8);
      means = MeansOfQuarters(d, s);
    }
  }
  const V inverse = hn::Load(d, block.inverse + at), d2 = hn::Load(d, block.d2 + at);
  const V first = hn::Mul(d2, inverse), third = hn::Mul(first, hn::Mul(inverse, inverse));
  sums.volume6 = hn::Add(sums.volume6, hn::IfThenZeroElse(left, d2));
  sums.first = hn::Add(sums.first, hn::IfThenZeroElse(left, hn::Mul(first, means.first)));
  sums.third = hn::Add(sums.third, hn::IfThenZeroElse(left, hn::Mul(third, means.third)));
  return left;
}

// Fills the block and returns its value of FaceSizes::angles2.
template <class T>
HWY_INLINE double PrepareBlock(const MeshView& mesh, const Frame& frame, std::size_t begin,
                               std::size_t n, bool whole, Block& block) {
  const D d;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extents extents = {hn::Zero(d), hn::Set(d, kInfinity)};
  const std::size_t lanes = hn::Lanes(d);
  const V scale = hn::Set(d, frame.scale);
  const Vector3 shift = {hn::Set(d, frame.shift.x), hn::Set(d, frame.shift.y),
                         hn::Set(d, frame.shift.z)};
  const auto local = [&](const Vector3& v) HWY_ATTR {
    return Vector3{hn::MulAdd(v.x, scale, shift.x), hn::MulAdd(v.y, scale, shift.y),
                   hn::MulAdd(v.z, scale, shift.z)};
  };
  const std::byte* indices = mesh.faces + begin * mesh.face_stride;
  poison_all(block);
  std::size_t at = 0;
  if (whole) {
    for (; at + lanes <= n; at += lanes, indices += lanes * mesh.face_stride) {
      Prepare(d, local(LoadWhole(d, mesh, indices, T())),
              local(LoadWhole(d, mesh, indices + 4, T())),
              local(LoadWhole(d, mesh, indices + 8, T())), at, block, extents);
    }
  }
  for (; at < n; at += lanes, indices += lanes * mesh.face_stride) {
    const std::size_t few = HWY_MIN(lanes, n - at);
    Prepare(d, local(LoadFew<T>(d, mesh, indices, few)),
            local(LoadFew<T>(d, mesh, indices + 4, few)),
            local(LoadFew<T>(d, mesh, indices + 8, few)), at, block, extents);
  }
  // Beyond the last face a vector repeats it. These copies become faces of size 0 at distance 1,
  // which add nothing. Weights of 0 would fail where the last face has its centroid at the centre.
  for (double* row : {block.r[0], block.r[1], block.r[2], block.l[0], block.l[1], block.l[2],
                      block.longest, block.inverse, block.d2}) {
    for (std::size_t i = n; i < at; ++i) row[i] = 0;
  }
  const double nearest = hn::GetLane(hn::MinOfLanes(d, extents.nearest));
  return nearest > 0 ? hn::GetLane(hn::MaxOfLanes(d, extents.longest)) / nearest : kInfinity;
}

// Sums n faces, but for some that are left out. Writes their numbers to `left` and returns their
// count.
HWY_INLINE std::size_t SumBlock(const Block& block, std::size_t n, NormSums& result,
                                std::size_t* left) {
  const D d;
  const V zero = hn::Zero(d);
  LaneSums sums = {zero, zero, zero};
  std::size_t n_left = 0;
  for (std::size_t at = 0; at < n; at += hn::Lanes(d)) {
    const M others = AddTriangles(d, block, at, sums);
    if (HWY_LIKELY(hn::AllFalse(d, others))) continue;
    alignas(64) double flags[hn::MaxLanes(d)];
    hn::Store(hn::IfThenElseZero(others, hn::Set(d, 1.0)), d, flags);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      if (flags[i] > 0) left[n_left++] = at + i;
    }
  }
  const auto total = [&](V v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, v)); };
  result = {.first = total(sums.first), .third = total(sums.third), .volume6 = total(sums.volume6)};
  return n_left;
}

// Sums the areas of each group of n faces. Returns true if rounding may decide the normal of a
// face.
bool SumAreas(const Block& block, std::size_t n, std::uint32_t* sums) {
  double longest = 0;
  for (std::size_t at = 0; at < n; at += FaceSizes::kGroup) {
    double sum = 0;
    for (std::size_t i = at; i < HWY_MIN(n, at + FaceSizes::kGroup); ++i) {
      sum += block.twice_area[i];
      longest = HWY_MAX(longest, block.longest[i]);
    }
    *sums++ = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(sum) >> 32);
  }
  return longest == std::numeric_limits<double>::infinity();
}

template <class T>
HWY_INLINE void SumRangeOf(const MeshView& mesh, const Frame& frame, std::size_t begin,
                           std::size_t end, CompensatedSum* sums, FaceSizes* sizes) {
  Block block;
  std::size_t left[kBlock];
  std::uint32_t next_largest = LookAhead(mesh, begin, HWY_MIN(end, begin + kBlock));
  for (std::size_t first = begin; first < end; first += kBlock) {
    const std::size_t last = HWY_MIN(end, first + kBlock);
    const std::uint32_t largest = next_largest;
    if (largest >= mesh.n_vertices) validate(mesh);  // throws and names the index
    next_largest = LookAhead(mesh, last, HWY_MIN(end, last + kBlock));
    // A row of floats is read with 4 bytes beyond it, which the last row does not have.
    const bool whole = kWholeVectors && (sizeof(T) == 8 || largest + 1 < mesh.n_vertices);
    const double angle2 = PrepareBlock<T>(mesh, frame, first, last - first, whole, block);
    if (sizes != nullptr) {
      sizes->angles2[first / kBlock] = angle2;
      std::uint32_t* const areas = sizes->area_bits.data() + first / FaceSizes::kGroup;
      sizes->flat[first / kBlock] = SumAreas(block, last - first, areas) ? 1 : 0;
    }
    NormSums plain;
    const std::size_t n_left = SumBlock(block, last - first, plain, left);
    add_sums(plain, sums);
    for (std::size_t i = 0; i < n_left; ++i) {
      add_sums(norms_of_triangle(corners_of(mesh, frame, first + left[i])), sums);
    }
  }
}

void SumRange(const MeshView& mesh, const Frame& frame, std::size_t begin, std::size_t end,
              CompensatedSum* sums, FaceSizes* sizes) {
  if (mesh.coordinate == ScalarType::kFloat32) {
    SumRangeOf<float>(mesh, frame, begin, end, sums, sizes);
  } else {
    SumRangeOf<double>(mesh, frame, begin, end, sums, sizes);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SumRange);

namespace {

constexpr std::size_t kGrain = 32 * kBlock;  // chosen: about 50 us
// Grains of a part. Chosen: at least 0.2 ms of work, which threads take little time to hand over;
// at most some 20 ms, which is long beside a message. Between these limits there are kParts parts,
// enough for many threads.
constexpr std::size_t kLeastGrains = 4, kMostGrains = 256, kParts = 64;
static_assert(kBlock % FaceSizes::kGroup == 0);  // parts have whole groups

// Data that another process needs to compute parts.
struct NormsJob {
  Vec3 center;
  double scale = 1;
  bool with_sizes = false;
  std::size_t faces = 0;  // number of faces in a part

  Frame frame() const { return {.shift = -scale * center, .scale = scale}; }
};

NormSums sums_of(const MeshView& mesh, const Frame& frame, std::size_t begin, std::size_t end,
                 FaceSizes* sizes) {
  CompensatedSum sums[3];
  HWY_DYNAMIC_DISPATCH(SumRange)(mesh, frame, begin, end, sums, sizes);
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

void make_room(std::size_t n_faces, double scale, FaceSizes& sizes) {
  sizes.scale = scale;
  sizes.area_bits.resize((n_faces + FaceSizes::kGroup - 1) / FaceSizes::kGroup);
  sizes.angles2.resize((n_faces + kBlock - 1) / kBlock);
  sizes.flat.resize(sizes.angles2.size());
}

ExactNorms norms_of(const std::vector<NormSums>& parts, double scale) {
  CompensatedSum sums[3];
  for (const NormSums& part : parts) add_sums(part, sums);
  return {.radius_squared = sums[0].value() / 2 / (scale * scale),
          .solid_angle = sums[1].value() / 2,
          .volume = sums[2].value() / 6 / (scale * scale * scale)};
}

std::size_t triangles_of_part(std::size_t n_faces) {
  const std::size_t grains = n_faces / kGrain / kParts;
  return kGrain * std::clamp(grains, kLeastGrains, kMostGrains);
}

// Takes the faces of a part as a mesh, and returns its sums and sizes as bytes.
std::string work(const MeshView& mesh, const NormsJob& job, std::size_t part) {
  MeshView some = mesh;
  some.faces += part * job.faces * mesh.face_stride;
  some.n_faces = std::min(job.faces, mesh.n_faces - part * job.faces);
  FaceSizes sizes;
  if (job.with_sizes) make_room(some.n_faces, job.scale, sizes);
  std::vector<NormSums> grains;
  for (std::size_t at = 0; at < some.n_faces; at += kGrain) {
    ask_cancel();
    grains.push_back(sums_of(some, job.frame(), at, std::min(some.n_faces, at + kGrain),
                             job.with_sizes ? &sizes : nullptr));
  }
  ByteWriter writer;
  writer.array(std::span<const NormSums>(grains));
  writer.array(std::span<const std::uint32_t>(sizes.area_bits));
  writer.array(std::span<const double>(sizes.angles2));
  writer.array(std::span<const std::uint8_t>(sizes.flat));
  return writer.take();
}

// Puts the sums and sizes of a part, which begins with face `first`, in their places.
void take(std::size_t first, const std::string& bytes, std::vector<NormSums>& grains,
          FaceSizes* sizes) {
  const auto put = [](const auto& from, std::size_t at, auto& to) {
    if (at + from.size() > to.size()) ByteReader::refuse();
    std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
  };
  std::vector<NormSums> sums;
  std::vector<std::uint32_t> areas;
  std::vector<double> angles;
  std::vector<std::uint8_t> flat;
  ByteReader reader(bytes);
  reader.array(sums);
  reader.array(areas);
  reader.array(angles);
  reader.array(flat);
  reader.finish();
  put(sums, first / kGrain, grains);
  if (sizes == nullptr) return;
  put(areas, first / FaceSizes::kGroup, sizes->area_bits);
  put(angles, first / kBlock, sizes->angles2);
  put(flat, first / kBlock, sizes->flat);
}

}  // namespace

ExactNorms exact_norms(const MeshView& mesh, const Vec3& center, const Context& context,
                       FaceSizes* sizes, Executor* executor) {
  const double scale = unit_scale(mesh, center, context);
  if (sizes != nullptr) make_room(mesh.n_faces, scale, *sizes);
  const NormsJob job = {.center = center,
                        .scale = scale,
                        .with_sizes = sizes != nullptr,
                        .faces = triangles_of_part(mesh.n_faces)};
  const std::size_t parts = (mesh.n_faces + job.faces - 1) / job.faces;
  std::vector<NormSums> grains((mesh.n_faces + kGrain - 1) / kGrain);
  ByteWriter writer;
  writer.value(job);
  SharedProgress progress(context, "norms", 0, 1, static_cast<double>(parts));
  Threads here(context.threads);
  (executor != nullptr ? *executor : here)
      .run(
          {.count = parts, .job = kNormsJob, .input = writer.take()},
          [&](std::size_t part, int) { return work(mesh, job, part); },
          [&](std::size_t part, const std::string& bytes) {
            take(part * job.faces, bytes, grains, sizes);
            progress.add(1);
          });
  return norms_of(grains, scale);
}

Executor::Work norms_work(const MeshView& mesh, std::string_view input) {
  NormsJob wanted;
  ByteReader reader(input);
  reader.value(wanted);
  reader.finish();
  return [&mesh, wanted](std::size_t part, int) { return work(mesh, wanted, part); };
}

bool covers_once(const ExactNorms& norms) {
  // The solid angle is a whole multiple of 4 pi except for rounding.
  return std::abs(norms.solid_angle / (4 * std::numbers::pi) - 1) < 1e-3;
}

}  // namespace rholm
#endif  // HWY_ONCE
