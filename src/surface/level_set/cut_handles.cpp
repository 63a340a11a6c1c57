#include "surface/level_set/cut_handles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "base/shared_sets.h"
#include "shape/topology/cut_graph.h"
#include "shape/topology/loops.h"
#include "shape/topology/mates.h"
#include "surface/level_set/components.h"
#include "surface/level_set/mesh_piece.h"
#include "surface/level_set/tight_places.h"

namespace rholm {
namespace {

// Longest loop, in resolutions like all lengths here. With 4, three of 120
// inputs keep handles (scripts/scan-figures --inputs 1k,3k --seeds 1,2,3,4,5,
// true normals), with 5 none. True tubes three spacings wide have loops of 8.5.
constexpr double kGirth = 5;
// On each side of the loop, within kBeside of it, the surface must have the
// area of a tube of this girth plus kOpen of a disc. None of the 120 inputs
// needs less than half a disc. Rings of rods 1.6 spacings wide lose their
// handle more often with a quarter than with 0.4 (scripts/scan-limits --rods).
constexpr double kBeside = 3;
constexpr double kOpen = 0.4;
// Reach of the mesh piece around a vertex on a loop: half
// of the loop, and the surface beside the loop's middle.
constexpr double kReach = kGirth / 4 + kBeside + kGirth / (2 * std::numbers::pi);
// Local resolutions are limited to this factor of the typical one,
// because a feature that is small here may be large elsewhere.
constexpr double kCoarsest = 1.5;
// Chosen: cut ends look smooth, and the surface around them does not move.
constexpr std::size_t kRings = 3, kRounds = 8;

// Span of 64-bit vectors under exclusive or; 64 independent vectors span everything.
class BitBasis {
 public:
  bool is_full() const { return n_ == of_.size(); }
  bool has(std::uint64_t bits) const { return rest_of(bits) == 0; }
  void add(std::uint64_t bits) {
    bits = rest_of(bits);
    if (bits == 0) return;
    of_[static_cast<std::size_t>(std::bit_width(bits)) - 1] = bits;
    ++n_;
  }

 private:
  std::uint64_t rest_of(std::uint64_t bits) const {
    while (bits != 0) {
      const std::uint64_t own = of_[static_cast<std::size_t>(std::bit_width(bits)) - 1];
      if (own == 0) break;
      bits ^= own;
    }
    return bits;
  }
  std::array<std::uint64_t, 64> of_{};  // vector k has its highest bit at k
  std::size_t n_ = 0;
};

// Compares the Euler characteristic V - E + F with two per component.
bool has_handles(const Mesh& mesh, const Context& context) {
  const std::size_t parts = first_members(connected_vertices(mesh, context), context).size();
  return 2 * mesh.vertices.size() < mesh.faces.size() + 4 * parts;
}

// Returns the area joined to the left of the loop within a ball; stops at `enough`.
double area_beside(const Mesh& mesh, const std::vector<std::uint32_t>& mates,
                   const std::vector<std::uint32_t>& loop, const Vec3& middle, double radius,
                   double enough) {
  const std::unordered_set<std::uint32_t> wall(loop.begin(), loop.end());
  std::unordered_set<std::uint32_t> seen;
  std::vector<std::uint32_t> queue;
  double area = 0;
  const auto enter = [&](std::uint32_t t) {
    const Vec3 &a = mesh.vertices[mesh.faces[t][0]], &b = mesh.vertices[mesh.faces[t][1]],
               &c = mesh.vertices[mesh.faces[t][2]];
    if (norm((a + b + c) / 3 - middle) > radius || !seen.insert(t).second) return;
    area += norm(cross(b - a, c - a)) / 2;
    queue.push_back(t);
  };
  for (const std::uint32_t c : loop) enter(c / 3);
  for (std::size_t i = 0; i < queue.size() && area < enough; ++i) {
    for (std::uint32_t c = 3 * queue[i]; c < 3 * queue[i] + 3; ++c) {
      if (!wall.contains(c) && mates[c] != kNoMate) enter(mates[c] / 3);
    }
  }
  return area;
}

bool opens_on_both_sides(const Mesh& mesh, const std::vector<std::uint32_t>& mates,
                         const Loop& loop, double resolution) {
  std::vector<std::uint32_t> back;
  Vec3 sum;
  for (const std::uint32_t c : loop.corners) {
    back.push_back(mates[c]);
    sum += mesh.vertices[start_of(mesh.faces, c)];
  }
  const Vec3 middle = sum / static_cast<double>(loop.corners.size());
  const double beside = kBeside * resolution;
  const double radius = beside + loop.length / (2 * std::numbers::pi);
  const double enough =
      (kGirth * kBeside + kOpen * std::numbers::pi * kBeside * kBeside) * resolution * resolution;
  return area_beside(mesh, mates, loop.corners, middle, radius, enough) >= enough &&
         area_beside(mesh, mates, back, middle, radius, enough) >= enough;
}

struct Candidate {
  double length = 0;
  std::uint32_t base = 0;  // vertex where the loop begins
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.length != b.length ? a.length < b.length : a.base < b.base;
  }
};

// Finds the loops of one mesh piece.
class LoopsOfPiece {
 public:
  LoopsOfPiece(const MeshPiece& piece, const Resolution& resolution)
      : mesh_(piece.mesh),
        resolution_(resolution),
        mates_(find_mates(mesh_.vertices.size(), mesh_.faces)),
        outgoing_(inner_outgoing(mesh_.vertices.size(), mesh_.faces, mates_)),
        graph_(make_cut_graph(mesh_, mates_)) {}

