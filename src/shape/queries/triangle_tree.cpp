#include "shape/queries/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "base/cancel.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/queries/closest_point.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFloatRounding = 0x1p-24;  // relative error of a conversion to float

// Farther away (in units of the mesh), squares of float coordinates come near to overflow at 2^128,
// and float boxes cannot separate triangles. Then every triangle is tried.
constexpr double kFarthest = 0x1p50;

// Coordinates of queries are limited to this modulus, so that their squares are finite in double.
constexpr double kDrawnIn = 0x1p400;

constexpr double kLargestRadius = 0x1p60;

constexpr std::size_t kManyTriangles = 8192;  // 1 ms: between two cancel checks
// Number of levels that all threads split together; chosen: the remaining 64 parts are even.
constexpr int kCommonLevels = 6;

double largest_component(const Vec3& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

// The middle of a triangle; coordinates -1 ... 1 are stored as 0 ... 2^32 - 1.
struct Middle {
  std::array<std::uint32_t, 3> at;
  std::uint32_t triangle;

  std::uint64_t along(int axis) const { return std::uint64_t{at[axis]} << 32 | triangle; }
};

std::uint32_t fixed_point(double x) {
  return static_cast<std::uint32_t>(std::clamp((x + 1) * 0x1p31, 0.0, 0x1p32 - 1));
}

int longest_axis(std::span<const Middle> middles) {
  std::array<std::uint32_t, 3> low = middles[0].at, high = low;
  for (const Middle& middle : middles) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], middle.at[axis]);
      high[axis] = std::max(high[axis], middle.at[axis]);
    }
  }
  const std::array<std::uint32_t, 3> length = {high[0] - low[0], high[1] - low[1],
                                               high[2] - low[2]};
  return static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
}

// Moves the n smallest to the front, as std::nth_element does. It takes a third of its time,
// because it has no unpredictable branches.
void select(std::span<Middle> middles, std::size_t n, int axis) {
  constexpr std::size_t kFew = 32;
  for (int round = 0; round < 64 && middles.size() > kFew; ++round) {
    std::array<std::uint64_t, 5> sample;
    for (std::size_t k = 0; k < 5; ++k) {
      sample[k] = middles[k * (middles.size() - 1) / 4].along(axis);
    }
    std::sort(sample.begin(), sample.end());
    const std::uint64_t pivot = sample[2];
    std::size_t below = 0;
    for (Middle& middle : middles) {
      const bool small = middle.along(axis) < pivot;
      std::swap(middle, middles[below]);
      below += small;
    }
    if (n < below) {
      middles = middles.first(below);
    } else {
      middles = middles.subspan(below);
      n -= below;
    }
  }
  std::nth_element(middles.begin(), middles.begin() + static_cast<std::ptrdiff_t>(n), middles.end(),
                   [&](const Middle& a, const Middle& b) { return a.along(axis) < b.along(axis); });
}

struct Part {
  std::span<Middle> middles;
  std::size_t whole = 0;  // at least the number of triangles: a power of two times a leaf's number
};

// Splits across the longest side of the box. The first part has a number of triangles equal to
// `whole`, a half of it, a quarter and so on. A leaf is not split.
std::array<Part, 2> halved(const Part& part) {
  const std::span<Middle> middles = part.middles;
  if (middles.size() <= kTreeWidth) return {part, Part{}};
  if (middles.size() > kManyTriangles) ask_cancel();
  std::size_t whole = part.whole;
  while (whole >= middles.size()) whole /= 2;
  select(middles, whole, longest_axis(middles));
  return {Part{middles.first(whole), whole}, Part{middles.subspan(whole), whole}};
}

// Splits a part down to leaves.
void split(const Part& part) {
  if (part.middles.size() <= kTreeWidth) return;
  for (const Part& half : halved(part)) split(half);
}

