// Finds edge by edge which loops on a surface bound no part of it. Sources: Erickson and
// Whittlesey, Greedy optimal homotopy and homology generators (2005); Eppstein, Dynamic generators
// of topologically embedded graphs (2003).
//
// The method takes a spanning forest of the triangles over edges, with the outside of all borders
// as one more triangle. It then takes a spanning forest of the vertices along other edges. Each
// remaining edge closes a loop of triangles with the first forest. A closed walk along edges bounds
// a part of the surface if and only if it crosses each of these loops an even number of times.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Holds the edges that loops of triangles cross, and which loops cross each edge.
struct CutGraph {
  struct Edge {
    std::uint32_t corner = 0;   // half-edge
    std::uint64_t crossed = 0;  // exclusive or of 64 random bits for each loop that crosses it
  };
  std::vector<Edge> edges;              // both half-edges of each edge, ascending
  std::vector<std::uint32_t> vertices;  // ends of `edges`, ascending
  std::vector<std::uint8_t> is_end;     // for each vertex of the mesh: true if it is in `vertices`

  // Returns the `crossed` of a half-edge, 0 if no loop crosses it. The exclusive or over a closed
  // walk is 0 if the walk bounds a part of the surface; otherwise it is 0 only once in 2^64 times.
  std::uint64_t crossed(std::uint32_t corner) const;
};

// Builds the graph; it has no edges for discs and spheres. `mates`: from find_mates().
CutGraph make_cut_graph(const Mesh& mesh, const std::vector<std::uint32_t>& mates);

}  // namespace rholm
