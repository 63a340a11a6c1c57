#include "shape/points/point_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "rholm/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/points/point_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

namespace rholm {
namespace {

// Orders by distance, then by index.
bool nearer(const Neighbor& a, const Neighbor& b);
// Moves the k nearest of n points to the front; returns the squared distance of the k-th.
float keep_nearest(Neighbor* found, std::size_t n, std::size_t k);

}  // namespace
}  // namespace rholm

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

// Returns squared distances of the points from the i-th on.
HWY_INLINE V SquareTo(const PointTree::View& tree, std::size_t i, const V (&at)[3]) {
  const D d;
  const V dx = hn::Sub(hn::LoadU(d, tree.x + i), at[0]);
  const V dy = hn::Sub(hn::LoadU(d, tree.y + i), at[1]);
  const V dz = hn::Sub(hn::LoadU(d, tree.z + i), at[2]);
  return hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
}

// Appends the points of a leaf within radius2 of `at`. `out` has room for the leaf's
// points and one vector more.
HWY_INLINE std::size_t ScanLeaf(const PointTree::View& tree, std::uint32_t leaf, const V (&at)[3],
                                float radius2, Neighbor* out) {
  const D d;
  const hn::RebindToUnsigned<D> du;
  const std::size_t begin = tree.leaf_begin[leaf], end = tree.leaf_begin[leaf + 1];
  std::size_t n = 0;
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const V square = SquareTo(tree, i, at);
    const auto near = hn::And(hn::Le(square, hn::Set(d, radius2)), hn::FirstN(d, end - i));
    const auto index = hn::BitCast(d, hn::Iota(du, static_cast<std::uint32_t>(i)));
    // Points that are not near end up behind the near ones and are overwritten.
    hn::StoreInterleaved2(hn::Compress(square, near), hn::Compress(index, near), d,
                          reinterpret_cast<float*>(out + n));
    n += hn::CountTrue(d, near);
  }
  return n;
}

// Returns squared distances to the boxes of a wide node's children, from `first` on.
HWY_INLINE V BoxDistances(const float* boxes, const V (&at)[3], std::size_t first) {
  const D d;
  V square = hn::Zero(d);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const V below = hn::Sub(hn::LoadU(d, boxes + 16 * axis + first), at[axis]);
    const V above = hn::Sub(at[axis], hn::LoadU(d, boxes + 16 * (axis + 3) + first));
    const V outside = hn::Max(hn::Max(below, above), hn::Zero(d));
    square = hn::MulAdd(outside, outside, square);
  }
  return square;
}

// Returns the children of a wide node whose boxes come within radius2 of `at`, as bits.
HWY_INLINE unsigned NearChildren(const float* boxes, const V (&at)[3], float radius2) {
  const D d;
  unsigned bits = 0;
  for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
    const V square = BoxDistances(boxes, at, i);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Le(square, hn::Set(d, radius2)), bytes);
    bits |= (bytes[0] | (unsigned{bytes[1]} << 8)) << i;
  }
  return bits;
}

// Finds every point within radius2 of `at`, in the order of the tree. For k > 0 it finds at least
// the k nearest of them, in any order.
void Gather(const PointTree::View& tree, const float* at, float radius2, std::size_t k,
            std::vector<Neighbor>& found) {
  // Number of found points at which a radius that is far too large is reduced.
  const std::size_t many = k > 0 ? std::max<std::size_t>(64, 4 * k) : ~std::size_t{0};
  const D d;
  const V x[3] = {hn::Set(d, at[0]), hn::Set(d, at[1]), hn::Set(d, at[2])};
  // One frame per level: the children still to visit.
  struct Frame {
    std::uint32_t node;
    unsigned bits;
  } stack[9];
  // A vector initialises all elements that it grows by; most results fit into this array.
  constexpr std::size_t kFew = 256;
  Neighbor few[kFew];
  Neighbor* to = few;
  std::size_t n = 0, room = kFew;
  int depth = 0;
  stack[0] = {0, NearChildren(tree.boxes, x, radius2)};
  while (depth >= 0) {
    Frame& frame = stack[depth];
    if (frame.bits == 0) {
      --depth;
      continue;
    }
    const std::uint32_t child =
        16 * frame.node + static_cast<std::uint32_t>(std::countr_zero(frame.bits));
    frame.bits &= frame.bits - 1;
    if (depth + 1 == tree.levels) {
      const std::size_t most =
          n + hn::Lanes(d) + tree.leaf_begin[child + 1] - tree.leaf_begin[child];
      if (most > room) {
        room = 2 * most;
        found.resize(room);
        if (to == few) std::copy_n(few, n, found.data());
        to = found.data();
      }
      n += ScanLeaf(tree, child, x, radius2, to + n);
      if (n >= many) {
        radius2 = keep_nearest(to, n, k);
        n = k;
      }
      continue;
    }
    ++depth;
    stack[depth] = {
        child,
        NearChildren(tree.boxes + 96 * (std::size_t{tree.level_begin[depth]} + child), x, radius2)};
  }
  if (to == few) {
    found.assign(few, few + n);
  } else {
    found.resize(n);
  }
}

