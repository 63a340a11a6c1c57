#include "surface/field/cap_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "atlas/cap/cap_support.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "base/poison.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surface/field/cap_field.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/opened_sphere-inl.h"
#include "surface/field/cap_lane.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Holds a cap in units of steps, relative to the first node of a block.
struct LaneCap {
  const CapLane& cap;
  V sx, sy, sz;  // position of the seed

  HWY_INLINE LaneCap(D d, const CapLane& c, const Vec3& first) : cap(c) {
    const Vec3 s = c.seed - first;
    sx = hn::Set(d, static_cast<float>(s.x));
    sy = hn::Set(d, static_cast<float>(s.y));
    sz = hn::Set(d, static_cast<float>(s.z));
  }
};

// Returns the blend weight: (1 - s^2)^3, or the quadratic B-spline of t = 3 s / 2
// over its value at 0. The spline is 3/4 - t^2 up to t = 1/2, then (3/2 - t)^2 / 2.
HWY_INLINE V WeightAt(D d, bool spline, V near) {
  if (!spline) return hn::Mul(near, hn::Mul(near, near));
  const V square = hn::Sub(hn::Set(d, 1.0f), near);
  const V rest = hn::Sub(hn::Set(d, 1.0f), hn::Sqrt(hn::Max(square, hn::Zero(d))));
  const V inner = hn::NegMulAdd(hn::Set(d, 3.0f), square, hn::Set(d, 1.0f));
  const V outer = hn::Mul(hn::Set(d, 1.5f), hn::Mul(rest, rest));
  return hn::IfThenElse(hn::Lt(square, hn::Set(d, 1.0f / 9)), inner, outer);
}

// Holds a cap's potential g and blend weight w at points, and the normal in space if requested.
struct Contribution {
  V g, w;
  V nx, ny, nz;
};

// Position of points relative to a cap: `at` in its frame, `near` = 1 - s^2 of its
// support. `within` is true inside the support and near enough to the tangent plane.
struct Place {
  Lanes3<V> at;
  V near;
  M within;
};

// Evaluates the quadratic form of the support's ellipse, with the height as third axis.
HWY_INLINE V FormOf(D d, const CapLane& cap, V p, V q, V height) {
  V square =
      hn::MulAdd(hn::Set(d, cap.xx), hn::Mul(p, p), hn::Mul(hn::Set(d, cap.xy2), hn::Mul(p, q)));
  square = hn::MulAdd(hn::Set(d, cap.yy), hn::Mul(q, q), square);
  return hn::MulAdd(hn::Set(d, cap.hh), hn::Mul(height, height), square);
}

HWY_INLINE Place PlaceOf(D d, const LaneCap& lane, V px, V py, V pz) {
  const CapLane& cap = lane.cap;
  const V one = hn::Set(d, 1.0f);
  const V dx = hn::Sub(px, lane.sx), dy = hn::Sub(py, lane.sy), dz = hn::Sub(pz, lane.sz);
  Place place;
  place.at = ToFrame(d, cap.frame, dx, dy, dz);
  const V p = hn::Sub(place.at.x, hn::Set(d, cap.px)), q = hn::Sub(place.at.y, hn::Set(d, cap.py));
  place.near = hn::Sub(one, FormOf(d, cap, p, q, place.at.z));
  place.within =
      hn::And(hn::Gt(place.near, hn::Zero(d)), hn::Lt(hn::Abs(place.at.z), hn::Set(d, cap.reach)));
  return place;
}

