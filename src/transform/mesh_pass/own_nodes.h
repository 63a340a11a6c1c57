// Nodes of the triangles that are not lumped, for the mesh pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rholm/vec3.h"
#include "transform/mesh_pass/twin_cache.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {

struct Node {
  Vec3 x;  // relative to the centre, scaled, of any length
  double weight;
};
// weight . grad of Y(x/|x|) with respect to x.
struct GradientNode {
  Vec3 x, weight;
};

// Point sources as they are found, weights alone many at a time.
class NodeSink {
 public:
  virtual ~NodeSink() = default;
  virtual void add(std::span<const Node> nodes) = 0;
  virtual void add_gradient(const GradientNode& node) = 0;
  // Into the sum that is not divided by l(l+1).
  virtual void add_undivided(const Vec3& x, double weight) = 0;
};

struct NodeOptions {
  NodeAllowance divided;
  NodeAllowance undivided;
};

// Hands weights on many at a time.
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

// Half-edges that have met their twins are summed: an edge of two triangles gets its nodes once.
class NodeWriter {
 public:
  NodeWriter(const NodeOptions& options, NodeSink& sink);
  // `vertices` name the corners: equal names, equal points.
  void add_triangle(const std::array<Vec3, 3>& corners,
                    const std::array<std::uint32_t, 3>& vertices);
  // Half-edges and nodes that are left.
  void flush();
  // Sum of the squares of what the rules leave of the elements written so far: the square of the
  // l2 norm of their errors, which add up like random numbers.
  double error2() const { return error2_; }

 private:
  struct HalfEdge {
    Vec3 a, b;
    double weight = 0;    // W
    double gradient = 0;  // of -(a x b) . grad
    Crowd crowd;
  };
  void add_edge(std::uint32_t i, std::uint32_t j, HalfEdge edge);
  void write_edge(const HalfEdge& edge);
  void write_piece(const HalfEdge& edge, const Vec3& a, const Vec3& b, double share);
  void write_face(const std::array<Vec3, 3>& p, double weight, const Crowd& crowd, int depth);

  NodeOptions options_;
  double grazing_;  // d_T / r
  NodeSink& sink_;
  NodeBuffer nodes_;
  double error2_ = 0;
  TwinCache<HalfEdge> waiting_;
};

// d_T int_T dS/|x|^2 of a triangle, its part of int r dOmega, to the relative error wanted.
double radius_integral(const std::array<Vec3, 3>& corners, double relative_error);

}  // namespace rholm
