#include "shape/repair/sheets.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "shape/face.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

void join(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& mates) {
  mates[a] = b;
  mates[b] = a;
}

// Returns the half-edges of one edge, ordered by the angles of their triangles about it.
std::vector<HalfEdge> around_edge(const std::vector<Vec3>& vertices,
                                  const std::vector<Triangle>& triangles, std::uint32_t smaller,
                                  std::span<const HalfEdge> group) {
  const Vec3 a = vertices[smaller];
  const Vec3 axis = normalized(vertices[group[0].larger()] - a);
  const Vec3 x = normalized(cross(axis, std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 y = cross(axis, x);
  std::vector<std::pair<double, HalfEdge>> sorted;
  for (const HalfEdge& h : group) {
    const Vec3 apex = vertices[triangles[h.triangle()][(h.corner() + 2) % 3]] - a;
    sorted.emplace_back(std::atan2(dot(apex, y), dot(apex, x)), h);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  std::vector<HalfEdge> result;
  result.reserve(sorted.size());
  for (const auto& [angle, h] : sorted) result.push_back(h);
  return result;
}

// A triangle with a rising half-edge has the solid at smaller angles about the rising edge; with a
// falling one, at larger angles. So half-edges match like parentheses around a circle.
void join_around(std::vector<HalfEdge> ring, std::vector<std::uint32_t>& mates) {
  const auto join_first = [&](const auto& fits) {
    for (std::size_t i = 0; i < ring.size() && ring.size() > 1; ++i) {
      const std::size_t next = (i + 1) % ring.size();
      if (!fits(ring[i], ring[next])) continue;
      join(ring[i].corner(), ring[next].corner(), mates);
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
      return true;
    }
    return false;
  };
  while (join_first([](const HalfEdge& a, const HalfEdge& b) { return !a.rises() && b.rises(); })) {
  }
  while (join_first([](const HalfEdge&, const HalfEdge&) { return true; })) {
  }
}

// Joins the corners of two mates at each common vertex.
void join_corners(const std::vector<Triangle>& triangles, std::uint32_t h, std::uint32_t mate,
                  DisjointSets& fans) {
  const bool opposite = start_of(triangles, h) != start_of(triangles, mate);
  fans.unite(h, opposite ? next_corner(mate) : mate);
  fans.unite(next_corner(h), opposite ? mate : next_corner(mate));
}

}  // namespace

std::vector<std::uint32_t> find_mates_at_all_edges(const std::vector<Vec3>& vertices,
                                                   const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> mates(3 * triangles.size(), kNoMate);
  const HalfEdges half_edges = sort_half_edges(vertices.size(), triangles);
  half_edges.for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> group) {
    if (group.size() == 2) {
      join(group[0].corner(), group[1].corner(), mates);
    } else if (group.size() > 2) {
      join_around(around_edge(vertices, triangles, smaller, group), mates);
    }
  });
  return mates;
}

Parts find_parts(std::size_t n_faces, const std::vector<std::uint32_t>& mates) {
  DisjointSets sets(n_faces);
  CancelPoll poll;
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    poll();
    if (mates[h] != kNoMate && h < mates[h]) sets.unite(h / 3, mates[h] / 3);
  }
  Parts parts{.part = std::vector<std::uint32_t>(n_faces)};
  for (std::uint32_t t = 0; t < n_faces; ++t) {
    const std::uint32_t first = sets.find(t);
    parts.part[t] = first == t ? static_cast<std::uint32_t>(parts.n++) : parts.part[first];
  }
  return parts;
}

Orienting orient_alike(const std::vector<Vec3>& vertices, const Parts& parts,
                       std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates) {
  constexpr char kUnseen = 2;
  std::vector<char> turned(triangles.size(), kUnseen);
  Orienting result{.flipped = {}, .one_sided = std::vector<char>(parts.n, 0)};
  std::vector<std::uint32_t> open;
  CancelPoll poll;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (turned[seed] != kUnseen) continue;
    turned[seed] = 0;
    open.push_back(seed);
    while (!open.empty()) {
      poll();
      const std::uint32_t t = open.back();
      open.pop_back();
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (mates[h] == kNoMate) continue;
        const bool same = start_of(triangles, h) == start_of(triangles, mates[h]);
        const char wanted = same ? 1 - turned[t] : turned[t];
        char& there = turned[mates[h] / 3];
        if (there == kUnseen) {
          there = wanted;
          open.push_back(mates[h] / 3);
        } else if (there != wanted) {
          result.one_sided[parts.part[t]] = 1;
        }
      }
    }
  }
  std::vector<double> balance(parts.n, 0.0);  // area that would be flipped minus remaining area
  const auto area = [&](const Triangle& t) {
    const Vec3& a = vertices[t[0]];
    return norm(cross(vertices[t[1]] - a, vertices[t[2]] - a));
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    poll();
    balance[parts.part[t]] += turned[t] ? area(triangles[t]) : -area(triangles[t]);
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (result.one_sided[parts.part[t]]) {
      turned[t] = 0;
    } else if (balance[parts.part[t]] > 0) {
      turned[t] = 1 - turned[t];
    }
  }
  flip_marked(turned, triangles, mates);
  result.flipped = std::move(turned);
  return result;
}

// Swaps corners 1 and 2: half-edges 0 (0 -> 1) and 2 (1 -> 0) exchange places; half-edge 1 stays.
void flip_marked(const std::vector<char>& marked, std::vector<Triangle>& triangles,
                 std::vector<std::uint32_t>& mates) {
  const auto place = [&](std::uint32_t h) {
    return h == kNoMate || !marked[h / 3] ? h : 3 * (h / 3) + 2 - h % 3;
  };
  std::vector<std::uint32_t> moved(mates.size());
  for (std::uint32_t h = 0; h < mates.size(); ++h) moved[place(h)] = place(mates[h]);
  mates = std::move(moved);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (marked[t]) std::swap(triangles[t][1], triangles[t][2]);
  }
}

std::vector<std::uint32_t> separate_fans(std::size_t n_vertices,
                                         const std::vector<std::uint32_t>& mates,
                                         std::vector<Triangle>& triangles) {
  DisjointSets fans(3 * triangles.size());
  CancelPoll poll;
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    poll();
    if (mates[h] != kNoMate && h < mates[h]) join_corners(triangles, h, mates[h], fans);
  }
  std::vector<char> seen(n_vertices, 0);
  std::vector<std::uint32_t> vertex_of(3 * triangles.size());  // of fans, at first corners
  std::vector<std::uint32_t> copies;
  for (std::uint32_t c = 0; c < vertex_of.size(); ++c) {
    poll();
    std::uint32_t& corner = triangles[c / 3][c % 3];
    if (const std::uint32_t fan = fans.find(c); fan != c) {
      corner = vertex_of[fan];
      continue;
    }
    vertex_of[c] = corner;
    if (seen[corner]) {
      vertex_of[c] = static_cast<std::uint32_t>(n_vertices + copies.size());
      copies.push_back(corner);
    }
    seen[corner] = 1;
    corner = vertex_of[c];
  }
  return copies;
}

}  // namespace rholm