// Sorts n <= View::kMostRanked neighbours: the place of each is the number of nearer ones. Bits of
// positive numbers are in the order of the numbers, so the bits of the square, followed by the
// index, form one number to compare.
void SortByRank(Neighbor* found, std::size_t n) {
  const hn::CappedTag<std::int64_t, 8> d;
  alignas(64) std::int64_t keys[PointTree::View::kMostRanked], ranks[PointTree::View::kMostRanked];
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t bits = std::bit_cast<std::int32_t>(found[i].distance2);
    keys[i] = bits << 32 | found[i].index;
  }
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const auto own = hn::Load(d, keys + i);
    auto rank = hn::Zero(d);
    for (std::size_t j = 0; j < n; ++j) {
      rank = hn::Sub(rank, hn::VecFromMask(d, hn::Lt(hn::Set(d, keys[j]), own)));
    }
    hn::Store(rank, d, ranks + i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    found[ranks[i]] = {std::bit_cast<float>(static_cast<std::int32_t>(keys[i] >> 32)),
                       static_cast<std::uint32_t>(keys[i])};
  }
}

// Returns the place of the least of 16 numbers, and the first if several are least.
HWY_INLINE std::size_t LeastOf(const float* values, float& least) {
  const D d;
  V all = hn::Load(d, values);
  for (std::size_t i = hn::Lanes(d); i < 16; i += hn::Lanes(d)) {
    all = hn::Min(all, hn::Load(d, values + i));
  }
  const V lowest = hn::MinOfLanes(d, all);
  least = hn::GetLane(lowest);
  for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
    const auto found = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, values + i), lowest));
    if (found >= 0) return i + static_cast<std::size_t>(found);
  }
  return 0;
}

// Computes squared distances of points begin ... end - 1, at most 16; infinity behind the last.
HWY_INLINE void DistancesOf(const PointTree::View& tree, std::size_t begin, std::size_t end,
                            const V (&at)[3], float* squares) {
  const D d;
  const V none = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
    V square = none;
    if (begin + i < end) {
      const auto has = hn::FirstN(d, end - (begin + i));
      square = hn::IfThenElse(has, SquareTo(tree, begin + i, at), none);
    }
    hn::Store(square, d, squares + i);
  }
}

