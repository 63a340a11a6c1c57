// Short loops on a surface that bound no part of it: around handles, and through them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "rholm/mesh.h"
#include "shape/topology/cut_graph.h"

namespace rholm {

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
