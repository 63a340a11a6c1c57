// What one part of the triangles leaves, but for the grid it is spread to.
//
// The pass is the sum of its parts in their order: of what is here, and of the cells of their
// grids. Whoever works a part, another process too, the sum has the same bits.
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

// Single precision goes with sums in whole quanta of 32 bits.
template <typename T>
using LumpOf = std::conditional_t<sizeof(T) == 4, std::int32_t, double>;

template <typename T>
struct MeshPart {
  BlockSums sums = no_triangles();
  double mean = 0;  // int r dOmega over triangles with nodes for it
  std::vector<SampledHalfEdge> half_edges;
  double weight = 0;                // sum of weights, of all that are divided by l(l+1)
  double modulus = 0;               // and of their moduli
  std::size_t nodes = 0;            // of all
  double node_error2 = 0;           // see NodeWriter::error2()
  std::vector<float> block_errors;  // of each block, what the model says it leaves, l2
  Coefficients undivided;           // of nodes that are not divided by l(l+1), if there are any
  LumpSums lumps;                   // of the vertices that no other part has
  double border_weight = 0;         // of those below, in quanta: their sum
  BorderLumps<LumpOf<T>> border;
};

// read_part() throws Io for bytes that are not those of a part.
template <typename T>
void write(const MeshPart<T>& part, ByteWriter& writer);
template <typename T>
MeshPart<T> read_part(ByteReader& reader);

}  // namespace rholm
