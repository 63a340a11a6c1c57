#include "shape/topology/cut_loop.h"

#include "shape/topology/mates.h"

namespace rholm {
namespace {

std::uint32_t add_copy(std::uint32_t vertex, Mesh& mesh, std::vector<std::uint32_t>& copies) {
  copies.push_back(vertex);
  const Vec3 place = mesh.vertices[vertex];
  mesh.vertices.push_back(place);
  for (Attribute& attribute : mesh.attributes) {
    const double value = attribute.values[vertex];
    attribute.values.push_back(value);
  }
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

}  // namespace

LoopSides sides_of(const std::vector<std::uint32_t>& loop, const std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& mates) {
  LoopSides sides;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sides.vertices.push_back(start_of(triangles, loop[i]));
    // Counter-clockwise from the edge back to the one ahead.
    const std::uint32_t before = loop[i == 0 ? loop.size() - 1 : i - 1];
    for (std::uint32_t c = mates[before]; c != loop[i]; c = mates[previous_corner(c)]) {
      sides.right.emplace_back(i, c);
    }
  }
  return sides;
}

void cut_along(const LoopSides& loop, Mesh& mesh, std::vector<std::uint32_t>& copies) {
  const std::size_t n = loop.vertices.size();
  std::vector<std::uint32_t> right;
  Vec3 sum;
  for (const std::uint32_t v : loop.vertices) {
    sum += mesh.vertices[v];
    right.push_back(add_copy(v, mesh, copies));
  }
  for (const auto& [i, c] : loop.right) mesh.triangles[c / 3][c % 3] = right[i];
  const std::uint32_t middle_left = add_copy(loop.vertices[0], mesh, copies);
  const std::uint32_t middle_right = add_copy(loop.vertices[0], mesh, copies);
  mesh.vertices[middle_left] = mesh.vertices[middle_right] = sum / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    mesh.triangles.push_back({loop.vertices[j], loop.vertices[i], middle_left});
    mesh.triangles.push_back({right[i], right[j], middle_right});
  }
}

}  // namespace rholm
