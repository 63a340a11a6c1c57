#include "shape/repair/junctions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "base/cancel.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Most open edges of a vertex that are compared (chosen): a vertex of a solid has two open edges
// for each face with a junction there. Comparing all pairs stays cheap.
constexpr std::size_t kMostOpenEdges = 64;

bool has_corner(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

// Compares vertices and edges with allowance for rounding.
class RoundedVertices {
 public:
  RoundedVertices(const std::vector<Vec3>& vertices, const Vec3& error)
      : vertices_(vertices), doubt_(2 * error) {}

  double distance(std::uint32_t a, std::uint32_t b) const {
    return norm(vertices_[a] - vertices_[b]);
  }

  // Returns true if p may lie between a and b, and apart from both: some s in (0, 1) has p - a = s
  // (b - a) on each axis, within rounding.
  bool is_on_edge(std::uint32_t p, std::uint32_t a, std::uint32_t b) const {
    const Vec3 to = vertices_[p] - vertices_[a], way = vertices_[b] - vertices_[a];
    double low = 0, high = 1;
    narrow(to.x, way.x, doubt_.x, low, high);
    narrow(to.y, way.y, doubt_.y, low, high);
    narrow(to.z, way.z, doubt_.z, low, high);
    return low <= high && are_apart(p, a) && are_apart(p, b) && distance(p, a) < distance(a, b) &&
           distance(p, b) < distance(a, b);
  }

  // Returns true if a corner lies on the opposite edge.
  bool has_no_width(const Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_on_edge(t[k], t[(k + 1) % 3], t[(k + 2) % 3])) return true;
    }
    return false;
  }

 private:
  static void narrow(double to, double way, double doubt, double& low, double& high) {
    if (way == 0) {
      if (std::abs(to) > doubt) high = -1;
      return;
    }
    const double one = (to - doubt) / way, other = (to + doubt) / way;
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
  bool are_apart(std::uint32_t a, std::uint32_t b) const {
    const Vec3 d = vertices_[a] - vertices_[b];
    return std::abs(d.x) > doubt_.x || std::abs(d.y) > doubt_.y || std::abs(d.z) > doubt_.z;
  }

  const std::vector<Vec3>& vertices_;
  Vec3 doubt_;  // error of the difference of two vertices
};

// Drops triangles without width at edges that do not have two triangles, at first or after drops.
class ThinDrops {
 public:
  ThinDrops(const RoundedVertices& rounded, std::size_t n_vertices,
            std::vector<Triangle>& triangles)
      : rounded_(rounded),
        triangles_(triangles),
        half_edges_(sort_half_edges(n_vertices, triangles)) {}

  std::size_t run() {
    group();
    std::vector<std::uint32_t> waiting;
    CancelPoll poll;
    for (std::uint32_t e = 0; e < count_.size(); ++e) {
      if (count_[e] != 2) await(e, waiting);
    }
    std::vector<char> gone(triangles_.size(), 0);
    std::size_t dropped = 0;
    while (!waiting.empty()) {
      poll();
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      const auto is_whole = [&](std::uint32_t c) { return count_[edge_of_[c]] == 2; };
      if (gone[t] || (is_whole(3 * t) && is_whole(3 * t + 1) && is_whole(3 * t + 2)) ||
          !rounded_.has_no_width(triangles_[t])) {
        continue;
      }
      gone[t] = 1;
      ++dropped;
      for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
        if (--count_[edge_of_[c]] != 2) await(edge_of_[c], waiting);
      }
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!gone[t]) triangles_[kept++] = triangles_[t];
    }
    triangles_.resize(kept);
    return dropped;
  }

 private:
  void group() {
    edge_of_.resize(3 * triangles_.size());
    std::uint32_t first = 0;
    half_edges_.for_each_edge([&](std::uint32_t, std::span<const HalfEdge> same) {
      for (const HalfEdge& h : same) {
        edge_of_[h.corner()] = static_cast<std::uint32_t>(count_.size());
      }
      count_.push_back(static_cast<std::uint32_t>(same.size()));
      first_.push_back(first);
      first += count_.back();
    });
    first_.push_back(first);
  }
  void await(std::uint32_t e, std::vector<std::uint32_t>& waiting) const {
    for (std::uint32_t i = first_[e]; i < first_[e + 1]; ++i) {
      waiting.push_back(half_edges_.sorted[i].triangle());
    }
  }

  const RoundedVertices& rounded_;
  std::vector<Triangle>& triangles_;
  HalfEdges half_edges_;
  std::vector<std::uint32_t> edge_of_;  // edge of each half-edge
  std::vector<std::uint32_t> count_;    // for each edge: number of remaining triangles
  std::vector<std::uint32_t> first_;    // for each edge: index in half_edges_
};

