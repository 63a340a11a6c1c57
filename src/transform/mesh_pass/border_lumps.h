// Lumps of vertices that several parts of a mesh share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// Numbers of vertices in the mesh, and lumps_per_vertex() lumps for each.
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

// Sums lumps over parts; the sums are exact in any order.
template <typename L>
class BorderSums {
 public:
  explicit BorderSums(bool hessians) { sums_.per_vertex = lumps_per_vertex(hessians); }
  void add(const BorderLumps<L>& part);
  // Takes out the vertices for which is_done() is true: each once, in order.
  BorderLumps<L> take(const std::function<bool(std::uint32_t vertex)>& is_done);
  // Returns each remaining vertex once, in order. No more lumps may be added.
  const BorderLumps<L>& finish();

 private:
  void combine();
  BorderLumps<L> sums_;
  std::size_t combined_ = 0;  // number of vertices after the last combine()
};

}  // namespace rholm
