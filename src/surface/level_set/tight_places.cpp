#include "surface/level_set/tight_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "base/parallel.h"
#include "surface/level_set/cubes.h"

namespace rholm {
namespace {

// Chosen: bound of the cosine, with a margin because normals are not exactly the loop's.
constexpr double kOneSide = 0.2;

double square_of(const Vec3& x) { return dot(x, x); }

}  // namespace

// Along the shortest curve, normals turn by at least 2 pi, as the curve does (Fenchel
// 1929). Edges much shorter than others are treated as edges of the length `least`.
std::vector<std::uint32_t> sharp_vertices(const Mesh& mesh, const NormalAttributes& normals,
                                          double length, std::size_t n_own,
                                          const Context& context) {
  constexpr std::size_t kChunk = 16384;
  const double least = length / 30;  // chosen: a third of a usual edge
  // The chord of a turn up to pi is at least this part of the turn: 1 - pi^2 / 24.
  constexpr double kChord = 0.58;
  const double slow = kChord * 2 * std::numbers::pi / length;
  const std::size_t n = mesh.faces.size();
  std::vector<std::vector<std::uint32_t>> found((n + kChunk - 1) / kChunk);
  parallel_for(n, kChunk, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& sharp = found[begin / kChunk];
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& corners = mesh.faces[t];
      const Vec3 own[3] = {normals[corners[0]], normals[corners[1]], normals[corners[2]]};
      // In nearly all triangles the normals turn less than the shortest edge allows.
      const double most = std::max(
          {square_of(own[1] - own[0]), square_of(own[2] - own[1]), square_of(own[0] - own[2])});
      const double shortest = std::min({square_of(own[0]), square_of(own[1]), square_of(own[2])});
      if (shortest > 0 && most < slow * slow * (least * least)) continue;
      const Vec3 at[3] = {mesh.vertices[corners[0]], mesh.vertices[corners[1]],
                          mesh.vertices[corners[2]]};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = k == 2 ? 0 : k + 1;
        const std::uint32_t a = corners[k], b = corners[next];
        if (a > b && a < n_own) continue;
        const bool known = dot(own[k], own[k]) > 0 && dot(own[next], own[next]) > 0;
        const Vec3 way = at[next] - at[k], change = own[next] - own[k];
        const double edge2 = std::clamp(dot(way, way), least * least, length * length / 4);
        if (known && dot(change, change) < slow * slow * edge2) continue;
        const double turn = 2 * std::numbers::pi * std::sqrt(edge2) / length;
        const double chord = turn - turn * turn * turn / 24;  // at most 2 sin(turn / 2)
        if (!known || norm(change) >= chord) sharp.push_back(a), sharp.push_back(b);
      }
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Keeps vertices around which normals point in all directions within half
// a loop. The normals along a shortest closed curve lie in no half-space.
std::vector<std::uint32_t> turning_around(const std::vector<SharpVertex>& sharp, double length) {
  struct Group {
    Cube cube;
    std::vector<std::uint32_t> vertices;
    Vec3 sum;
  };
  std::unordered_map<std::uint64_t, Group> groups;
  for (std::uint32_t v = 0; v < sharp.size(); ++v) {
    const Cube cube = cube_of(sharp[v].at, length / 2);
    Group& group = groups[key_of(cube)];
    group.cube = cube;
    group.vertices.push_back(v);
    group.sum += sharp[v].normal;
  }
  std::vector<std::uint32_t> kept;
  for (const auto& [key, group] : groups) {
    std::vector<const Group*> near;
    Vec3 sum;
    for_each_near(group.cube, [&](std::uint64_t other) {
      const auto at = groups.find(other);
      if (at == groups.end()) return;
      near.push_back(&at->second);
      sum += at->second.sum;
    });
    const Vec3 mean = normalized(sum);
    const bool on_one_side = std::all_of(near.begin(), near.end(), [&](const Group* other) {
      return std::all_of(other->vertices.begin(), other->vertices.end(),
                         [&](std::uint32_t v) { return dot(sharp[v].normal, mean) > kOneSide; });
    });
    if (!on_one_side) kept.insert(kept.end(), group.vertices.begin(), group.vertices.end());
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::vector<std::uint32_t> tight_places(const Mesh& mesh, const NormalAttributes& normals,
                                        double length, const Context& context) {
  const std::vector<std::uint32_t> all =
      sharp_vertices(mesh, normals, length, mesh.vertices.size(), context);
  std::vector<SharpVertex> sharp;
  sharp.reserve(all.size());
  for (const std::uint32_t v : all) sharp.push_back({mesh.vertices[v], normals[v]});
  std::vector<std::uint32_t> places = turning_around(sharp, length);
  for (std::uint32_t& v : places) v = all[v];
  return places;
}

}  // namespace rholm