template <bool kNormals>
HWY_INLINE void Contribute(D d, const CapLane& cap, const Place& place, Contribution& own) {
  const V one = hn::Set(d, 1.0f);
  const CapRay<V> ray = RayTo(d, cap.frame, place.at);
  const OpenedPlace<V> opened = Open(d, cap.frame, ray);
  const LowSum<V> phi = cap.by_powers
                            ? SumPowers<kSmallDegree>(d, cap.coefficients, opened.at)
                            : SumLowHarmonics(d, cap.degree, cap.even, cap.coefficients, opened.at);
  const CapLevel<V> here = LevelOf(d, cap.frame, opened, phi);
  own.g = Potential(d, cap.frame, ray, here);
  const V band = hn::Mul(own.g, hn::Set(d, cap.inverse_band));
  const V rest = hn::NegMulAdd(band, band, one);
  const M counts =
      hn::And(hn::And(place.within, hn::Gt(rest, hn::Zero(d))), HasPotential(d, ray, here));
  own.w = hn::IfThenElseZero(counts, hn::Mul(WeightAt(d, cap.spline, place.near),
                                             hn::Mul(hn::Set(d, cap.trust), hn::Mul(rest, rest))));
  if (cap.noisy) own.w = hn::Mul(own.w, hn::Mul(here.flatness, here.flatness));
  own.g = hn::IfThenElseZero(counts, own.g);
  if constexpr (kNormals) {
    const Lanes3<V> normal = NormalOf(d, DirectionOf(d, ray), opened, here);
    own.nx = hn::IfThenElseZero(counts, FromFrame(d, cap.frame, 0, normal));
    own.ny = hn::IfThenElseZero(counts, FromFrame(d, cap.frame, 1, normal));
    own.nz = hn::IfThenElseZero(counts, FromFrame(d, cap.frame, 2, normal));
  }
}

// Lists the indices of a block's nodes within a cap and returns their number.
// Each lane handles one row along x; the support and the slab at the tangent
// plane cut it in one interval. `chosen` needs room for one more row or vector.
HWY_INLINE std::size_t NodesWithin(D d, const LaneCap& lane, const NodeSlices& slices,
                                   std::int32_t* chosen) {
  const hn::RebindToSigned<D> di;
  const CapLane& cap = lane.cap;
  const auto ascending = hn::Iota(di, 0);
  alignas(64) std::int32_t first[16], width[16];
  std::size_t count = 0;
  const std::size_t rows = 8 * slices.end;
  for (std::size_t r = 8 * slices.first / hn::Lanes(d) * hn::Lanes(d); r < rows;
       r += hn::Lanes(d)) {
    const auto row = hn::Add(ascending, hn::Set(di, static_cast<std::int32_t>(r)));
    const V y = hn::ConvertTo(d, hn::And(row, hn::Set(di, 7)));
    const V z = hn::ConvertTo(d, hn::ShiftRight<3>(row));
    // Along a row, the form is square x^2 + 2 half x + rest.
    const Lanes3<V> at =
        ToFrame(d, cap.frame, hn::Neg(lane.sx), hn::Sub(y, lane.sy), hn::Sub(z, lane.sz));
    const V p = hn::Sub(at.x, hn::Set(d, cap.px)), q = hn::Sub(at.y, hn::Set(d, cap.py));
    const V half = Dot(d, cap.row[0], cap.row[1], cap.row[2], p, q, at.z);
    const V rest = hn::Sub(FormOf(d, cap, p, q, at.z), hn::Set(d, 1.0f));
    const V root = hn::NegMulAdd(hn::Set(d, cap.row_square), rest, hn::Mul(half, half));
    const V inverse = hn::Set(d, 1 / cap.row_square);
    const V reach = hn::Mul(hn::Sqrt(hn::Max(root, hn::Zero(d))), inverse);
    const V middle = hn::Mul(hn::Neg(half), inverse);
    const V crossing = hn::Mul(at.z, hn::Set(d, -cap.row_crossing));
    const V slab = hn::Set(d, cap.reach * std::abs(cap.row_crossing));
    const V low = hn::Max(hn::Sub(middle, reach), hn::Sub(crossing, slab));
    const V high = hn::Min(hn::Add(middle, reach), hn::Add(crossing, slab));
    const auto clamped = [&](V x) HWY_ATTR {
      return hn::ConvertTo(di, hn::Min(hn::Max(x, hn::Zero(d)), hn::Set(d, 8.0f)));
    };
    const auto begin = clamped(hn::Ceil(low));
    const auto end = clamped(
        hn::IfThenElseZero(hn::Gt(root, hn::Zero(d)), hn::Add(hn::Floor(high), hn::Set(d, 1.0f))));
    const auto some = hn::Gt(end, begin);
    if (hn::AllFalse(di, some)) continue;
    hn::Store(hn::Add(begin, hn::ShiftLeft<3>(row)), di, first);
    hn::Store(hn::IfThenElseZero(some, hn::Sub(end, begin)), di, width);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
      for (std::size_t j = 0; j < 8; j += hn::Lanes(di)) {
        const auto from = hn::Set(di, first[k] + static_cast<std::int32_t>(j));
        hn::StoreU(hn::Add(ascending, from), di, chosen + count + j);
      }
      count += static_cast<std::size_t>(width[k]);
    }
  }
  return count;
}

