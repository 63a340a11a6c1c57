// Loops on a surface: it is cut open along one, and short ones are found that bound no part of it,
// around handles and through them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rholm/mesh.h"
#include "shape/topology/cut_graph.h"

namespace rholm {

// Vertices in the order of a loop, and the corners (3 t + k) of triangles that are on its right
// side there, each with its vertex's place in the loop.
struct LoopSides {
  std::vector<std::uint32_t> vertices;
  std::vector<std::pair<std::size_t, std::uint32_t>> right;
};

// Of half-edges that each begin where the one before ends, over inner vertices, none twice.
LoopSides sides_of(const std::vector<std::uint32_t>& loop, const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& mates);

// Both sides get a fan of triangles around the loop's middle: where it bounds no part of the
// surface, one handle is gone. Appends to the mesh, with the attributes of the loop's vertices, a
// copy of each of those for the right side, and two middles with the attributes of the first;
// appends to `copies` the vertices that they are copies of.
void cut_along(const LoopSides& loop, Mesh& mesh, std::vector<std::uint32_t>& copies);

// Half-edges, each beginning where the one before it ends; no vertex twice.
struct Loop {
  std::vector<std::uint32_t> corners;
  double length = 0;
  std::uint64_t crossed = 0;  // see CutGraph; not 0
};

// Refers to its arguments. Of one thread: holds what a search needs.
class LoopSearch {
 public:
  // `outgoing` of inner_outgoing().
  LoopSearch(const Mesh& mesh, const std::vector<std::uint32_t>& mates,
             const std::vector<std::uint32_t>& outgoing, const CutGraph& graph)
      : mesh_(mesh), mates_(mates), outgoing_(outgoing), graph_(graph) {}

  // The shortest way along edges from an inner vertex over others back to it that bounds no part of
  // the surface, if it is no longer than `most`, without what it goes there and back; without
  // corners if there is none. Dijkstra's algorithm.
  Loop shortest(std::uint32_t base, double most);

 private:
  struct Reached {
    double length = 0;
    std::uint64_t crossed = 0;
    std::uint32_t by = 0;  // the half-edge that ends here
    bool settled = false;
  };
  Loop loop_through(std::uint32_t corner) const;
  std::vector<std::uint32_t> way_to(std::uint32_t vertex) const;

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& mates_;
  const std::vector<std::uint32_t>& outgoing_;
  const CutGraph& graph_;
  std::uint32_t base_ = 0;
  std::unordered_map<std::uint32_t, Reached> reached_;
};

}  // namespace rholm
