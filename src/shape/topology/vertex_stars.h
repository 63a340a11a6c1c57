// The triangles around each vertex of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Triangles of v, in the order of the mesh: triangles[begin[v]] ... triangles[begin[v + 1] - 1].
struct VertexStars {
  std::vector<std::uint32_t> begin;  // n_vertices + 1
  std::vector<std::uint32_t> triangles;

  std::span<const std::uint32_t> of(std::size_t v) const {
    return {triangles.data() + begin[v], begin[v + 1] - begin[v]};
  }
};
VertexStars make_vertex_stars(std::size_t n_vertices, std::span<const Triangle> triangles);

enum class RingKind : std::uint8_t {
  kClosed,   // one fan all around
  kOpen,     // one fan from border to border
  kComplex,  // anything else: none, several fans, edges of three triangles or of opposite senses
};

// The neighbours of a vertex in the order of its fan, counter-clockwise; those of an open one begin
// and end along the border. Not complete where it is complex.
struct Ring {
  RingKind kind = RingKind::kComplex;
  std::vector<std::uint32_t> neighbours;
  std::vector<std::array<std::uint32_t, 2>> link;  // scratch
};
// Into a ring that is used again: memory is taken once. Triangles have three different corners.
void find_ring(std::span<const Triangle> triangles, const VertexStars& stars, std::uint32_t v,
               Ring& ring);

}  // namespace rholm