void FillBlock(const CapLane* caps, const std::uint32_t* list, std::size_t n_caps,
               const Vec3& first_node, double step, float* values, std::uint64_t* doubtful) {
  const D d;
  const hn::RebindToSigned<D> di;
  const hn::CappedTag<float, 2> both;
  // Pairs (w g, w) of each node.
  alignas(64) float sums[2 * 512], own[2 * 16];
  std::int32_t chosen[512 + 16];
  for (std::size_t i = 0; i < 2 * 512; i += hn::Lanes(d)) hn::Store(hn::Zero(d), d, sums + i);
  for (std::size_t c = 0; c < n_caps; ++c) {
    const CapLane& cap = caps[list[c]];
    const LaneCap lane(d, cap, first_node);
    const std::size_t n = NodesWithin(d, lane, slices_near(cap, first_node), chosen);
    hn::StoreU(hn::Zero(di), di, chosen + n);
    for (std::size_t first = 0; first < n; first += hn::Lanes(d)) {
      const auto index = hn::LoadU(di, chosen + first);
      const auto coordinate = [&](auto bits) HWY_ATTR {
        return hn::ConvertTo(d, hn::And(bits, hn::Set(di, 7)));
      };
      const Place place = PlaceOf(d, lane, coordinate(index), coordinate(hn::ShiftRight<3>(index)),
                                  coordinate(hn::ShiftRight<6>(index)));
      Contribution part{};
      Contribute<false>(d, cap, place, part);
      hn::StoreInterleaved2(hn::Mul(part.w, part.g), part.w, d, own);
      const std::size_t end = std::min(n - first, hn::Lanes(d));
      for (std::size_t k = 0; k < end; ++k) {
        float* const to = sums + std::ptrdiff_t{2} * chosen[first + k];
        for (std::size_t j = 0; j < 2; j += hn::Lanes(both)) {
          const auto more = hn::Load(both, own + 2 * k + j);
          hn::Store(hn::Add(hn::Load(both, to + j), more), both, to + j);
        }
      }
    }
  }
  const V near = hn::Set(d, static_cast<float>(kDoubtfulSteps));
  for (std::size_t i = 0; i < 512; i += hn::Lanes(d)) {
    V g, w;
    hn::LoadInterleaved2(d, sums + 2 * i, g, w);
    g = hn::Div(g, w);
    const M known = hn::Gt(w, hn::Set(d, kNoWeight));
    hn::StoreU(hn::IfThenElse(known, hn::Mul(g, hn::Set(d, static_cast<float>(step))),
                              hn::Set(d, BlockGrid::kUnknown)),
               d, values + i);
    const M weak =
        hn::And(hn::And(known, hn::Lt(w, hn::Set(d, kDoubtfulWeight))), hn::Lt(hn::Abs(g), near));
    if (hn::AllFalse(d, weak)) continue;
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, weak, bytes);
    doubtful[i >> 6] |= (bytes[0] | (std::uint64_t{bytes[1]} << 8)) << (i & 63);
  }
}

