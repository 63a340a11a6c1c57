#include "shape/repair/outwards.h"

#include <algorithm>
#include <numeric>

#include "base/cancel.h"
#include "base/parallel.h"
#include "shape/queries/ray_scene.h"

namespace rholm {
namespace {

// A closed part; its triangles are in mesh order.
struct Solid {
  std::vector<std::uint32_t> faces;
  Bounds box;
  double volume = 0;
  bool closed = true;
  int depth = 0;  // number of other solids that contain it
};

std::vector<Solid> find_solids(const Mesh& mesh, const Parts& parts,
                               const std::vector<std::uint32_t>& mates) {
  std::vector<Solid> solids(parts.n);
  CancelPoll poll;
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    Solid& solid = solids[parts.part[t]];
    const Triangle& corners = mesh.faces[t];
    const Vec3 first = mesh.vertices[corners[0]];
    if (solid.faces.empty()) solid.box = {.min = first, .max = first};
    solid.faces.push_back(t);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t h = 3 * t + static_cast<std::uint32_t>(k);
      // Half-edges with the same start belong to a one-sided part.
      solid.closed = solid.closed && mates[h] != kNoMate &&
                     start_of(mesh.faces, h) != start_of(mesh.faces, mates[h]);
      const Vec3& p = mesh.vertices[corners[k]];
      Bounds& box = solid.box;
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
    const Vec3 origin = mesh.vertices[mesh.faces[solid.faces[0]][0]];
    const Vec3 a = first - origin, b = mesh.vertices[corners[1]] - origin;
    solid.volume += dot(a, cross(b, mesh.vertices[corners[2]] - origin)) / 6;
  }
  return solids;
}

bool holds(const Bounds& outer, const Bounds& inner) {
  return outer.min.x < inner.min.x && outer.min.y < inner.min.y && outer.min.z < inner.min.z &&
         outer.max.x > inner.max.x && outer.max.y > inner.max.y && outer.max.z > inner.max.z;
}

// Directions in general position, chosen: one ray may miscount at an edge, three hardly do.
const Vec3 kDirections[] = {normalized({0.26, 0.53, 0.81}), normalized({-0.71, 0.37, -0.59}),
                            normalized({0.43, -0.83, -0.35})};

bool is_inside(const RayScene& scene, const Vec3& point) {
  int odd = 0;
  for (const Vec3& direction : kDirections) odd += scene.count_hits(point, direction) % 2;
  return odd >= 2;
}

// Returns true if the solid lies within the scene's solid. All of a few corners must lie inside, so
// that solids that cross each other do not count.
bool is_within(const RayScene& scene, const Mesh& mesh, const Solid& solid) {
  constexpr std::size_t kCorners = 5;  // chosen
  const std::size_t n = solid.faces.size();
  for (std::size_t i = 0; i < std::min(kCorners, n); ++i) {
    const Triangle& t = mesh.faces[solid.faces[i * n / std::min(kCorners, n)]];
    if (!is_inside(scene, mesh.vertices[t[0]])) return false;
  }
  return true;
}

Mesh mesh_of(const Mesh& mesh, const Solid& solid) {
  Mesh part;
  for (const std::uint32_t t : solid.faces) {
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    for (const std::uint32_t v : mesh.faces[t]) part.vertices.push_back(mesh.vertices[v]);
    part.faces.push_back({first, first + 1, first + 2});
  }
  return part;
}

void find_depths(const Mesh& mesh, std::vector<Solid>& solids, const Context& context) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < solids.size(); ++i) {
    if (solids[i].closed) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return solids[i].box.min.x < solids[j].box.min.x;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    report_progress(context, "inside and outside",
                    static_cast<double>(i) / static_cast<double>(order.size()));
    const Solid& outer = solids[order[i]];
    std::vector<std::uint32_t> within;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (solids[order[j]].box.min.x >= outer.box.max.x) break;
      if (holds(outer.box, solids[order[j]].box)) within.push_back(order[j]);
    }
    if (within.empty()) continue;
    const Mesh part = mesh_of(mesh, outer);  // the scene refers to it
    const RayScene scene(part);
    for (const std::uint32_t j : within) solids[j].depth += is_within(scene, mesh, solids[j]);
  }
}

}  // namespace

void turn_outwards(const Mesh& mesh, const Parts& parts, const std::vector<std::uint32_t>& mates,
                   std::vector<char>& turned, RepairReport& report, const Context& context) {
  std::vector<Solid> solids = find_solids(mesh, parts, mates);
  find_depths(mesh, solids, context);
  for (const Solid& solid : solids) {
    if (!solid.closed || solid.volume == 0) continue;
    const bool inwards = solid.depth % 2 == 1;
    report.cavities += inwards;
    if ((solid.volume < 0) == inwards) continue;
    ++report.inside_out_parts;
    for (const std::uint32_t t : solid.faces) turned[t] = 1 - turned[t];
  }
}

}  // namespace rholm
