#include "shape/points/sign_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/signed_sets.h"
#include "shape/points/normals.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_sides.h"
#include "shape/queries/winding_tree.h"

namespace rholm {
namespace {

// Cosine of 45 degrees: what noise of normals and the bend of the surface leave.
constexpr double kSure = 0.7;
// Of the length of an edge: one end above the other. Walls 0.4 spacings apart, twice of which is
// the longest edge, are told edge by edge, nearer ones by means over many.
constexpr double kLevel = 0.2;
// Heights within so many times their median are the noise of the points.
constexpr double kNoise = 3;
// Two sheets: standard errors of the mean height, and its least share of the mean length of edges
// (chosen). A point has ten edges and each edge two ends: their heights are not independent.
constexpr double kWalls = 4, kLeastWall = 0.03, kEdgesOfPoint = 5;
// Edges that turn a piece: one or two may be chance, at corners. And of a point that contradicts.
constexpr std::uint32_t kFewestVotes = 3;
// Of all edges between two pieces, those that turn one: at tips thinner than the spacing few
// contradict.
constexpr double kLeastShare = 0.34;
constexpr std::size_t kSeeds = 2000;

// Radii of a patch behind and before points where winding numbers are asked: as turn_outwards().
constexpr double kInward = 0.75;        // from 1/2, of their mean: a quarter from what is wrong
constexpr std::size_t kLeastPart = 30;  // points of a component that has a say
constexpr double kClosed = 0.2;         // length of the mean normal, at most: side_balance.cpp
constexpr double kOpen = 0.25;  // mean error of the winding numbers of what bounds a body by itself
constexpr double kMost = 0.6;   // share of the points of a component that is turned
constexpr int kRounds = 16;     // components that are turned, at most

// Creases between pieces, where noise hides which way the surface bends: edges between normals at
// least 37 degrees apart. Their mean agreement, and how many standard errors it is from zero.
constexpr double kCrease = 0.8, kBend = 0.1, kSureBend = 4;
// Share of turned points from which creases that stay undecided are told.
constexpr double kManyTurned = 0.02;

enum class Says : std::int8_t { kNothing = 0, kAgree = 1, kContradict = -1 };

struct Edge {
  Says says = Says::kNothing;
  float height = 0;  // of the end above the begin, along their normals, of the length
};

class SignGraph {
 public:
  SignGraph(const PointTree& tree, std::span<const Vec3> points, std::span<const Vec3> normals,
            const SamplingGaps& gaps, const Context& context)
      : points_(points),
        normals_(normals),
        neighbors_(graph_neighbors(tree, gaps, context)),
        edges_(neighbors_.size()) {
    scatter_ = find_scatter();
    const double slack = kNoise * scatter_;
    parallel_for(points.size(), 1024, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin * kGraphNeighbors; e < end * kGraphNeighbors; ++e) {
        edges_[e] = look(e, slack);
      }
    });
  }

  std::size_t size() const { return edges_.size(); }
  std::uint32_t from(std::size_t e) const {
    return static_cast<std::uint32_t>(e / kGraphNeighbors);
  }
  std::uint32_t to(std::size_t e) const { return neighbors_[e]; }
  const Edge& operator[](std::size_t e) const { return edges_[e]; }
  // Median height of neighbours above the tangent planes of points.
  double scatter() const { return scatter_; }
  bool is_crease(std::size_t e) const {
    return std::abs(dot(normals_[from(e)], normals_[to(e)])) < kCrease;
  }
  double agreement_at(std::size_t e) const {
    const std::uint32_t i = from(e), j = to(e);
    return agreement(points_[i], normals_[i], points_[j], normals_[j], 0);
  }
  void forget(std::size_t e) { edges_[e].says = Says::kNothing; }

 private:
  double height_over(std::size_t e, const Vec3& normal) const {
    return dot(points_[to(e)] - points_[from(e)], normal);
  }