// Finds the nearest point if it is nearer than `best`; visits the nearest boxes first.
void Nearest(const PointTree::View& tree, const float* at, Neighbor& best) {
  const D d;
  const V x[3] = {hn::Set(d, at[0]), hn::Set(d, at[1]), hn::Set(d, at[2])};
  // Squared distances of boxes of a wide node on each level; infinity once a box is visited.
  alignas(64) float squares[10][16];
  std::uint32_t nodes[9] = {0};
  const auto enter = [&](int depth) HWY_ATTR {
    const std::size_t node = std::size_t{tree.level_begin[depth]} + nodes[depth];
    for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
      hn::Store(BoxDistances(tree.boxes + 96 * node, x, i), d, squares[depth] + i);
    }
  };
  enter(0);
  for (int depth = 0; depth >= 0;) {
    float least = 0;
    const std::size_t first = LeastOf(squares[depth], least);
    // Excludes infinity, which marks visited boxes, even if `best` is infinite.
    if (!(least <= best.distance2 && least < std::numeric_limits<float>::infinity())) {
      --depth;
      continue;
    }
    squares[depth][first] = std::numeric_limits<float>::infinity();
    const std::uint32_t child = 16 * nodes[depth] + static_cast<std::uint32_t>(first);
    if (depth + 1 < tree.levels) {
      nodes[++depth] = child;
      enter(depth);
      continue;
    }
    // Leaves may have one point more than 16.
    const std::size_t end = tree.leaf_begin[child + 1];
    for (std::size_t begin = tree.leaf_begin[child]; begin < end; begin += 16) {
      DistancesOf(tree, begin, end, x, squares[9]);
      Neighbor near{};
      near.index = static_cast<std::uint32_t>(begin + LeastOf(squares[9], near.distance2));
      if (nearer(near, best)) best = near;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Gather);
HWY_EXPORT(SortByRank);
HWY_EXPORT(Nearest);

// Largest mean number of points of a leaf: a vector of the widest machines.
constexpr std::size_t kLeafSize = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Returns the squared radius of a circle that holds k points at a density of points per area.
float radius2_for(double k, double density) {
  return static_cast<float>(k / (density * std::numbers::pi));
}

// Compares as nearer(); a type, so that sorting inlines it. Bits of
// numbers >= 0 keep their order.
struct Nearer {
  static std::uint64_t key(const Neighbor& near) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(near.distance2)} << 32 | near.index;
  }
  bool operator()(const Neighbor& a, const Neighbor& b) const { return key(a) < key(b); }
};

bool nearer(const Neighbor& a, const Neighbor& b) { return Nearer()(a, b); }

float keep_nearest(Neighbor* found, std::size_t n, std::size_t k) {
  if (n > k) std::nth_element(found, found + (k - 1), found + n, Nearer());
  return found[k - 1].distance2;
}

struct Box {
  std::array<float, 3> lower = {kInfinity, kInfinity, kInfinity};
  std::array<float, 3> upper = {-kInfinity, -kInfinity, -kInfinity};
  void add(const std::array<float, 3>& p) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], p[a]);
      upper[a] = std::max(upper[a], p[a]);
    }
  }
  std::size_t widest() const {
    std::size_t best = 0;
    for (std::size_t a = 1; a < 3; ++a) {
      if (upper[a] - lower[a] > upper[best] - lower[best]) best = a;
    }
    return best;
  }
};

}  // namespace

PointTree::PointTree(std::span<const Vec3> points, const Context& context) : order_(points.size()) {
  if (points.size() >= std::size_t{1} << 31) {
    throw Error(ErrorCode::kInvalidInput,
                std::to_string(points.size()) + " points are too many: 2147483647 is the limit");
  }
  Vec3 lower{kInfinity, kInfinity, kInfinity}, upper{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3& p : points) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  if (!points.empty()) middle_ = 0.5 * (lower + upper);
  // Coordinates are of order 1: their squares stay within single precision at every scale.
  const double extent = points.empty() ? 0 : norm(upper - lower);
  scale_ = extent > 0 ? 1 / extent : 1;
  std::vector<Item> items(points.size());
  parallel_for(items.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      items[i] = {local(points[i]), static_cast<std::uint32_t>(i)};
    }
  });
  split(items, context);
  store(items, context);
}