// Sums the caps at scattered points, given in steps from the block's first
// node. `sums` has five rows: w g, w, and the three components of w n.
void ContributeAt(const CapLane* caps, const std::uint32_t* list, std::size_t n_caps,
                  const Vec3& first_node, const float* points, std::size_t n, std::size_t stride,
                  float* sums) {
  const D d;
  for (std::size_t row = 0; row < 5; ++row) {
    for (std::size_t i = 0; i < n; i += hn::Lanes(d))
      hn::Store(hn::Zero(d), d, sums + row * stride + i);
  }
  for (std::size_t c = 0; c < n_caps; ++c) {
    const LaneCap lane(d, caps[list[c]], first_node);
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      const Place place =
          PlaceOf(d, lane, hn::Load(d, points + i), hn::Load(d, points + stride + i),
                  hn::Load(d, points + 2 * stride + i));
      if (hn::AllFalse(d, place.within)) continue;
      Contribution own{};
      Contribute<true>(d, lane.cap, place, own);
      const auto add = [&](std::size_t row, V value) HWY_ATTR {
        float* const at = sums + row * stride + i;
        hn::Store(hn::MulAdd(own.w, value, hn::Load(d, at)), d, at);
      };
      add(0, own.g);
      add(1, hn::Set(d, 1.0f));
      add(2, own.nx);
      add(3, own.ny);
      add(4, own.nz);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(FillBlock);
HWY_EXPORT(ContributeAt);

// Least slope of a row across the tangent plane; flatter rows count as this steep.
constexpr double kFlat = 1e-4;

struct Lanes {
  AlignedArray<CapLane> caps;
  AlignedArray<float> coefficients;
};

Lanes make_lanes(const Atlas& atlas, const CapBands& bands, const BlockGrid& grid,
                 const Context& context) {
  const double step = grid.step;
  Lanes lanes{AlignedArray<CapLane>(atlas.caps.size()),
              AlignedArray<float>(atlas.coefficients.size())};
  const auto make_lane = [&](std::size_t c) {
    const Cap& cap = atlas.caps[c];
    CapLane& lane = lanes.caps[c];
    const double band = bands[c];
    const CapFrame& f = cap.frame;
    lane.seed = (f.seed() - grid.origin) / step;
    lane.frame = lane_frame<float>(f, step);
    const double support = f.support / step;
    const double step2 = step * step;
    lane.px = static_cast<float>(cap.where.px / step),
    lane.py = static_cast<float>(cap.where.py / step);
    lane.xx = static_cast<float>(cap.where.xx * step2),
    lane.yy = static_cast<float>(cap.where.yy * step2);
    lane.xy2 = static_cast<float>(2 * cap.where.xy * step2);
    lane.hh = static_cast<float>(1 / (support * support));
    lane.reach = static_cast<float>((band + cap.deviation) / step);
    // A disc of radius e and half thickness t across n reaches e sqrt(1 - n_z^2) + t |n_z| along z.
    const Vec3 n = f.z;
    const double edge = longer_half_axis(cap.where) / step;
    lane.middle = (support_middle(cap).z - grid.origin.z) / step;
    lane.extent = static_cast<float>(edge * std::sqrt(std::max(0.0, 1 - n.z * n.z)) +
                                     lane.reach * std::abs(n.z));
    const double x = f.x.x, y = f.y.x;
    lane.row[0] = static_cast<float>(step2 * (cap.where.xx * x + cap.where.xy * y));
    lane.row[1] = static_cast<float>(step2 * (cap.where.xy * x + cap.where.yy * y));
    lane.row[2] = static_cast<float>(lane.hh * n.x);
    lane.row_square = static_cast<float>(lane.row[0] * x + lane.row[1] * y + lane.row[2] * n.x);
    lane.row_crossing = static_cast<float>(1 / std::copysign(std::max(kFlat, std::abs(n.x)), n.x));
    lane.inverse_band = static_cast<float>(step / band);
    lane.trust = static_cast<float>(cap.weight);
    lane.degree = cap.degree;
    lane.spline = atlas.blend == CapBlend::kSpline;
    lane.noisy = atlas.noise > 0;
    lane.even = cap.basis == CapBasis::kEven;
    lane.by_powers = !lane.even && cap.degree == kSmallDegree;
    const std::span<const double> own = atlas.coefficients_of(cap);
    float* const coefficients = lanes.coefficients.data() + cap.first;
    lane.coefficients = coefficients;
    if (lane.by_powers) {
      std::array<double, low_index(kSmallDegree + 1, 0)> powers;
      to_powers(kSmallDegree, own.data(), powers.data());
      std::copy(powers.begin(), powers.end(), coefficients);
    } else {
      std::copy(own.begin(), own.end(), coefficients);
    }
  };
  parallel_for(atlas.caps.size(), 256, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) make_lane(c);
  });
  return lanes;
}

// Returns the first node of a block, in steps from the grid's origin.
Vec3 first_node(const BlockGrid& grid, std::size_t block) {
  const BlockCoordinates& b = grid.blocks[block];
  return {8.0 * b[0], 8.0 * b[1], 8.0 * b[2]};
}

}  // namespace

