// The results of one part of the faces, except for the grid to which it is spread.
//
// The pass is the sum of its parts in their order: of these results and of the cells of their
// grids. The sum has the same bits, whichever thread or process computes a part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/bytes.h"
#include "rholm/coefficients.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/border_lumps.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// Single precision has sums in whole quanta of 32 bits.
template <typename T>
using LumpOf = std::conditional_t<sizeof(T) == 4, std::int32_t, double>;

template <typename T>
struct MeshPart {
  BlockSums sums = no_triangles();
  double mean = 0;  // int r dOmega over faces with nodes for it
  std::vector<SampledHalfEdge> half_edges;
  double weight = 0;                // sum of the weights that are divided by l(l+1)
  double modulus = 0;               // sum of the moduli of these weights
  std::size_t nodes = 0;            // number of all nodes
  double node_error2 = 0;           // see NodeWriter::error2()
  std::vector<float> block_errors;  // error of each block by the model, l2
  Coefficients undivided;           // sum of nodes that are not divided by l(l+1), if any
  LumpSums lumps;                   // sums over the vertices that no other part has
  double border_weight = 0;         // sum of the weights in `border`, in quanta
  BorderLumps<LumpOf<T>> border;
};

// read_part() throws Io for bytes that are not a part.
template <typename T>
void write(const MeshPart<T>& part, ByteWriter& writer);
template <typename T>
MeshPart<T> read_part(ByteReader& reader);

}  // namespace rholm
