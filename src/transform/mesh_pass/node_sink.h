// Nodes, and the interface to pass them on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rholm/mesh_view.h"
#include "rholm/vec3.h"

namespace rholm {

struct Node {
  Vec3 x;  // relative to the centre, scaled, of any length
  double weight;
};
// The source weight . grad of Y(x/|x|) with respect to x.
struct GradientNode {
  Vec3 x, weight;
};

// Receives point sources as they are found; weights alone come many at a time.
class NodeSink {
 public:
  virtual ~NodeSink() = default;
  virtual void add(std::span<const Node> nodes) = 0;
  virtual void add_gradient(const GradientNode& node) = 0;
  // Adds to the sum that is not divided by l(l+1).
  virtual void add_undivided(const Vec3& x, double weight) = 0;
};

// Vertices relative to the centre, scaled, like the corners of a TriangleBlock.
struct ScaledVertices {
  const MeshView& mesh;
  Vec3 center;  // scaled
  double scale = 1;
  Vec3 operator[](std::uint32_t i) const { return scale * mesh.vertex(i) - center; }
};

// Collects weights, and passes many on at a time.
class NodeBuffer {
 public:
  explicit NodeBuffer(NodeSink& sink) : sink_(sink) {}
  void add(const Vec3& x, double weight) {
    nodes_[n_nodes_++] = {x, weight};
    if (n_nodes_ == nodes_.size()) flush();
  }
  void flush() {
    if (n_nodes_ > 0) sink_.add(std::span(nodes_).first(n_nodes_));
    n_nodes_ = 0;
  }

 private:
  NodeSink& sink_;
  std::array<Node, 256> nodes_;
  std::size_t n_nodes_ = 0;
};

}  // namespace rholm
