// Nodes of the faces that are not lumped, for the mesh pass.
#pragma once

#include <array>
#include <cstdint>

#include "rholm/vec3.h"
#include "transform/mesh_pass/node_sink.h"
#include "transform/mesh_pass/twin_cache.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {

struct NodeOptions {
  NodeAllowance divided;  // also for nodes that are not divided by l(l+1)
  double rounding = 0;    // largest rounding error of the weights of a face
};

// Sums half-edges that have met their twins: an edge of two faces gets its nodes once.
class NodeWriter {
 public:
  NodeWriter(const NodeOptions& options, const ScaledVertices& vertices, NodeSink& sink);
  // Adds the edges that are requested, and the face if it is.
  void add_triangle(const std::array<Vec3, 3>& corners,
                    const std::array<std::uint32_t, 3>& vertices,
                    const std::array<bool, 3>& edges = {true, true, true}, bool face = true);
  // Writes the half-edges and nodes that are left.
  void flush();
  // Returns the sum of the squares of the rules' errors, for all elements written so far. It is the
  // square of the l2 norm of the errors, which add up like random numbers.
  double error2() const { return error2_; }

 private:
  // An edge seen from its lower vertex a to its higher vertex b.
  struct HalfEdge {
    double weight = 0;   // W
    float gradient = 0;  // factor of -(a x b) . grad
    Crowd crowd;
  };
  void add_edge(std::uint32_t i, std::uint32_t j, HalfEdge edge);
  void write_edge(std::uint32_t low, std::uint32_t high, const HalfEdge& edge);
  // Writes the piece from a to b, `share` of the whole; `across` is the gradient's factor.
  void write_piece(const HalfEdge& edge, const Vec3& across, const Vec3& a, const Vec3& b,
                   double share);
  // Writes a piece, `share` of the whole face.
  void write_face(const std::array<Vec3, 3>& p, double weight, const Crowd& crowd, double distance,
                  double share, int depth);

  NodeOptions options_;
  NodeAllowance undivided_;
  ScaledVertices vertices_;
  double grazing_;  // limit of d_T / r
  NodeSink& sink_;
  NodeBuffer nodes_;
  double error2_ = 0;
  int likely_edge_rule_ = 0, likely_face_rule_ = 0;
  TwinCache<HalfEdge> waiting_;
};

// Returns d_T int_T dS/|x|^2 of a face, its part of int r dOmega, to a part `allowed` of it.
double radius_integral(const std::array<Vec3, 3>& corners, double allowed);

}  // namespace rholm