// Appends the parents of the nodes with these boxes, the first of which is `first`. Replaces
// `boxes` by the boxes of the parents.
void add_level(std::vector<FloatBox>& boxes, std::size_t first, std::vector<BoxGroup>& nodes) {
  std::vector<FloatBox> around((boxes.size() + kTreeWidth - 1) / kTreeWidth);
  for (std::size_t g = 0; g < around.size(); ++g) {
    BoxGroup& group = nodes.emplace_back();
    group.first = static_cast<std::uint32_t>(first + kTreeWidth * g);
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const std::size_t i = kTreeWidth * g + k;
      for (int axis = 0; axis < 3; ++axis) {
        group.low[axis][k] = group.high[axis][k] = kFloatInfinity;
        if (i >= boxes.size()) continue;
        group.low[axis][k] = boxes[i].low[axis];
        group.high[axis][k] = boxes[i].high[axis];
        around[g].low[axis] = std::min(around[g].low[axis], boxes[i].low[axis]);
        around[g].high[axis] = std::max(around[g].high[axis], boxes[i].high[axis]);
      }
    }
  }
  boxes = std::move(around);
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh, const Context& context)
    : TriangleTree(mesh, unit_frame(bounds(mesh.vertices)), {}, context) {}

TriangleTree::TriangleTree(const Mesh& portion, const UnitFrame& whole,
                           const PortionNumbers& numbers, const Context& context)
    : mesh_(portion), frame_(whole), numbers_(numbers) {
  if (portion.faces.empty()) return;
  sort_triangles(context);
  build(context);
}

// Sorts triangles so that each node has triangles that are near each other.
void TriangleTree::sort_triangles(const Context& context) {
  AlignedArray<Middle> middles(mesh_.faces.size());
  parallel_for(middles.size(), kManyTriangles, context, {},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t t = begin; t < end; ++t) {
                   const auto [a, b, c] = scaled_corners(mesh_, mesh_.faces[t], frame_.scale);
                   const Vec3 x = (a + b + c) / 3.0 - frame_.center;
                   middles[t] = {{fixed_point(x.x), fixed_point(x.y), fixed_point(x.z)},
                                 static_cast<std::uint32_t>(t)};
                 }
               });
  std::size_t whole = kTreeWidth;
  while (whole < middles.size()) whole *= 2;
  std::vector<Part> parts = {{{middles.data(), middles.size()}, whole}};
  for (int level = 0; level < kCommonLevels; ++level) {
    std::vector<std::array<Part, 2>> halves(parts.size());
    parallel_for(parts.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) halves[k] = halved(parts[k]);
    });
    parts.clear();
    for (const auto& half : halves) parts.insert(parts.end(), half.begin(), half.end());
  }
  parallel_for(parts.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) split(parts[k]);
  });
  order_.reserve(middles.size() + kTreeWidth);
  for (const Middle& middle : middles) order_.push_back(middle.triangle);
}

void TriangleTree::build(const Context& context) {
  const std::size_t n_leaves = (order_.size() + kTreeWidth - 1) / kTreeWidth;
  order_.resize(kTreeWidth * n_leaves, order_.back());  // the last triangle fills its leaf
  nodes_.leaves = AlignedArray<PlaneGroup>(n_leaves);
  std::vector<FloatBox> boxes(n_leaves);
  parallel_for(n_leaves, kManyTriangles / kTreeWidth, context, {},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t leaf = begin; leaf < end; ++leaf) {
                   boxes[leaf] = make_leaf(leaf, nodes_.leaves[leaf]);
                 }
               });
  for (std::size_t first = 0; boxes.size() > 1;) {
    const std::size_t n = boxes.size();
    add_level(boxes, first, nodes_.inner);
    first += n;
  }
}

FloatBox TriangleTree::make_leaf(std::size_t leaf, PlaneGroup& planes) const {
  FloatBox box;
  alignas(32) std::array<TreeRows3, 3> corners;
  for (std::size_t k = 0; k < kTreeWidth; ++k) {
    const Triangle& t = mesh_.faces[order_[kTreeWidth * leaf + k]];
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 q = frame_.to_local(mesh_.vertices[t[corner]]);
      const std::array<double, 3> row = {q.x, q.y, q.z};
      for (int axis = 0; axis < 3; ++axis) {
        const auto x = static_cast<float>(row[axis]);
        corners[corner][axis][k] = x;
        box.low[axis] = std::min(box.low[axis], x);
        box.high[axis] = std::max(box.high[axis], x);
      }
    }
  }
  set_planes(corners, planes);
  return box;
}

