// Lists the triangles around each vertex of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// The triangles of v, in mesh order, are triangles[begin[v]] ... triangles[begin[v + 1] - 1].
struct VertexStars {
  std::vector<std::uint32_t> begin;  // n_vertices + 1
  std::vector<std::uint32_t> faces;

  std::span<const std::uint32_t> of(std::size_t v) const {
    return {faces.data() + begin[v], begin[v + 1] - begin[v]};
  }
};
VertexStars make_vertex_stars(std::size_t n_vertices, std::span<const Triangle> triangles);

enum class RingKind : std::uint8_t {
  kClosed,   // one fan all around
  kOpen,     // one fan from border to border
  kComplex,  // no triangle, several fans, edges of three triangles or of two opposite orientations
};

// Neighbours of a vertex in the order of its fan, counter-clockwise. The ring of an open fan begins
// and ends at the border. The list is incomplete if the ring is complex.
struct Ring {
  RingKind kind = RingKind::kComplex;
  std::vector<std::uint32_t> neighbours;
  std::vector<std::array<std::uint32_t, 2>> link;  // scratch memory of find_ring()
};
// Fills a ring whose memory is reused. Triangles have three different corners.
void find_ring(std::span<const Triangle> triangles, const VertexStars& stars, std::uint32_t v,
               Ring& ring);

}  // namespace rholm
