#include "shape/topology/loops.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

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
    // Turns counter-clockwise from the edge behind to the edge ahead.
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
  for (const auto& [i, c] : loop.right) mesh.faces[c / 3][c % 3] = right[i];
  const std::uint32_t middle_left = add_copy(loop.vertices[0], mesh, copies);
  const std::uint32_t middle_right = add_copy(loop.vertices[0], mesh, copies);
  mesh.vertices[middle_left] = mesh.vertices[middle_right] = sum / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    mesh.faces.push_back({loop.vertices[j], loop.vertices[i], middle_left});
    mesh.faces.push_back({right[i], right[j], middle_right});
  }
}

// Returns the half-edges from the base to the vertex, the last one first.
std::vector<std::uint32_t> LoopSearch::way_to(std::uint32_t vertex) const {
  std::vector<std::uint32_t> way;
  while (vertex != base_) {
    way.push_back(reached_.at(vertex).by);
    vertex = start_of(mesh_.faces, way.back());
  }
  return way;
}

// Returns the loop to the start of the half-edge, along it, and back.
Loop LoopSearch::loop_through(std::uint32_t corner) const {
  std::vector<std::uint32_t> there = way_to(start_of(mesh_.faces, corner));
  std::vector<std::uint32_t> back = way_to(end_of(mesh_.faces, corner));
  while (!there.empty() && !back.empty() && there.back() == back.back()) {
    there.pop_back(), back.pop_back();
  }
  Loop loop;
  loop.corners.assign(there.rbegin(), there.rend());
  loop.corners.push_back(corner);
  for (const std::uint32_t c : back) loop.corners.push_back(mates_[c]);
  for (const std::uint32_t c : loop.corners) {
    const Vec3& a = mesh_.vertices[start_of(mesh_.faces, c)];
    loop.length += norm(mesh_.vertices[end_of(mesh_.faces, c)] - a);
    loop.crossed ^= graph_.crossed(c);
  }
  return loop;
}

Loop LoopSearch::shortest(std::uint32_t base, double most) {
  using Place = std::pair<double, std::uint32_t>;  // length, vertex
  std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
  base_ = base;
  reached_.clear();
  reached_[base_] = {};
  next.emplace(0.0, base_);
  bool found = false;
  std::uint32_t closing = 0;
  while (!next.empty() && next.top().first <= most / 2) {
    const auto [length, v] = next.top();
    next.pop();
    Reached& here = reached_[v];
    if (here.settled) continue;
    here.settled = true;
    const std::uint64_t crossed = here.crossed;
    for_each_outgoing(mates_, outgoing_[v], [&](std::uint32_t c) {
      const std::uint32_t w = end_of(mesh_.faces, c);
      if (outgoing_[w] == kNoMate) return;
      const double longer = length + norm(mesh_.vertices[w] - mesh_.vertices[v]);
      const bool may_cross = graph_.is_end[v] != 0 && graph_.is_end[w] != 0;
      const std::uint64_t through = may_cross ? crossed ^ graph_.crossed(c) : crossed;
      const auto [at, is_new] = reached_.try_emplace(w, Reached{longer, through, c});
      Reached& there = at->second;
      if (there.settled) {
        if (there.crossed != through && longer + there.length < most) {
          most = longer + there.length, closing = c, found = true;
        }
        return;
      }
      if (!is_new && longer >= there.length) return;
      there = {longer, through, c};
      next.emplace(longer, w);
    });
  }
  return found ? loop_through(closing) : Loop{};
}

}  // namespace rholm