namespace {

Vec3 drawn_in(const Vec3& q) {
  const auto drawn = [](double x) { return std::clamp(x, -kDrawnIn, kDrawnIn); };
  return {drawn(q.x), drawn(q.y), drawn(q.z)};
}

struct ClosestSearch {
  ClosestSearch(const Mesh& searched, const UnitFrame& its_frame,
                const std::vector<std::uint32_t>& its_order, const PortionNumbers& its_numbers,
                const Vec3& point, double farthest, const ClosestSoFar& so_far)
      : mesh(searched),
        frame(its_frame),
        order(its_order),
        numbers(its_numbers),
        query(drawn_in(frame.to_local(point))),
        at_most(farthest * frame.scale),
        best2(so_far.square),
        number(so_far.triangle) {}

  const Mesh& mesh;
  const UnitFrame& frame;
  const std::vector<std::uint32_t>& order;
  PortionNumbers numbers;
  Vec3 query;      // in the frame
  double at_most;  // upper bound of the mesh's distance
  double best2;
  std::uint64_t number;  // number of the best triangle in the whole mesh
  Vec3 best = {};
  std::uint32_t triangle = 0;  // index in this mesh
  bool found = false;

  // Returns the search radius in float, with margins of walk_near() and of the squared radius, so
  // that no triangle at the best distance or nearer is lost.
  float radius() const {
    const double shifted =
        std::min(std::sqrt(best2), at_most) + 10 * kFloatRounding * (1 + largest_component(query));
    return static_cast<float>(std::min(shifted * (1 + 14 * kFloatRounding), kLargestRadius));
  }
};

// Returns the squared distance to a box. Rounded, it never exceeds the distance to a box inside.
double box_distance2(const Vec3& p, const Vec3& low, const Vec3& high) {
  const Vec3 gap = {std::max({low.x - p.x, p.x - high.x, 0.0}),
                    std::max({low.y - p.y, p.y - high.y, 0.0}),
                    std::max({low.z - p.z, p.z - high.z, 0.0})};
  return dot(gap, gap);
}
double box_distance2(const Vec3& p, const std::array<Vec3, 3>& c) {
  return box_distance2(p,
                       {std::min({c[0].x, c[1].x, c[2].x}), std::min({c[0].y, c[1].y, c[2].y}),
                        std::min({c[0].z, c[1].z, c[2].z})},
                       {std::max({c[0].x, c[1].x, c[2].x}), std::max({c[0].y, c[1].y, c[2].y}),
                        std::max({c[0].z, c[1].z, c[2].z})});
}

void take_if_nearer(std::uint32_t triangle, ClosestSearch& search) {
  // Corners are in the order of indices, so that an edge gives the same bits for both of its
  // triangles, and ties are exact.
  const auto [a, b, c] = search.mesh.faces[triangle];
  const std::uint32_t first = std::min({a, b, c}), last = std::max({a, b, c});
  const auto corner = [&](std::uint32_t vertex) {
    return search.frame.to_local(search.mesh.vertices[vertex]);
  };
  const std::array<Vec3, 3> corners = {corner(first), corner(a ^ b ^ c ^ first ^ last),
                                       corner(last)};
  const double box2 = box_distance2(search.query, corners);
  if (box2 > search.best2) return;
  const Vec3 candidate = closest_point_of_triangle(search.query, corners);
  const Vec3 offset = search.query - candidate;
  // Rounding may bring the point nearer than the box. The bound that excludes a box must hold for
  // all triangles in it; otherwise ties depend on which triangle comes first.
  const double d2 = std::max(dot(offset, offset), box2);
  const std::uint64_t number = search.numbers.first + triangle * search.numbers.step;
  const bool tie = d2 == search.best2 && number < search.number;
  if (!(d2 < search.best2) && !tie) return;
  search.best2 = d2;
  search.best = candidate;
  search.triangle = triangle;
  search.number = number;
  search.found = true;
}

float try_triangle(void* data, std::size_t leaf, std::size_t k) {
  auto& search = *static_cast<ClosestSearch*>(data);
  take_if_nearer(search.order[kTreeWidth * leaf + k], search);
  return search.radius();
}

// Finds the closest point of all triangles if it is closer than the best; returns its distance.
double search_all(ClosestSearch& search, const TriangleTreeNodes& nodes, const Vec3& point) {
  const Vec3 q = search.frame.to_local(point);
  if (!(largest_component(q) < kFarthest)) {
    const auto n = static_cast<std::uint32_t>(search.mesh.faces.size());
    for (std::uint32_t t = 0; t < n; ++t) take_if_nearer(t, search);
    const Vec3 offset = point - search.frame.to_shape(search.best);
    return std::hypot(offset.x, offset.y, offset.z);
  }
  walk_near(nodes, {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)},
            search.radius(), &try_triangle, &search);
  return norm(search.query - search.best) / search.frame.scale;
}

}  // namespace