  double find_scatter() const {
    const std::size_t n = points_.size(), seeds = std::min(n, kSeeds);
    std::vector<double> heights;
    heights.reserve(seeds * kGraphNeighbors);
    for (std::size_t s = 0; s < seeds; ++s) {
      const std::size_t i = s * n / seeds;
      for (std::size_t e = i * kGraphNeighbors; e < (i + 1) * kGraphNeighbors; ++e) {
        if (to(e) != i) heights.push_back(std::abs(height_over(e, normals_[i])));
      }
    }
    if (heights.empty()) return 0;
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return *middle;
  }

  Edge look(std::size_t e, double slack) const {
    const std::uint32_t i = from(e), j = to(e);
    const double length = norm(points_[j] - points_[i]);
    if (i == j || !(length > 0)) return {};
    const double agreed = agreement(points_[i], normals_[i], points_[j], normals_[j], slack);
    if (std::abs(agreed) < kSure) return {};
    const Vec3 across = normals_[j] + (agreed < 0 ? -1.0 : 1.0) * normals_[i];
    const double height = height_over(e, across) / 2;
    if (std::abs(height) > slack + kLevel * length) return {};
    return {agreed < 0 ? Says::kContradict : Says::kAgree, static_cast<float>(height / length)};
  }

  std::span<const Vec3> points_, normals_;
  std::vector<std::uint32_t> neighbors_;
  std::vector<Edge> edges_;
  double scatter_ = 0;
};

// What edges between two pieces, or within one, say together.
struct Votes {
  std::uint32_t a = 0, b = 0;      // first points of the pieces, a <= b
  std::uint32_t n = 0, edges = 0;  // with a vote, and all
  double sum = 0, squares = 0;

  bool is_decided() const { return n >= kFewestVotes && n >= kLeastShare * edges; }
  double mean() const { return sum / n; }
  // Standard errors that the mean is from zero.
  double significance() const {
    const double variance = std::max(0.0, squares / n - mean() * mean());
    const double error = std::sqrt(variance * kEdgesOfPoint / n);
    return std::abs(mean()) / std::max(error, 1e-30);
  }
  // Of heights.
  bool is_of_walls() const { return std::abs(mean()) > kLeastWall && significance() > kWalls; }
};

// By pieces. value(e, x): whether the edge has a vote, and which; others are counted only.
template <class Find, class Value>
std::vector<Votes> count_votes(const SignGraph& graph, const Find& find, const Value& value) {
  std::vector<Votes> all;
  CancelPoll poll;
  for (std::size_t e = 0; e < graph.size(); ++e) {
    poll();
    Votes one{.edges = 1};
    std::tie(one.a, one.b) = std::minmax({find(graph.from(e)), find(graph.to(e))});
    if (value(e, one.sum)) {
      one.n = 1;
      one.squares = one.sum * one.sum;
    } else if (one.a == one.b) {
      continue;
    }
    all.push_back(one);
  }
  std::stable_sort(all.begin(), all.end(), [](const Votes& x, const Votes& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  std::size_t n = 0;
  for (const Votes& one : all) {
    if (n > 0 && all[n - 1].a == one.a && all[n - 1].b == one.b) {
      all[n - 1].n += one.n, all[n - 1].edges += one.edges;
      all[n - 1].sum += one.sum, all[n - 1].squares += one.squares;
    } else {
      all[n++] = one;
    }
  }
  all.resize(n);
  std::erase_if(all, [](const Votes& one) { return one.n == 0; });
  return all;
}

// Edges between walls say nothing.
void forget_walls(const std::vector<Votes>& quarrels, DisjointSets& pieces, SignGraph& graph) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> walls;
  for (const Votes& one : quarrels) {
    if (one.is_of_walls()) walls.emplace_back(one.a, one.b);
  }
  if (walls.empty()) return;
  for (std::size_t e = 0; e < graph.size(); ++e) {
    if (graph[e].says != Says::kContradict) continue;
    const std::pair<std::uint32_t, std::uint32_t> pair =
        std::minmax({pieces.find(graph.from(e)), pieces.find(graph.to(e))});
    if (std::binary_search(walls.begin(), walls.end(), pair)) graph.forget(e);
  }
}

// Points that contradict many neighbours, as many as turn a piece. The first of them.
std::size_t count_contradicting(const SignGraph& graph, std::span<const std::uint8_t> turned,
                                std::span<const std::uint8_t> foreign, std::uint32_t& first) {
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < graph.size(); begin += kGraphNeighbors) {
    const std::uint32_t i = graph.from(begin);
    if (!foreign.empty() && foreign[i] != 0) continue;
    std::uint32_t against = 0;
    for (std::size_t e = begin; e < begin + kGraphNeighbors; ++e) {
      const bool opposite = !turned.empty() && turned[i] != turned[graph.to(e)];
      const Says wanted = opposite ? Says::kAgree : Says::kContradict;
      if (graph[e].says == wanted) ++against;
    }
    if (against < kFewestVotes) continue;
    if (count++ == 0) first = i;
  }
  return count;
}

