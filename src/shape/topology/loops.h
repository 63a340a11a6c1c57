// Finds short loops around handles and through them, which bound no part of the surface, and cuts a
// surface open along a loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rholm/mesh.h"
#include "shape/topology/cut_graph.h"

namespace rholm {

// Vertices in the order of a loop, and the corners (3 t + k) of triangles on its right side at
// these vertices. Each corner comes with the index of its vertex in the loop.
struct LoopSides {
  std::vector<std::uint32_t> vertices;
  std::vector<std::pair<std::size_t, std::uint32_t>> right;
};

// `loop`: half-edges over inner vertices, each beginning where the last one ends; no vertex twice.
LoopSides sides_of(const std::vector<std::uint32_t>& loop, const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& mates);

// Cuts the mesh along a loop. Both sides get a fan of triangles around the loop's middle; if the
// loop bounds no part of the surface, this removes a handle. Appends to the mesh a copy of each
// vertex for the right side with its attributes, and two middles with the first vertex's
// attributes. Appends to `copies`, for each new vertex, the vertex that it is a copy of.
void cut_along(const LoopSides& loop, Mesh& mesh, std::vector<std::uint32_t>& copies);

// A loop of half-edges, each beginning where the last one ends; no vertex twice.
struct Loop {
  std::vector<std::uint32_t> corners;
  double length = 0;
  std::uint64_t crossed = 0;  // see CutGraph; not 0
};

// Searches loops; keeps references to its arguments. Use one object per thread.
class LoopSearch {
 public:
  // `outgoing`: from inner_outgoing().
  LoopSearch(const Mesh& mesh, const std::vector<std::uint32_t>& mates,
             const std::vector<std::uint32_t>& outgoing, const CutGraph& graph)
      : mesh_(mesh), mates_(mates), outgoing_(outgoing), graph_(graph) {}

  // Finds the shortest closed walk along edges over inner vertices from `base`, if it is shorter
  // than `most` and bounds no part of the surface. Returns it without the part that is run there
  // and back, or without corners if there is none. Dijkstra's algorithm.
  Loop shortest(std::uint32_t base, double most);

 private:
  struct Reached {
    double length = 0;
    std::uint64_t crossed = 0;
    std::uint32_t by = 0;  // the half-edge that ends at this vertex
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
