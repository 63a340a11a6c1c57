#include "shape/topology/closed.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "base/random.h"
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
  for (std::size_t t = 0; t < mesh.n_triangles; ++t) {
    poll();
    const Triangle v = mesh.triangle(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = places[v[k]], b = places[v[k == 2 ? 0 : k + 1]];
      if (a == b) continue;  // no length, and no other side
      const std::uint64_t edge = random_bits(std::min(a, b), std::max(a, b));
      sum += a < b ? edge : -edge;
    }
  }
  return sum == 0;
}

}  // namespace rholm