class JunctionSplits {
 public:
  JunctionSplits(const RoundedVertices& rounded, std::size_t n_vertices,
                 std::vector<Triangle>& triangles)
      : rounded_(rounded), n_vertices_(n_vertices), triangles_(triangles) {}

  std::size_t run() {
    find_open_edges();
    if (open_.empty()) return 0;
    list_by_vertex();
    const std::size_t n = triangles_.size();
    std::vector<std::uint32_t> waiting;
    CancelPoll poll;
    for (std::uint32_t v = 0; v < n_vertices_; ++v) {
      poll();
      waiting.push_back(v);
      while (!waiting.empty()) {
        poll();
        const std::uint32_t from = waiting.back();
        waiting.pop_back();
        const auto pair = find_pair(from);
        if (!pair) continue;
        const std::uint32_t at = other_end(pair->shorter, from);
        split(*pair, from, at);
        waiting.insert(waiting.end(), {from, at});
      }
    }
    return triangles_.size() - n;
  }

 private:
  struct OpenEdge {
    std::uint32_t a = 0, b = 0, triangle = 0;
  };
  struct Pair {
    std::uint32_t longer = 0, shorter = 0;  // indices in open_
  };

  void find_open_edges() {
    sort_half_edges(n_vertices_, triangles_)
        .for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> same) {
          if (same.size() == 1) open_.push_back({smaller, same[0].larger(), same[0].triangle()});
        });
  }

  // A vertex never gets more open edges than it has now: after a split, the rest of the longer edge
  // takes the list entry of the shorter one.
  void list_by_vertex() {
    begin_.assign(n_vertices_ + 1, 0);
    for (const OpenEdge& e : open_) ++begin_[e.a + 1], ++begin_[e.b + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    count_.assign(n_vertices_, 0);
    listed_.resize(begin_.back());
    for (std::uint32_t e = 0; e < open_.size(); ++e) {
      for (const std::uint32_t v : {open_[e].a, open_[e].b}) listed_[begin_[v] + count_[v]++] = e;
    }
  }
  std::span<std::uint32_t> edges_of(std::uint32_t v) {
    return std::span(listed_).subspan(begin_[v], count_[v]);
  }
  void take_from_list(std::uint32_t v, std::uint32_t e) {
    const auto edges = edges_of(v);
    std::swap(*std::ranges::find(edges, e), edges.back());
    --count_[v];
  }

  std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    return open_[e].a == v ? open_[e].b : open_[e].a;
  }

  // Returns the nearest junction on an edge from v.
  std::optional<Pair> find_pair(std::uint32_t v) {
    std::optional<Pair> found;
    if (count_[v] > kMostOpenEdges) return found;
    double nearest = 0;
    for (const std::uint32_t longer : edges_of(v)) {
      const std::uint32_t b = other_end(longer, v);
      for (const std::uint32_t shorter : edges_of(v)) {
        const std::uint32_t p = other_end(shorter, v);
        if (p == b || has_corner(triangles_[open_[longer].triangle], p)) continue;
        const double distance = rounded_.distance(p, v);
        if ((found && distance >= nearest) || !rounded_.is_on_edge(p, v, b)) continue;
        found = {longer, shorter};
        nearest = distance;
      }
    }
    return found;
  }

  void split(const Pair& pair, std::uint32_t from, std::uint32_t at) {
    OpenEdge& rest = open_[pair.longer];
    const auto added = static_cast<std::uint32_t>(triangles_.size());
    Triangle near = triangles_[rest.triangle];
    std::ranges::replace(near, other_end(pair.longer, from), at);
    std::ranges::replace(triangles_[rest.triangle], from, at);
    triangles_.push_back(near);
    take_from_list(from, pair.longer);
    take_from_list(from, pair.shorter);
    // The third corner's edge to `from`, if open, belongs to the new triangle.
    for (const std::uint32_t e : edges_of(from)) {
      if (open_[e].triangle == rest.triangle) open_[e].triangle = added;
    }
    *std::ranges::find(edges_of(at), pair.shorter) = pair.longer;
    (rest.a == from ? rest.a : rest.b) = at;
  }

  const RoundedVertices& rounded_;
  std::size_t n_vertices_ = 0;
  std::vector<Triangle>& triangles_;
  std::vector<OpenEdge> open_;
  std::vector<std::uint32_t> begin_, count_, listed_;  // open edges of each vertex
};

}  // namespace

Junctions join_junctions(const std::vector<Vec3>& vertices, const Vec3& error,
                         std::vector<Triangle>& triangles) {
  const RoundedVertices rounded(vertices, error);
  Junctions found;
  found.thin = ThinDrops(rounded, vertices.size(), triangles).run();
  found.joined = JunctionSplits(rounded, vertices.size(), triangles).run();
  return found;
}

}  // namespace rholm