bool may_be_closer(const Bounds& box, const UnitFrame& whole, const Vec3& point,
                   const ClosestSoFar& so_far) {
  return box_distance2(drawn_in(whole.to_local(point)), box.min, box.max) <= so_far.square;
}

bool TriangleTree::improve(const Vec3& point, double at_most, ClosestSoFar& so_far) const {
  if (mesh_.faces.empty()) return false;
  ClosestSearch search(mesh_, frame_, order_, numbers_, point, at_most, so_far);
  const double distance = search_all(search, nodes_, point);
  if (search.found) so_far = {search.best2, search.number, distance};
  return search.found;
}

ClosestPoint TriangleTree::closest_within(const Vec3& point, double at_most) const {
  if (mesh_.faces.empty() || !is_finite(point)) {
    throw Error(ErrorCode::kInvalidInput,
                "a closest point needs a mesh with at least 1 face and finite coordinates; "
                "this mesh has " +
                    std::to_string(mesh_.faces.size()) + " faces");
  }
  ClosestSearch search(mesh_, frame_, order_, numbers_, point, at_most, {});
  const double distance = search_all(search, nodes_, point);
  return {frame_.to_shape(search.best), search.triangle, distance};
}

ClosestPoint TriangleTree::closest(const Vec3& point) const {
  return closest_within(point, kInfinity);
}

// Uses as bound the last point's distance to the mesh, plus the distance of the two points.
std::vector<ClosestPoint> TriangleTree::closest(std::span<const Vec3> points) const {
  std::vector<ClosestPoint> found;
  found.reserve(points.size());
  double at_most = kInfinity;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0) at_most = found[k - 1].distance + norm(points[k] - points[k - 1]);
    found.push_back(closest_within(points[k], at_most));
  }
  return found;
}

void visit_closest(const TriangleTree& tree, std::span<const Vec3> points,
                   const ParallelStage& stage, const Context& context,
                   const std::function<void(std::size_t, const ClosestPoint&)>& visit) {
  constexpr std::size_t kGrain = 256;  // some 50 ms if the shapes are far apart
  parallel_for(points.size(), kGrain, context, stage, [&](std::size_t begin, std::size_t end) {
    std::size_t i = begin;
    for (const ClosestPoint& found : tree.closest(points.subspan(begin, end - begin))) {
      visit(i++, found);
    }
  });
}

std::vector<double> distances_to(const TriangleTree& tree, std::span<const Vec3> points,
                                 const ParallelStage& stage, const Context& context) {
  std::vector<double> distances(points.size());
  visit_closest(tree, points, stage, context,
                [&](std::size_t i, const ClosestPoint& found) { distances[i] = found.distance; });
  return distances;
}

}  // namespace rholm
