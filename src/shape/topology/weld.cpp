// Welds vertices. Identical vertices are found by a hash of their bits. Vertices within a tolerance
// are found by a tree over the distinct ones, which is walked against itself. Pairs of nodes
// farther apart than the tolerance are skipped. Pairs that lie wholly within it become one set at
// once. So both tiny tolerances and tolerances as large as the shape cost about n log n.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "shape/face.h"
#include "shape/topology/half_edges.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

// A node of the tree: points begin ... end of the order, and their bounding box.
struct Node {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t children = 0;  // index of the first of two children, 0 for a leaf
  bool joined = false;         // true if its points are already one set
  Bounds box;
};

class Joiner {
 public:
  Joiner(const std::vector<Vec3>& points, std::vector<std::uint32_t> chosen, double tolerance)
      : points_(points), order_(std::move(chosen)), tolerance_(tolerance), sets_(points.size()) {
    nodes_.push_back({});
    build(0, 0, static_cast<std::uint32_t>(order_.size()));
    join_within(0);
  }
  DisjointSets& sets() { return sets_; }

 private:
  static constexpr std::uint32_t kLeaf = 8;  // points; chosen: the time hardly depends on it

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Bounds box{.min = points_[order_[begin]], .max = points_[order_[begin]]};
    for (std::uint32_t i = begin; i < end; ++i) {
      poll_();
      const Vec3& p = points_[order_[i]];
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
    nodes_[node] = {.begin = begin, .end = end, .children = 0, .joined = false, .box = box};
    if (end - begin <= kLeaf) return;
    const Vec3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto along = [&](std::uint32_t i) {
      const Vec3& p = points_[i];
      return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    };
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) {
                       poll_();
                       return along(i) < along(j);
                     });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].children = children;
    build(children, begin, middle);
    build(children + 1, middle, end);
  }

  void join_all(Node& node) {
    if (node.joined) return;
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      poll_();
      sets_.unite(order_[node.begin], order_[i]);
    }
    node.joined = true;
  }

  void join_points(const Node& a, const Node& b) {
    for (std::uint32_t i = a.begin; i < a.end; ++i) {
      poll_();
      for (std::uint32_t j = b.begin; j < b.end; ++j) {
        if (norm(points_[order_[i]] - points_[order_[j]]) <= tolerance_) {
          sets_.unite(order_[i], order_[j]);
        }
      }
    }
  }

  void join_within(std::uint32_t index) {
    Node& node = nodes_[index];
    if (node.box.diagonal() <= tolerance_) {
      join_all(node);
    } else if (node.children == 0) {
      join_points(node, node);
    } else {
      join_within(node.children);
      join_within(node.children + 1);
      join_between(node.children, node.children + 1);
    }
  }

  void join_between(std::uint32_t ia, std::uint32_t ib) {
    Node& a = nodes_[ia];
    Node& b = nodes_[ib];
    const auto gap = [](double a0, double a1, double b0, double b1) {
      return std::max({0.0, b0 - a1, a0 - b1});
    };
    const Vec3 apart{gap(a.box.min.x, a.box.max.x, b.box.min.x, b.box.max.x),
                     gap(a.box.min.y, a.box.max.y, b.box.min.y, b.box.max.y),
                     gap(a.box.min.z, a.box.max.z, b.box.min.z, b.box.max.z)};
    if (norm(apart) > tolerance_) return;
    const Bounds both{
        .min = {std::min(a.box.min.x, b.box.min.x), std::min(a.box.min.y, b.box.min.y),
                std::min(a.box.min.z, b.box.min.z)},
        .max = {std::max(a.box.max.x, b.box.max.x), std::max(a.box.max.y, b.box.max.y),
                std::max(a.box.max.z, b.box.max.z)}};
    if (both.diagonal() <= tolerance_) {
      join_all(a);
      join_all(b);
      sets_.unite(order_[a.begin], order_[b.begin]);
    } else if (a.children == 0 && b.children == 0) {
      join_points(a, b);
    } else if (b.children == 0 || (a.children != 0 && a.box.diagonal() >= b.box.diagonal())) {
      join_between(a.children, ib);
      join_between(a.children + 1, ib);
    } else {
      join_between(ia, b.children);
      join_between(ia, b.children + 1);
    }
  }

  const std::vector<Vec3>& points_;
  std::vector<std::uint32_t> order_;
  double tolerance_;
  DisjointSets sets_;
  std::vector<Node> nodes_;
  CancelPoll poll_;
};

// Returns for every vertex the vertex that it becomes.
std::vector<std::uint32_t> representatives(const std::vector<Vec3>& vertices, double tolerance) {
  std::vector<std::uint32_t> first = first_identical(vertices);
  if (tolerance == 0 || vertices.empty()) return first;
  std::vector<std::uint32_t> distinct;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) distinct.push_back(i);
  }
  // Scales the vertices, so that squares of distances stay in range.
  const UnitFrame frame = unit_frame(bounds(vertices));
  std::vector<Vec3> scaled(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) scaled[i] = frame.scale * vertices[i];
  Joiner joiner(scaled, std::move(distinct), tolerance * frame.scale);
  for (std::uint32_t& i : first) i = joiner.sets().find(i);
  return first;
}

// Copies the vertices that triangles use, in their order.
void drop_unused(const Mesh& mesh, std::vector<Triangle>& triangles, Mesh& out) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) place[v] = 0;
  }
  for (const Attribute& a : mesh.attributes) {
    out.attributes.push_back({.name = a.name, .type = a.type, .values = {}});
  }
  CancelPoll poll;
  for (std::size_t v = 0; v < place.size(); ++v) {
    poll();
    if (place[v] == kUnused) continue;
    place[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(mesh.vertices[v]);
    for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
      out.attributes[k].values.push_back(mesh.attributes[k].values[v]);
    }
  }
  for (Triangle& t : triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
  out.faces = std::move(triangles);
}

}  // namespace

Welded weld(const Mesh& mesh, double tolerance) {
  validate(mesh);
  if (!(tolerance >= 0)) {
    throw Error(ErrorCode::kInvalidInput, "the tolerance of welding is " +
                                              std::to_string(tolerance) +
                                              ", it must be zero or positive");
  }
  const std::vector<std::uint32_t> kept = representatives(mesh.vertices, tolerance);
  Welded result;
  for (std::uint32_t i = 0; i < kept.size(); ++i) result.merged_vertices += kept[i] != i;
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.faces.size());
  CancelPoll poll;
  for (const Triangle& t : mesh.faces) {
    poll();
    const Triangle welded{kept[t[0]], kept[t[1]], kept[t[2]]};
    if (has_repeated_corner(welded)) {
      ++result.collapsed_faces;
    } else {
      triangles.push_back(welded);
    }
  }
  drop_unused(mesh, triangles, result.mesh);
  return result;
}

Outward outward(const Mesh& mesh, double tolerance) {
  Outward result{.welded = weld(mesh, tolerance)};
  Mesh& welded = result.welded.mesh;
  // The volume of an open mesh has no meaning. inspect() costs more, so the volume is tested first.
  result.flipped = enclosed_volume(welded) < 0 && inspect(welded).inside_out;
  if (result.flipped) flip(welded);
  return result;
}

}  // namespace rholm
