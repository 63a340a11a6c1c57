#include "shape/topology/closed.h"

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "shape/topology/vertex_place.h"

namespace rholm {

bool is_closed(const MeshView& mesh) {
  std::vector<std::uint64_t> places(mesh.n_vertices);
  CancelPoll poll;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    places[i] = place_hash(mesh.vertex(i));
  }
  std::uint64_t sum = 0;
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    const Triangle v = mesh.triangle(t);
    for (std::size_t k = 0; k < 3; ++k) {
      // Adds the product of the ends' hashes. As a polynomial, the sum is zero only if the edges
      // cancel. Otherwise it is zero modulo 2^64 by chance alone, about once in 2^60.
      const std::uint64_t a = places[v[k]], b = places[v[k == 2 ? 0 : k + 1]];
      if (a == b) continue;  // the edge has no length and adds nothing
      sum += a < b ? a * b : -(a * b);
    }
  }
  return sum == 0;
}

}  // namespace rholm