NodeSlices slices_near(const CapLane& cap, const Vec3& first_node) {
  const double z = cap.middle - first_node.z;
  const auto clamped = [](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, 8.0)); };
  return {clamped(std::ceil(z - cap.extent)), clamped(std::floor(z + cap.extent) + 1)};
}

std::vector<Disc> discs_of(const Atlas& atlas, const CapBands& bands) {
  std::vector<Disc> discs;
  discs.reserve(atlas.caps.size());
  for (const Cap& cap : atlas.caps) {
    discs.push_back({support_middle(cap), cap.frame.z, longer_half_axis(cap.where),
                     bands[discs.size()] + cap.deviation});
  }
  return discs;
}

namespace {

// Calls visit(block) for each block of the grid that a disc may
// touch. Each block is extended by one step beyond its nodes.
template <class Visit>
void visit_blocks(const BlockGrid& grid, const Disc& disc, const Visit& visit) {
  const double side = BlockGrid::kSide;
  const Vec3 c = (disc.center - grid.origin) / grid.step;
  const double radius = disc.radius / grid.step, thickness = disc.half_thickness / grid.step;
  // Block b with nodes 0 ... 8: 8 b <= c + radius and 8 b + 8 >= c - radius.
  const auto low = [&](double x) {
    return static_cast<std::int32_t>(std::ceil((x - radius - side) / side));
  };
  const auto high = [&](double x) {
    return static_cast<std::int32_t>(std::floor((x + radius) / side));
  };
  const double half = side / 2;
  const double spread =
      half * (std::abs(disc.normal.x) + std::abs(disc.normal.y) + std::abs(disc.normal.z));
  const auto outside_of = [&](double to) { return std::max(0.0, std::abs(to) - half); };
  for (std::int32_t bz = low(c.z); bz <= high(c.z); ++bz) {
    for (std::int32_t by = low(c.y); by <= high(c.y); ++by) {
      for (std::int32_t bx = low(c.x); bx <= high(c.x); ++bx) {
        const Vec3 to = Vec3{side * bx + half, side * by + half, side * bz + half} - c;
        if (std::abs(dot(disc.normal, to)) > thickness + spread) continue;
        const Vec3 outside{outside_of(to.x), outside_of(to.y), outside_of(to.z)};
        if (dot(outside, outside) > radius * radius) continue;
        const std::int32_t block = find_block(grid, {bx, by, bz});
        if (block != kNoBlock) visit(static_cast<std::size_t>(block));
      }
    }
  }
}

}  // namespace

CapLists list_caps(const BlockGrid& grid, const std::vector<Disc>& discs, const Context& context) {
  constexpr std::size_t kGrain = 256;
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // pairs of block and cap
  std::vector<Pairs> found((discs.size() + kGrain - 1) / kGrain);
  parallel_for(discs.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Pairs pairs;
    for (std::size_t c = begin; c < end; ++c) {
      visit_blocks(grid, discs[c], [&](std::size_t block) {
        pairs.emplace_back(static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(c));
      });
    }
    found[begin / kGrain] = std::move(pairs);
  });
  CapLists lists;
  lists.first.assign(grid.n_blocks() + 1, 0);
  for (const Pairs& pairs : found) {
    for (const auto& [block, cap] : pairs) ++lists.first[block + 1];
  }
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) lists.first[b + 1] += lists.first[b];
  lists.caps.resize(lists.first.back());
  std::vector<std::size_t> next(lists.first.begin(), lists.first.end() - 1);
  for (const Pairs& pairs : found) {
    for (const auto& [block, cap] : pairs) lists.caps[next[block]++] = cap;
  }
  return lists;
}

std::vector<std::uint64_t> fill_grid(const Atlas& atlas, const CapBands& bands,
                                     const CapLists& lists, BlockGrid& grid, const Context& context,
                                     const std::function<void()>& beside) {
  const Lanes lanes = make_lanes(atlas, bands, grid, context);
  std::vector<std::uint64_t> doubtful(8 * grid.n_blocks(), 0);
  constexpr std::size_t kGrain = 64;
  const std::size_t n = lists.first.size() - 1, chunks = (n + kGrain - 1) / kGrain;
  parallel_for(1 + chunks, 1, context, {.name = "grid"}, [&](std::size_t chunk, std::size_t) {
    if (chunk == 0) return beside ? beside() : void();
    const std::size_t end = std::min(n, chunk * kGrain);
    for (std::size_t b = (chunk - 1) * kGrain; b < end; ++b) {
      HWY_DYNAMIC_DISPATCH(FillBlock)
      (lanes.caps.data(), lists.caps.data() + lists.first[b], lists.first[b + 1] - lists.first[b],
       first_node(grid, b), grid.step, grid.block_values(b), &doubtful[8 * b]);
    }
  });
  return doubtful;
}

