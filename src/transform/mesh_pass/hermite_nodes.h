// Nodes of lumped triangles, between the vertices: those of Hermite's rules with Hessians.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/node_sink.h"
#include "transform/mesh_pass/twin_cache.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {

// Half-edges wait for their twins: both have the same nodes unless a rule's limit lies between what
// rounding makes of their lengths.
class NodesBetween {
 public:
  NodesBetween(const ScaledVertices& vertices, NodeSink& sink);

  // Those of the block's first n triangles that are lumped.
  template <typename T>
  void add(const MeshView& mesh, std::size_t first, std::size_t n, const TriangleBlock<T>& block);
  // What is left.
  void flush();

 private:
  struct HalfEdge {
    std::uint32_t rule = 0;
    double weight = 0;  // of each node
  };
  void add_edge(std::uint32_t i, std::uint32_t j, const HalfEdge& edge);
  void write_edge(std::uint32_t low, std::uint32_t high, const HalfEdge& edge);
  // With the weights of its centre and of the nodes of each orbit.
  void write_face(const std::array<Vec3, 3>& p, const HermiteFace& rule, double center,
                  const std::array<double, 2>& orbits);

  ScaledVertices vertices_;
  NodeBuffer nodes_;
  TwinCache<HalfEdge> waiting_;
};

}  // namespace rholm