// Halves ranges along their widest extent until leaves are small. The tree is complete, so that a
// leaf's number determines its parents.
void PointTree::split(std::vector<Item>& items, const Context& context) {
  int depth = 0;
  while ((items.size() >> depth) > kLeafSize) ++depth;
  levels_ = std::max(1, (depth + 3) / 4);
  std::vector<std::uint32_t> begin = {0, static_cast<std::uint32_t>(items.size())};
  for (int level = 0; level < depth; ++level) {
    std::vector<std::uint32_t> finer(2 * begin.size() - 1);
    parallel_for(begin.size() - 1, std::max<std::size_t>(1, (begin.size() - 1) / 64), context, {},
                 [&](std::size_t first, std::size_t last) {
                   for (std::size_t j = first; j < last; ++j) {
                     const std::uint32_t middle = begin[j] + (begin[j + 1] - begin[j]) / 2;
                     finer[2 * j] = begin[j];
                     finer[2 * j + 1] = middle;
                     Box box;
                     for (std::uint32_t i = begin[j]; i < begin[j + 1]; ++i) box.add(items[i].at);
                     const std::size_t axis = box.widest();
                     std::nth_element(items.begin() + begin[j], items.begin() + middle,
                                      items.begin() + begin[j + 1],
                                      [axis](const Item& a, const Item& b) {
                                        return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis]
                                                                        : a.index < b.index;
                                      });
                   }
                 });
    finer.back() = begin.back();
    begin = std::move(finer);
  }
  leaf_begin_ = std::move(begin);
}

void PointTree::store(const std::vector<Item>& items, const Context& context) {
  const std::size_t n = items.size(), leaves = leaf_begin_.size() - 1;
  stride_ = n + kLeafSize;  // vectors may be read beyond the last point
  coordinates_ = AlignedArray<float>(3 * stride_);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t i = n; i < stride_; ++i) coordinates_[a * stride_ + i] = 0;
  }
  leaf_of_.resize(n);
  leaf_density_.resize(leaves);
  std::vector<float> flat(6 * leaves);
  parallel_for(leaves, 1024, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      Box box;
      for (std::uint32_t i = leaf_begin_[j]; i < leaf_begin_[j + 1]; ++i) {
        const Item& item = items[i];
        for (std::size_t a = 0; a < 3; ++a) coordinates_[a * stride_ + i] = item.at[a];
        order_[i] = item.index;
        leaf_of_[i] = static_cast<std::uint32_t>(j);
        box.add(item.at);
      }
      std::array<float, 3> extent{};
      for (std::size_t a = 0; a < 3; ++a) {
        extent[a] = box.upper[a] - box.lower[a];
        flat[6 * j + a] = box.lower[a];
        flat[6 * j + a + 3] = box.upper[a];
      }
      std::sort(extent.begin(), extent.end());
      const float least = 1e-6f;  // of the whole extent: a line or a point has no area
      const float area = std::max(extent[2], least) * std::max(extent[1], least);
      leaf_density_[j] = static_cast<float>(leaf_begin_[j + 1] - leaf_begin_[j]) / area;
    }
  });
  make_boxes(std::move(flat));
}

// Builds from the leaves up: 16 boxes form a wide node, and their hull is one box above.
void PointTree::make_boxes(std::vector<float> below) {
  const auto levels = static_cast<std::size_t>(levels_);
  std::size_t n_nodes = 0;
  for (std::size_t level = 0; level < levels; ++level) {
    level_begin_[level] = static_cast<std::uint32_t>(n_nodes);
    const std::size_t shift = 4 * (levels - level);
    n_nodes += (n_leaves() + (std::size_t{1} << shift) - 1) >> shift;
  }
  boxes_ = AlignedArray<float>(96 * n_nodes);
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = i % 96 < 48 ? kInfinity : -kInfinity;
  for (std::size_t level = levels; level-- > 0;) {
    const std::size_t n = below.size() / 6;
    std::vector<float> above;
    for (std::size_t j = 0; j < n; ++j) {
      if (j % 16 == 0) {
        for (int a = 0; a < 6; ++a) above.push_back(a < 3 ? kInfinity : -kInfinity);
      }
      float* const node = boxes_.data() + 96 * (level_begin_[level] + j / 16);
      for (std::size_t a = 0; a < 6; ++a) {
        const float side = below[6 * j + a];
        node[16 * a + j % 16] = side;
        float& whole = above[above.size() - 6 + a];
        whole = a < 3 ? std::min(whole, side) : std::max(whole, side);
      }
    }
    below = std::move(above);
  }
}

Vec3 PointTree::point(std::size_t i) const {
  return middle_ +
         Vec3{coordinates_[i], coordinates_[stride_ + i], coordinates_[2 * stride_ + i]} / scale_;
}