// The winding numbers of some samples behind and before each of them.
struct BothSides {
  double behind = 0, before = 0;
  double mean() const { return (behind + before) / 2; }
};
std::vector<BothSides> ask_both_sides(std::span<const Vec3> points, std::span<const double> areas,
                                      double scatter, std::span<const Vec3> normals,
                                      const Context& context) {
  const std::size_t n = points.size();
  std::vector<Vec3> area_normals(n), places(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    area_normals[i] = areas[i] * normals[i];
    const double radius = std::sqrt(areas[i] / std::numbers::pi);
    const Vec3 step = (kClearOfPatches * radius + kNoise * scatter) * normals[i];
    places[2 * i] = points[i] - step;
    places[2 * i + 1] = points[i] + step;
  }
  const WindingTree tree(points, area_normals);
  const std::vector<double> w = tree.winding(places, context);
  std::vector<BothSides> sides(n);
  for (std::size_t i = 0; i < n; ++i) sides[i] = {w[2 * i], w[2 * i + 1]};
  return sides;
}

// Whether points bound a body by themselves: behind or before them the winding number of these
// points alone is 0, and it is 1 or -1 on the other side.
bool bound_a_body(std::span<const Vec3> points, std::span<const double> areas, double scatter,
                  std::span<const Vec3> normals, const Context& context) {
  double off = 0;
  for (const BothSides& s : ask_both_sides(points, areas, scatter, normals, context)) {
    const double less = std::min(std::abs(s.behind), std::abs(s.before));
    const double more = std::max(std::abs(s.behind), std::abs(s.before));
    off += std::min(1.0, less + std::abs(more - 1));
  }
  return off < kOpen * static_cast<double>(points.size());
}

// Per point, for the first points of pieces: whether the piece bounds a body. Bodies that touch
// contradict each other where they do, and none is to be turned for that.
std::vector<std::uint8_t> find_closed(const std::vector<Votes>& quarrels, DisjointSets& pieces,
                                      std::span<const Vec3> points, std::span<const Vec3> normals,
                                      std::span<const PointArea> samples, double scatter,
                                      const Context& context) {
  std::vector<std::uint8_t> closed(points.size(), 0);
  std::vector<std::uint32_t> asked;
  for (const Votes& one : quarrels) {
    if (one.a != one.b) asked.insert(asked.end(), {one.a, one.b});
  }
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  if (asked.empty()) return closed;
  std::vector<std::vector<PointArea>> own(asked.size());
  for (const PointArea& sample : samples) {
    const std::uint32_t piece = pieces.find(sample.point);
    const auto found = std::lower_bound(asked.begin(), asked.end(), piece);
    if (found != asked.end() && *found == piece) own[found - asked.begin()].push_back(sample);
  }
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (own[k].size() < kLeastPart) continue;
    std::vector<Vec3> at, out;
    std::vector<double> areas;
    for (const PointArea& sample : own[k]) {
      at.push_back(points[sample.point]), out.push_back(normals[sample.point]);
      areas.push_back(sample.area);
    }
    closed[asked[k]] = bound_a_body(at, areas, scatter, out, context) ? 1 : 0;
  }
  return closed;
}

