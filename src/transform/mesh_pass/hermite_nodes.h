// Nodes between the vertices of lumped faces, by Hermite's rules with Hessians.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/node_sink.h"
#include "transform/mesh_pass/twin_cache.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {

// Half-edges wait for their twins. Both have the same nodes, unless rounding puts their lengths on
// two sides of a rule's limit.
class NodesBetween {
 public:
  NodesBetween(const ScaledVertices& vertices, NodeSink& sink);

  // Adds the nodes of the lumped faces among the block's first n faces.
  template <typename T>
  void add(const MeshView& mesh, std::size_t first, std::size_t n, const TriangleBlock<T>& block);
  // Writes the nodes that are left.
  void flush();

 private:
  struct HalfEdge {
    std::uint32_t rule = 0;
    double weight = 0;  // weight of each node
  };
  void add_edge(std::uint32_t i, std::uint32_t j, const HalfEdge& edge);
  void write_edge(std::uint32_t low, std::uint32_t high, const HalfEdge& edge);
  // Writes nodes with the weights of the centre and of the nodes of each orbit.
  void write_face(const std::array<Vec3, 3>& p, const HermiteFace& rule, double center,
                  const std::array<double, 2>& orbits);

  ScaledVertices vertices_;
  NodeBuffer nodes_;
  TwinCache<HalfEdge> waiting_;
};

}  // namespace rholm
