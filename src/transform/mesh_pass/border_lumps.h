// Lumps of vertices that several parts of a mesh share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// Vertices by their number in the mesh, lumps_per_vertex() lumps of each.
template <typename L>
struct BorderLumps {
  std::size_t per_vertex = 1;
  std::vector<std::uint32_t> vertices;
  std::vector<VertexLump<L>> lumps;

  void add(std::uint32_t vertex, const VertexLump<L>* lump) {
    vertices.push_back(vertex);
    lumps.insert(lumps.end(), lump, lump + per_vertex);
  }
};

// Their sums over parts: exact, whatever the order.
template <typename L>
class BorderSums {
 public:
  explicit BorderSums(bool hessians) { sums_.per_vertex = lumps_per_vertex(hessians); }
  void add(const BorderLumps<L>& part);
  // Takes those out that is_done() is true of: each once, in order.
  BorderLumps<L> take(const std::function<bool(std::uint32_t vertex)>& is_done);
  // Each vertex that is left once, in order; no more may be added.
  const BorderLumps<L>& finish();

 private:
  void combine();
  BorderLumps<L> sums_;
  std::size_t combined_ = 0;  // so many vertices were left when it was last done
};

}  // namespace rholm