// Pieces turned to agree, the most decided ones first.
SignedSets join_pieces(std::vector<Votes> quarrels, const std::vector<std::uint8_t>& closed,
                       DisjointSets& pieces, std::size_t n) {
  SignedSets sets(n);
  for (std::uint32_t i = 0; i < n; ++i) sets.unite(pieces.find(i), i, false);
  std::stable_sort(quarrels.begin(), quarrels.end(),
                   [](const Votes& x, const Votes& y) { return x.n > y.n; });
  for (const Votes& one : quarrels) {
    const bool touch = closed[one.a] != 0 && closed[one.b] != 0;
    if (one.a != one.b && one.is_decided() && !touch && !one.is_of_walls()) {
      sets.unite(one.a, one.b, true);
    }
  }
  return sets;
}

// What creases join. Returns the number of edges at creases that stay undecided.
std::size_t join_at_creases(const SignGraph& graph, SignedSets& sets) {
  const auto find = [&](std::uint32_t i) { return sets.find(i).set; };
  std::vector<Votes> votes = count_votes(graph, find, [&](std::size_t e, double& agreed) {
    if (!graph.is_crease(e)) return false;
    const SignedSets::Member a = sets.find(graph.from(e)), b = sets.find(graph.to(e));
    if (a.set == b.set) return false;
    agreed = graph.agreement_at(e) * (a.opposite == b.opposite ? 1 : -1);
    return true;
  });
  std::erase_if(votes, [](const Votes& one) { return !one.is_decided(); });
  std::stable_sort(votes.begin(), votes.end(), [](const Votes& x, const Votes& y) {
    return std::abs(x.sum) > std::abs(y.sum);
  });
  const auto is_sure = [](const Votes& one) {
    return std::abs(one.mean()) > kBend && one.significance() > kSureBend;
  };
  for (const Votes& one : votes) {
    if (is_sure(one)) sets.unite(one.a, one.b, one.sum < 0);
  }
  std::size_t undecided = 0;
  for (const Votes& one : votes) {
    if (find(one.a) != find(one.b)) undecided += one.n;
  }
  return undecided;
}

// In every set the fewer points are turned.
void turn_fewer(SignedSets& sets, SignCheck& check) {
  const std::size_t n = check.turned.size();
  std::vector<std::array<std::uint32_t, 2>> sizes(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const SignedSets::Member own = sets.find(i);
    ++sizes[own.set][own.opposite ? 1 : 0];
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const SignedSets::Member own = sets.find(i);
    const bool opposite_ones = sizes[own.set][1] <= sizes[own.set][0];
    check.turned[i] = own.opposite == opposite_ones ? 1 : 0;
    check.component[i] = own.set;
  }
}

bool faces_inward(double mean_winding) { return std::abs(mean_winding - 0.5) > kInward; }

// What the points of a component say together.
struct Part {
  double area = 0, inward = 0;
  Vec3 normal;
  std::size_t n = 0;

  bool is_to_turn() const {
    return n >= kLeastPart && norm(normal) < kClosed * area && inward > kMost * area;
  }
};

}  // namespace

