// Which loops on a surface bound no part of it, told edge by edge. Erickson and Whittlesey, Greedy
// optimal homotopy and homology generators (2005); Eppstein, Dynamic generators of topologically
// embedded graphs (2003).
//
// Take a spanning forest of the triangles over edges, with what is beyond all borders as one more
// triangle, and a spanning forest of the vertices along other edges. Each edge that is left closes
// a loop of triangles with the first forest. A closed walk along edges bounds a part of the surface
// if and only if it crosses each of these loops an even number of times.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// The edges that the loops of triangles cross, and which cross them.
struct CutGraph {
  struct Edge {
    std::uint32_t corner = 0;   // half-edge
    std::uint64_t crossed = 0;  // of each loop that crosses it 64 random bits, by exclusive or
  };
  std::vector<Edge> edges;              // each of their half-edges, ascending
  std::vector<std::uint32_t> vertices;  // ends of those edges, ascending
  std::vector<std::uint8_t> is_end;     // per vertex of the mesh, whether it is one

  // Of the half-edge; 0 if no loop crosses it. Of a closed walk, by exclusive or over its edges, it
  // is 0 if it bounds a part of the surface, and only once in 2^64 times if it does not.
  std::uint64_t crossed(std::uint32_t corner) const;
};

// Without edges for discs and spheres. `mates` of find_mates().
CutGraph make_cut_graph(const Mesh& mesh, const std::vector<std::uint32_t>& mates);

}  // namespace rholm
