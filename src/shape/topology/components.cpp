#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/topology/half_edges.h"

namespace rholm {

Mesh largest_component(const Mesh& mesh) {
  validate(mesh);
  DisjointSets parts(mesh.faces.size());
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
  half_edges.for_each_edge([&](std::uint32_t, std::span<const HalfEdge> group) {
    for (const HalfEdge& half_edge : group) parts.unite(group[0].triangle(), half_edge.triangle());
  });
  const double scale = unit_frame(bounds(mesh.vertices)).scale;
  std::vector<double> areas(mesh.faces.size(), 0.0);  // twice the areas, at first triangles
  CancelPoll poll;
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    areas[parts.find(t)] +=
        norm(face_normal(scaled_corners(mesh, mesh.faces[t], scale)).twice_area);
  }
  Mesh result = mesh;
  result.faces.clear();
  if (areas.empty()) return result;
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    if (parts.find(t) == largest) result.faces.push_back(mesh.faces[t]);
  }
  return weld(result).mesh;  // drops the vertices of the other components
}

}  // namespace rholm
