#include "report/picture/light_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "report/picture/light_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kReadBeyond / kScouts>;
using V = hn::Vec<D>;

// Loads the values of consecutive cells of a row into a vector.
struct NextCells {
  HWY_INLINE V operator()(const float* from) const { return hn::LoadU(D(), from); }
};
// Loads the values of every second cell.
struct NextScouts {
  HWY_INLINE V operator()(const float* from) const {
    static_assert(kScouts == 2);
    V scouts, between;
    hn::LoadInterleaved2(D(), from, scouts, between);
    return scouts;
  }
};

struct Spots {
  V x, y, z, normal_x, normal_y, normal_z, side;
};
template <class Load>
HWY_INLINE Spots SpotsAt(const CellRow& row, std::ptrdiff_t cell, Load load) {
  const auto of = [&](CellNumber number) HWY_ATTR { return load(row.numbers[number] + cell); };
  return {of(kX), of(kY), of(kZ), of(kNormalX), of(kNormalY), of(kNormalZ), of(kSide)};
}

HWY_INLINE V SumOfProducts(V a, V b, V c, V d, V e, V f) {
  return hn::Add(hn::Add(hn::Mul(a, b), hn::Mul(c, d)), hn::Mul(e, f));
}

// Vector version of likeness().
HWY_INLINE V Likeness(const Spots& a, const Spots& b, float per_half_depth) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1);
  const V off = SumOfProducts(hn::Add(a.normal_x, b.normal_x), hn::Sub(b.x, a.x),
                              hn::Add(a.normal_y, b.normal_y), hn::Sub(b.y, a.y),
                              hn::Add(a.normal_z, b.normal_z), hn::Sub(b.z, a.z));
  const V cosine =
      SumOfProducts(a.normal_x, b.normal_x, a.normal_y, b.normal_y, a.normal_z, b.normal_z);
  const V near = hn::Max(zero, hn::Sub(one, hn::Mul(hn::Abs(off), hn::Set(d, per_half_depth))));
  const V along = hn::Max(zero, hn::Sub(one, hn::Mul(hn::Sub(one, cosine), hn::Set(d, 1 / kTurn))));
  return hn::Mul(hn::Mul(hn::Max(zero, hn::Mul(a.side, b.side)), near), along);
}

void SumWindows(const CellRow& row, std::size_t n, float per_half_depth, WindowSums& sums) {
  const D d;
  const NextScouts load;
  for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
    const auto cell = static_cast<std::ptrdiff_t>(kScouts * k);
    const Spots here = SpotsAt(row, cell, load);
    V all = hn::Zero(d), sky = all, key_all = all, key_free = all;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const std::ptrdiff_t there = cell + kScouts * (dy * row.width + dx);
        const V alike = Likeness(here, SpotsAt(row, there, load), per_half_depth);
        const V weight = hn::Mul(hn::Set(d, kTent[dx + kReach] * kTent[dy + kReach]), alike);
        all = hn::Add(all, weight);
        sky = hn::Add(sky, hn::Mul(weight, load(row.numbers[kSky] + there)));
        key_all = hn::Add(key_all, hn::Mul(weight, load(row.numbers[kKeyAll] + there)));
        key_free = hn::Add(key_free, hn::Mul(weight, load(row.numbers[kKeyFree] + there)));
      }
    }
    hn::StoreU(all, d, &sums.all[k]);
    hn::StoreU(sky, d, &sums.sky[k]);
    hn::StoreU(key_all, d, &sums.key_all[k]);
    hn::StoreU(key_free, d, &sums.key_free[k]);
  }
}

void FindEdges(const CellRow& row, std::size_t n, float per_half_depth, float step,
               std::uint8_t* edges) {
  const D d;
  const NextCells load;
  for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
    const auto cell = static_cast<std::ptrdiff_t>(k);
    const Spots here = SpotsAt(row, cell, load);
    const auto unseen = hn::Eq(here.side, hn::Zero(d));
    V largest = hn::Zero(d);
    auto other_thing = hn::Lt(largest, largest);
    for (const std::ptrdiff_t dy : {-row.width, std::ptrdiff_t{0}, row.width}) {
      for (std::ptrdiff_t there = cell + dy - 1; there <= cell + dy + 1; ++there) {
        for (const CellNumber root : {kRed, kGreen, kBlue}) {
          const float* const roots = row.numbers[root];
          largest = hn::Max(largest, hn::AbsDiff(load(roots + cell), load(roots + there)));
        }
        const auto none = hn::Eq(load(row.numbers[kSide] + there), hn::Zero(d));
        other_thing = hn::Or(other_thing, hn::Xor(none, unseen));
      }
    }
    V least_alike = hn::Set(d, 1);
    for (const std::ptrdiff_t there : {cell - 1, cell + 1, cell - row.width, cell + row.width}) {
      const V alike = Likeness(here, SpotsAt(row, there, load), per_half_depth);
      least_alike = hn::Min(least_alike, alike);
    }
    const auto crease = hn::AndNot(unseen, hn::Not(hn::Gt(least_alike, hn::Zero(d))));
    const auto edge = hn::Or(hn::Or(other_thing, crease), hn::Gt(largest, hn::Set(d, step)));
    alignas(32) float marks[kReadBeyond];
    hn::Store(hn::IfThenElseZero(edge, hn::Set(d, 1)), d, marks);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) edges[k + i] = marks[i] > 0;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(SumWindows);
HWY_EXPORT(FindEdges);

WindowSums sum_windows(const CellRow& row, std::size_t n, float per_half_depth) {
  const std::vector<float> zeros(n + kReadBeyond);
  WindowSums sums = {zeros, zeros, zeros, zeros};
  HWY_DYNAMIC_DISPATCH(SumWindows)(row, n, per_half_depth, sums);
  return sums;
}

std::vector<std::uint8_t> find_edges(const CellRow& row, std::size_t n, float per_half_depth,
                                     float step) {
  std::vector<std::uint8_t> edges(n + kReadBeyond);
  HWY_DYNAMIC_DISPATCH(FindEdges)(row, n, per_half_depth, step, edges.data());
  return edges;
}

}  // namespace rholm
#endif  // HWY_ONCE
