#include "transform/mesh_pass/hermite_nodes.h"

namespace rholm {

NodesBetween::NodesBetween(const ScaledVertices& vertices, NodeSink& sink)
    : vertices_(vertices), nodes_(sink) {}

template <typename T>
void NodesBetween::add(const MeshView& mesh, std::size_t first, std::size_t n,
                       const TriangleBlock<T>& block) {
  for (std::size_t t = 0; t < n; ++t) {
    const int rules[3] = {block.edge_rule[0][t], block.edge_rule[1][t], block.edge_rule[2][t]};
    if ((block.flag[t] & kNodes) != 0) continue;
    if ((rules[0] | rules[1] | rules[2] | block.face_rule[t]) == 0) continue;
    const Triangle vertices = mesh.triangle(first + t);
    for (int i = 0; i < 3; ++i) {
      if (rules[i] == 0) continue;
      add_edge(vertices[i], vertices[i == 2 ? 0 : i + 1],
               {.rule = static_cast<std::uint32_t>(rules[i]), .weight = block.edge_node[i][t]});
    }
    if (block.face_rule[t] == 0) continue;
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = {block.corner[i][0][t], block.corner[i][1][t], block.corner[i][2][t]};
    }
    write_face(p, kHermiteFaces[block.face_rule[t]], block.center_node[t],
               {block.orbit_node[0][t], block.orbit_node[1][t]});
  }
}

void NodesBetween::add_edge(std::uint32_t i, std::uint32_t j, const HalfEdge& edge) {
  const auto join = [](HalfEdge& twin, const HalfEdge& other) {
    if (twin.rule != other.rule) return false;
    twin.weight += other.weight;
    return true;
  };
  waiting_.add(i, j, edge, join, [&](std::uint32_t low, std::uint32_t high, const HalfEdge& whole) {
    write_edge(low, high, whole);
  });
}

void NodesBetween::write_edge(std::uint32_t low, std::uint32_t high, const HalfEdge& edge) {
  const Vec3 a = vertices_[low], b = vertices_[high], sum = a + b;
  if (edge.rule == 1) return nodes_.add(sum, edge.weight);  // only the direction counts
  nodes_.add(sum + a, edge.weight);
  nodes_.add(sum + b, edge.weight);
}

void NodesBetween::write_face(const std::array<Vec3, 3>& p, const HermiteFace& rule, double center,
                              const std::array<double, 2>& orbits) {
  if (rule.center != 0) nodes_.add(p[0] + p[1] + p[2], center);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& [weight, a, b] = rule.orbits[k];
    if (weight == 0) continue;
    const double c = 1 - a - b;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &first = p[i], &second = p[i == 2 ? 0 : i + 1], &third = p[i == 0 ? 2 : i - 1];
      nodes_.add(a * first + b * second + c * third, orbits[k]);
      if (a != b) nodes_.add(b * first + a * second + c * third, orbits[k]);
    }
  }
}

void NodesBetween::flush() {
  waiting_.flush([&](std::uint32_t low, std::uint32_t high, const HalfEdge& edge) {
    write_edge(low, high, edge);
  });
  nodes_.flush();
}

template void NodesBetween::add(const MeshView&, std::size_t, std::size_t,
                                const TriangleBlock<std::int32_t>&);
template void NodesBetween::add(const MeshView&, std::size_t, std::size_t,
                                const TriangleBlock<double>&);

}  // namespace rholm