SideCheck check_sides(std::span<const Vec3> points, std::span<const Vec3> normals,
                      std::span<const PointArea> samples, double scatter,
                      std::span<const std::uint32_t> component, const Context& context) {
  SideCheck check;
  std::vector<Vec3> at, out;
  std::vector<double> areas;
  std::vector<std::uint32_t> firsts;
  for (const PointArea& sample : samples) {
    at.push_back(points[sample.point]), out.push_back(normals[sample.point]);
    areas.push_back(sample.area);
    firsts.push_back(component[sample.point]);
  }
  std::sort(firsts.begin(), firsts.end());
  firsts.erase(std::unique(firsts.begin(), firsts.end()), firsts.end());
  for (int round = 0;; ++round) {
    const std::vector<BothSides> sides = ask_both_sides(at, areas, scatter, out, context);
    std::vector<Part> parts(firsts.size());
    std::size_t inward = 0;
    const auto part_of = [&](std::size_t s) {
      const std::uint32_t first = component[samples[s].point];
      return static_cast<std::size_t>(std::lower_bound(firsts.begin(), firsts.end(), first) -
                                      firsts.begin());
    };
    for (std::size_t s = 0; s < at.size(); ++s) {
      Part& own = parts[part_of(s)];
      ++own.n;
      own.area += areas[s];
      own.normal += areas[s] * out[s];
      if (!faces_inward(sides[s].mean())) continue;
      own.inward += areas[s];
      ++inward;
    }
    check.inward = at.empty() ? 0 : static_cast<double>(inward) / static_cast<double>(at.size());
    if (parts.size() < 2 || round == kRounds) return check;
    // The largest first: what is inside it is asked again.
    std::size_t largest = 0;
    for (std::size_t k = 1; k < parts.size(); ++k) {
      const auto rank = [&](std::size_t p) {
        return std::pair(parts[p].is_to_turn(), parts[p].area);
      };
      if (rank(k) > rank(largest)) largest = k;
    }
    if (!parts[largest].is_to_turn()) return check;
    const std::uint32_t first = firsts[largest];
    const auto found = std::find(check.turned.begin(), check.turned.end(), first);
    if (found == check.turned.end()) {
      check.turned.push_back(first);
    } else {
      check.turned.erase(found);
    }
    for (std::size_t s = 0; s < at.size(); ++s) {
      if (part_of(s) == largest) out[s] = -out[s];
    }
  }
}

SignCheck check_signs(const PointTree& tree, std::span<const Vec3> points,
                      std::span<const Vec3> normals, const SamplingGaps& gaps,
                      std::span<const PointArea> samples, std::span<const std::uint8_t> foreign,
                      const Context& context) {
  SignCheck check;
  const std::size_t n = points.size();
  if (n == 0) return check;
  SignGraph graph(tree, points, normals, gaps, context);
  DisjointSets pieces(n);
  check.scatter = graph.scatter();
  CancelPoll poll;
  for (std::size_t e = 0; e < graph.size(); ++e) {
    poll();
    if (graph[e].says == Says::kAgree) pieces.unite(graph.from(e), graph.to(e));
  }
  const std::vector<Votes> quarrels = count_votes(
      graph, [&](std::uint32_t i) { return pieces.find(i); },
      [&](std::size_t e, double& height) {
        height = graph[e].height;
        return graph[e].says == Says::kContradict;
      });
  forget_walls(quarrels, pieces, graph);
  check.contradicting = count_contradicting(graph, {}, foreign, check.first);
  const std::vector<std::uint8_t> closed =
      find_closed(quarrels, pieces, points, normals, samples, check.scatter, context);
  SignedSets sets = join_pieces(quarrels, closed, pieces, n);
  const std::size_t undecided = join_at_creases(graph, sets);
  check.turned.resize(n);
  check.component.resize(n);
  turn_fewer(sets, check);
  for (std::size_t i = 0; i < n; ++i) {
    if (foreign.empty() || foreign[i] == 0) check.n_turned += check.turned[i];
  }
  check.left = count_contradicting(graph, check.turned, foreign, check.first_left);
  // Between the sides of a crease nothing is known: it may be that one is to be turned, too.
  if (static_cast<double>(check.n_turned) > kManyTurned * static_cast<double>(n)) {
    check.left += undecided / kGraphNeighbors;
  }
  return check;
}

}  // namespace rholm