namespace {

// Largest move of a vertex in steps, and the squared length
// of the mean normal below which caps contradict each other.
constexpr double kLargestMove = 0.5;
constexpr double kLeastNormal = 0.25;

struct VertexRows {
  AlignedArray<float> points, sums;
  std::size_t stride = 0;

  void resize(std::size_t n) {
    if (n + 16 > stride) {
      stride = (2 * n + 63) / 16 * 16;
      points = AlignedArray<float>(3 * stride);
      sums = AlignedArray<float>(5 * stride);
    }
    poison_scratch(std::span(points.begin(), points.end()));
    poison_scratch(std::span(sums.begin(), sums.end()));
  }
};

// Adds the attributes nx, ny, nz to `mesh`, all zero.
std::array<double*, 3> add_vertex_normals(Mesh& mesh, const Context& context) {
  const std::size_t n = mesh.vertices.size();
  for (const char* name : {"nx", "ny", "nz"}) {
    mesh.attributes.push_back({name, ScalarType::kFloat32, {}});
    resize_large(mesh.attributes.back().values, n, room_for_copies(n), context);
  }
  const auto axis = mesh.attributes.end() - 3;
  return {axis[0].values.data(), axis[1].values.data(), axis[2].values.data()};
}

}  // namespace

void project_vertices(const Atlas& atlas, const CapBands& bands, const CapLists& lists,
                      const BlockGrid& grid, ExtractedSurface& surface, const Context& context) {
  const Lanes lanes = make_lanes(atlas, bands, grid, context);
  const std::array<double*, 3> normals = add_vertex_normals(surface.mesh, context);
  const std::size_t n_blocks = std::min(lists.first.size(), surface.first_vertex.size()) - 1;
  parallel_for(
      n_blocks, 64, context, {.name = "vertices"}, [&](std::size_t begin, std::size_t end) {
        VertexRows rows;
        for (std::size_t b = begin; b < end; ++b) {
          const std::size_t first = surface.first_vertex[b],
                            n = surface.first_vertex[b + 1] - first;
          if (n == 0) continue;
          rows.resize(n);
          const Vec3 at = first_node(grid, b);
          for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p = (surface.mesh.vertices[first + i] - grid.origin) / grid.step - at;
            rows.points[i] = static_cast<float>(p.x);
            rows.points[rows.stride + i] = static_cast<float>(p.y);
            rows.points[2 * rows.stride + i] = static_cast<float>(p.z);
          }
          HWY_DYNAMIC_DISPATCH(ContributeAt)
          (lanes.caps.data(), lists.caps.data() + lists.first[b],
           lists.first[b + 1] - lists.first[b], at, rows.points.data(), n, rows.stride,
           rows.sums.data());
          for (std::size_t i = 0; i < n; ++i) {
            const float* s = rows.sums.data() + i;
            const double w = s[rows.stride];
            if (!(w > kNoWeight)) continue;
            const Vec3 normal =
                Vec3{s[2 * rows.stride], s[3 * rows.stride], s[4 * rows.stride]} / w;
            // The move is a small part of a step, so the normal before the move is kept.
            const Vec3 unit = normalized(normal);
            normals[0][first + i] = unit.x, normals[1][first + i] = unit.y;
            normals[2][first + i] = unit.z;
            const bool filled = !surface.filled.empty() && surface.filled[first + i] != 0;
            const double square = dot(normal, normal);
            if (filled || !(square > kLeastNormal)) continue;
            const double g = std::clamp(s[0] / w, -kLargestMove, kLargestMove);
            surface.mesh.vertices[first + i] += -(g * grid.step / square) * normal;
          }
        }
      });
}

}  // namespace rholm
#endif
