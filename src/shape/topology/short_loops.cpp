#include "shape/topology/short_loops.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "shape/topology/mates.h"

namespace rholm {

// Half-edges from the base to the vertex, the last first.
std::vector<std::uint32_t> LoopSearch::way_to(std::uint32_t vertex) const {
  std::vector<std::uint32_t> way;
  while (vertex != base_) {
    way.push_back(reached_.at(vertex).by);
    vertex = start_of(mesh_.triangles, way.back());
  }
  return way;
}

// To where the half-edge begins, along it, and back.
Loop LoopSearch::loop_through(std::uint32_t corner) const {
  std::vector<std::uint32_t> there = way_to(start_of(mesh_.triangles, corner));
  std::vector<std::uint32_t> back = way_to(end_of(mesh_.triangles, corner));
  while (!there.empty() && !back.empty() && there.back() == back.back()) {
    there.pop_back(), back.pop_back();
  }
  Loop loop;
  loop.corners.assign(there.rbegin(), there.rend());
  loop.corners.push_back(corner);
  for (const std::uint32_t c : back) loop.corners.push_back(mates_[c]);
  for (const std::uint32_t c : loop.corners) {
    const Vec3& a = mesh_.vertices[start_of(mesh_.triangles, c)];
    loop.length += norm(mesh_.vertices[end_of(mesh_.triangles, c)] - a);
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
      const std::uint32_t w = end_of(mesh_.triangles, c);
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