  // Chooses loops that are open on both sides, shortest first, with no two adjacent. `left_out`
  // receives the base vertices of adjacent ones. Once 64 independent loops are chosen, parallel
  // loops of a tube are no longer recognised.
  std::vector<LoopSides> choose(std::vector<std::uint32_t>& left_out,
                                const Context& context) const {
    std::vector<LoopSides> loops;
    LoopSearch search(mesh_, mates_, outgoing_, graph_);
    std::unordered_set<std::uint32_t> touched;
    BitBasis chosen;
    for (const Candidate& candidate : candidates(context)) {
      const double own = resolution_at(candidate.base);
      const Loop loop = search.shortest(candidate.base, kGirth * own);
      const auto is_touched = [&](std::uint32_t c) {
        return touched.contains(start_of(mesh_.faces, c));
      };
      if (!chosen.is_full() && chosen.has(loop.crossed)) continue;
      if (std::any_of(loop.corners.begin(), loop.corners.end(), is_touched)) {
        left_out.push_back(candidate.base);
        continue;
      }
      if (!opens_on_both_sides(mesh_, mates_, loop, own)) continue;
      chosen.add(loop.crossed);
      for (const std::uint32_t c : loop.corners) {
        touched.insert(start_of(mesh_.faces, c));
        for_each_outgoing(mates_, c,
                          [&](std::uint32_t other) { touched.insert(end_of(mesh_.faces, other)); });
      }
      loops.push_back(sides_of(loop.corners, mesh_.faces, mates_));
    }
    return loops;
  }

 private:
  double resolution_at(std::uint32_t v) const {
    return std::min(resolution_.at(mesh_.vertices[v]), kCoarsest * resolution_.typical);
  }

  // Returns the base vertices of short loops.
  std::vector<Candidate> candidates(const Context& context) const {
    if (resolution_.foresee) {
      std::vector<Vec3> places;
      for (const std::uint32_t v : graph_.vertices) {
        if (outgoing_[v] != kNoMate) places.push_back(mesh_.vertices[v]);
      }
      resolution_.foresee(places);
    }
    std::vector<Candidate> all(graph_.vertices.size());
    parallel_for(all.size(), 64, context, {}, [&](std::size_t begin, std::size_t end) {
      LoopSearch search(mesh_, mates_, outgoing_, graph_);
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t v = graph_.vertices[i];
        if (outgoing_[v] == kNoMate) continue;
        all[i] = {search.shortest(v, kGirth * resolution_at(v)).length, v};
      }
    });
    std::erase_if(all, [](const Candidate& c) { return !(c.length > 0); });
    std::sort(all.begin(), all.end());
    return all;
  }

