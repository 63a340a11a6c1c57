// Sorts the half-edges of a mesh into groups of one edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "rholm/mesh.h"

namespace rholm {

// A half-edge within its group: it runs from corner k of triangle t to the next corner. Order: by
// the edge's larger vertex, then by the place in the file.
struct HalfEdge {
  std::uint64_t key = 0;  // larger vertex << 32 | (3 t + k) << 1 | (runs from larger to smaller)

  std::uint32_t larger() const { return static_cast<std::uint32_t>(key >> 32); }
  std::uint32_t corner() const { return static_cast<std::uint32_t>(key) >> 1; }  // 3 t + k
  std::uint32_t triangle() const { return corner() / 3; }
  bool rises() const { return (key & 1) == 0; }  // true if it runs from smaller to larger vertex
  friend bool operator<(const HalfEdge& a, const HalfEdge& b) { return a.key < b.key; }
};

// All half-edges, sorted. begin[v] ... begin[v + 1] are the half-edges of edges whose smaller
// vertex is v. Triangles with a repeated corner have none.
struct HalfEdges {
  std::vector<std::uint32_t> begin;  // n_vertices + 1
  std::vector<HalfEdge> sorted;

  // Calls visit(smaller vertex, half-edges of one edge) for every edge by (smaller, larger).
  template <typename Visit>
  void for_each_edge(Visit visit) const {
    CancelPoll poll;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
      poll();
      std::size_t i = begin[v];
      while (i < begin[v + 1]) {
        std::size_t j = i + 1;
        while (j < begin[v + 1] && sorted[j].larger() == sorted[i].larger()) ++j;
        visit(static_cast<std::uint32_t>(v), std::span(sorted).subspan(i, j - i));
        i = j;
      }
    }
  }
};

// Sorts half-edges; needs valid indices. Throws Unsupported for more than 2^31 / 3 triangles.
HalfEdges sort_half_edges(std::size_t n_vertices, const std::vector<Triangle>& triangles);

inline bool has_repeated_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace rholm