PointTree::View PointTree::view() const {
  return {coordinates_.data(),
          coordinates_.data() + stride_,
          coordinates_.data() + 2 * stride_,
          leaf_begin_.data(),
          boxes_.data(),
          levels_,
          level_begin_.data()};
}

// Widens a circle around `at` until it holds k points, then cuts to the k nearest.
void PointTree::search(const std::array<float, 3>& at, float radius2, std::size_t k,
                       std::vector<Neighbor>& found) const {
  k = std::min(k, size());
  found.clear();
  if (k == 0) return;
  const View tree = view();
  for (;;) {
    HWY_DYNAMIC_DISPATCH(Gather)(tree, at.data(), radius2, k, found);
    if (found.size() >= k) break;
    const float wanted =
        static_cast<float>(k) / static_cast<float>(std::max<std::size_t>(1, found.size()));
    radius2 *= std::clamp(1.3f * wanted, 1.5f, 8.0f);
  }
  if (found.size() <= PointTree::View::kMostRanked) {
    HWY_DYNAMIC_DISPATCH(SortByRank)(found.data(), found.size());
  } else {
    keep_nearest(found.data(), found.size(), k);
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(k), Nearer());
  }
  found.resize(k);
  const float unit2 = static_cast<float>(1 / (scale_ * scale_));
  for (Neighbor& neighbor : found) neighbor.distance2 *= unit2;
}

void PointTree::nearest_to(std::size_t i, std::size_t k, std::vector<Neighbor>& found) const {
  // Asks for a third more than the density suggests: rarely too few, not many too many.
  const float radius2 = radius2_for(1.35 * static_cast<double>(k), leaf_density_[leaf_of_[i]]);
  search({coordinates_[i], coordinates_[stride_ + i], coordinates_[2 * stride_ + i]}, radius2, k,
         found);
}

std::array<float, 3> PointTree::local(const Vec3& x) const {
  const Vec3 p = scale_ * (x - middle_);
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void PointTree::nearest(const Vec3& x, std::size_t k, std::vector<Neighbor>& found) const {
  found.clear();
  if (size() == 0) return;
  // Places farther than kFarthest extents are moved to that distance in the same direction. Their
  // squares leave single precision, in which all points are equally far from them.
  constexpr double kFarthest = 1e6;
  const auto largest = [](const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  };
  Vec3 place = x;
  if (!(scale_ * largest(0.5 * x - 0.5 * middle_) < kFarthest / 2)) {
    // Scales down first, because differences of huge coordinates are infinite.
    const double unit = std::max(largest(x), largest(middle_));
    const Vec3 far = x / unit - middle_ / unit;
    place = middle_ + kFarthest / scale_ / largest(far) * far;
  }
  const std::array<float, 3> at = local(place);
  // The radius is the distance to the whole cloud, plus a circle of mean density.
  double outside2 = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double out = std::max(0.0, std::abs(static_cast<double>(at[a])) - 0.5);
    outside2 += out * out;
  }
  const double circle2 = radius2_for(static_cast<double>(k), static_cast<double>(size()));
  search(at, static_cast<float>(1.2 * (outside2 + circle2)), k, found);
}

bool PointTree::nearest_within(const Vec3& x, double radius, Neighbor& found) const {
  const double r = radius * scale_;
  found = {static_cast<float>(r * r), std::numeric_limits<std::uint32_t>::max()};
  if (size() > 0) HWY_DYNAMIC_DISPATCH(Nearest)(view(), local(x).data(), found);
  found.distance2 *= static_cast<float>(1 / (scale_ * scale_));
  return found.index < size();
}

void PointTree::within(const Vec3& x, double radius, std::vector<Neighbor>& found) const {
  found.clear();
  if (size() == 0) return;
  const double r = radius * scale_;
  HWY_DYNAMIC_DISPATCH(Gather)(view(), local(x).data(), static_cast<float>(r * r), 0, found);
  const float unit2 = static_cast<float>(1 / (scale_ * scale_));
  for (Neighbor& neighbor : found) neighbor.distance2 *= unit2;
}

}  // namespace rholm
#endif