  const Mesh& mesh_;
  const Resolution& resolution_;
  std::vector<std::uint32_t> mates_, outgoing_;
  CutGraph graph_;
};

// Converts a loop of the piece to the indices of the whole mesh.
LoopSides on_whole(const MeshPiece& piece, LoopSides loop) {
  for (std::uint32_t& v : loop.vertices) v = piece.vertices[v];
  for (auto& [i, c] : loop.right) c = 3 * piece.faces[c / 3] + c % 3;
  return loop;
}

// Returns 1 for loops whose common cut keeps the mesh connected. A spanning forest of
// the longest loops, between the parts that all cuts together would leave, stays uncut.
std::vector<std::uint8_t> without_parting(const Mesh& mesh, const std::vector<LoopSides>& loops,
                                          const JoinedOutside& outside, const Context& context) {
  std::unordered_map<std::uint32_t, std::uint32_t> right;  // corners of the mesh to new vertices
  std::unordered_set<std::uint32_t> cut;
  auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<std::uint32_t> first;
  for (const LoopSides& loop : loops) {
    first.push_back(n);
    for (const auto& [i, c] : loop.right) {
      right[c] = n + static_cast<std::uint32_t>(i);
      cut.insert(c / 3);
    }
    n += static_cast<std::uint32_t>(loop.vertices.size());
  }
  std::vector<std::uint32_t> in_order(cut.begin(), cut.end());
  std::sort(in_order.begin(), in_order.end());
  SharedSets sets(n + outside.n);
  for (const auto& [v, piece] : outside.vertices) sets.unite(v, n + piece);
  parallel_for(mesh.faces.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    auto next_cut = std::lower_bound(in_order.begin(), in_order.end(), begin);
    for (std::size_t t = begin; t < end; ++t) {
      Triangle corners = mesh.faces[t];
      if (next_cut != in_order.end() && *next_cut == t) {
        ++next_cut;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto at = right.find(static_cast<std::uint32_t>(3 * t + k));
          if (at != right.end()) corners[k] = at->second;
        }
      }
      sets.unite(corners[0], corners[1]);
      sets.unite(corners[1], corners[2]);
    }
  });
  std::vector<std::uint8_t> may_be_cut(loops.size(), 0);
  for (std::size_t i = loops.size(); i-- > 0;) {
    if (sets.find(loops[i].vertices[0]) == sets.find(first[i])) {
      may_be_cut[i] = 1;
    } else {
      sets.unite(loops[i].vertices[0], first[i]);
    }
  }
  return may_be_cut;
}

// Cuts non-adjacent loops near `centers`; the bases of loops left out become the next
// centres. Returns the number of cuts; `copies` and `middles` receive vertices of the mesh.
std::size_t cut_once(Mesh& mesh, const Resolution& resolution, std::vector<std::uint32_t>& centers,
                     std::vector<std::uint32_t>& copies, std::vector<std::uint32_t>& middles,
                     const std::function<const JoinedOutside&()>& outside, const Context& context) {
  const MeshPiece piece = piece_around(mesh, centers, kReach * resolution.typical, context);
  centers.clear();
  const std::vector<LoopSides> loops = LoopsOfPiece(piece, resolution).choose(centers, context);
  if (loops.empty()) return 0;
  for (std::uint32_t& v : centers) v = piece.vertices[v];
  std::vector<LoopSides> whole;
  whole.reserve(loops.size());
  for (const LoopSides& loop : loops) whole.push_back(on_whole(piece, loop));
  const std::vector<std::uint8_t> may_be_cut = without_parting(mesh, whole, outside(), context);
  std::size_t n_cut = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (may_be_cut[i] == 0) continue;
    ++n_cut;
    cut_along(whole[i], mesh, copies);
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    middles.push_back(last - 1), middles.push_back(last);
  }
  return n_cut;
}

// Moves vertices at cut ends to the means of their neighbours,
// kRounds times. `ends`: the middle vertices of the cut ends.
void smooth_ends(Mesh& mesh, std::vector<std::uint32_t> ends, double reach,
                 const Context& context) {
  const MeshPiece piece = piece_around(mesh, ends, reach, context);
  for (std::uint32_t& v : ends) {
    v = static_cast<std::uint32_t>(
        std::lower_bound(piece.vertices.begin(), piece.vertices.end(), v) - piece.vertices.begin());
  }
  const std::vector<Triangle>& triangles = piece.mesh.faces;
  const std::vector<std::uint32_t> mates = find_mates(piece.vertices.size(), triangles);
  const std::vector<std::uint32_t> outgoing =
      inner_outgoing(piece.vertices.size(), triangles, mates);
  const auto distinct = [&] {
    std::erase_if(ends, [&](std::uint32_t v) { return outgoing[v] == kNoMate; });
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  };
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    distinct();
    const std::vector<std::uint32_t> inner = ends;
    for (const std::uint32_t v : inner) {
      for_each_outgoing(mates, outgoing[v],
                        [&](std::uint32_t c) { ends.push_back(end_of(triangles, c)); });
    }
  }
  distinct();
  std::vector<Vec3> places = piece.mesh.vertices, means(ends.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
      Vec3 sum;
      double n = 0;
      for_each_outgoing(mates, outgoing[ends[i]], [&](std::uint32_t c) {
        sum += places[end_of(triangles, c)];
        n += 1;
      });
      means[i] = sum / n;
    }
    for (std::size_t i = 0; i < ends.size(); ++i) places[ends[i]] = means[i];
  }
  const NormalAttributes normals = normal_attributes(mesh);
  for (const std::uint32_t v : ends) {
    mesh.vertices[piece.vertices[v]] = places[v];
    normals.set(piece.vertices[v], {});
  }
}

}  // namespace

double length_of_tight_places(double typical) { return kGirth * kCoarsest * typical; }

// piece_around() takes less than twice its reach along each axis.
double reach_of_cuts(double typical) { return 2 * std::max(kReach, kGirth) * typical; }

// A loop is judged by the mesh within kBeside local resolutions plus half its
// length. The piece within kReach of the given vertices contains this mesh.
std::vector<std::uint32_t> places_to_cut(const Mesh& mesh, const std::vector<std::uint32_t>& places,
                                         const Resolution& resolution, const Context& context) {
  const MeshPiece piece = piece_around(mesh, places, kReach * resolution.typical, context);
  std::vector<std::uint32_t> left_out;  // loops adjacent to chosen ones
  std::vector<Vec3> on_loops;
  for (const LoopSides& loop : LoopsOfPiece(piece, resolution).choose(left_out, context)) {
    for (const std::uint32_t v : loop.vertices) on_loops.push_back(piece.mesh.vertices[v]);
  }
  const NearPlaces near(on_loops, (kCoarsest * (kBeside + kGirth) + kReach) * resolution.typical);
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t v : places) {
    if (near.has(mesh.vertices[v])) kept.push_back(v);
  }
  return kept;
}

CutHandles cut_handles_at(Mesh& mesh, std::vector<std::uint32_t> places,
                          const Resolution& resolution,
                          const std::function<JoinedOutside()>& outside, const Context& context) {
  std::optional<JoinedOutside> known;
  const auto once = [&]() -> const JoinedOutside& {
    if (!known) known = outside ? outside() : JoinedOutside{};
    return *known;
  };
  CutHandles result;
  std::vector<std::uint32_t> middles;
  const std::size_t n_given = mesh.vertices.size();
  while (!places.empty()) {
    const std::size_t n = cut_once(mesh, resolution, places, result.copies, middles, once, context);
    if (n == 0) break;
    result.handles += n;
  }
  // A loop may contain copies made by an earlier cut.
  for (std::uint32_t& v : result.copies) {
    if (v >= n_given) v = result.copies[v - n_given];
  }
  if (result.handles > 0) {
    smooth_ends(mesh, std::move(middles), kGirth * resolution.typical, context);
  }
  return result;
}

CutHandles cut_handles(Mesh& mesh, const Resolution& resolution, const Context& context) {
  std::vector<std::uint32_t> places = tight_places(
      mesh, normal_attributes(mesh), length_of_tight_places(resolution.typical), context);
  if (places.empty() || !has_handles(mesh, context)) return {};
  return cut_handles_at(mesh, std::move(places), resolution, {}, context);
}

}  // namespace rholm
