#include "shape/points/sign_pieces.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/cancel.h"
#include "base/disjoint_sets.h"
#include "shape/points/sign_graph.h"

namespace rholm {
namespace {

// Number of edges per point, with dependent values: a point has ten edges, and an edge two ends.
constexpr double kEdgesOfPoint = 5;

// Numbers the pieces in the order of first points, among points reached from own points.
void number_pieces(const SignGraph& graph, std::span<const std::uint8_t> foreign,
                   DisjointSets& sets, SignPieces& pieces) {
  const std::size_t n = graph.n_points();
  std::vector<std::uint8_t> reached(n, foreign.empty() ? 1 : 0);
  for (std::size_t e = 0; e < graph.size() && !foreign.empty(); ++e) {
    if (foreign[graph.from(e)] == 0) reached[graph.from(e)] = reached[graph.to(e)] = 1;
  }
  // The first point of a set may be foreign; it is reached if its set is held together.
  pieces.piece.assign(n, kNoPiece);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (reached[i] == 0) continue;
    const std::uint32_t first = sets.find(i);
    if (first == i) {
      pieces.piece[i] = static_cast<std::uint32_t>(pieces.own.size());
      pieces.own.push_back(0);
    } else {
      pieces.piece[i] = pieces.piece[first];
    }
    if (foreign.empty() || foreign[i] == 0) ++pieces.own[pieces.piece[i]];
  }
}

}  // namespace

double Moments::significance() const {
  const double variance = std::max(0.0, squares / n - mean() * mean());
  const double error = std::sqrt(variance * kEdgesOfPoint / n);
  return std::abs(mean()) / std::max(error, 1e-30);
}

void merge(std::vector<PiecePair>& pairs) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const PiecePair& x, const PiecePair& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  std::size_t n = 0;
  for (const PiecePair& pair : pairs) {
    if (n > 0 && pairs[n - 1].a == pair.a && pairs[n - 1].b == pair.b) {
      pairs[n - 1].edges += pair.edges;
      pairs[n - 1].heights.add(pair.heights), pairs[n - 1].bends.add(pair.bends);
    } else {
      pairs[n++] = pair;
    }
  }
  pairs.resize(n);
}

SignPieces find_sign_pieces(const PointTree& tree, std::span<const Vec3> points,
                            std::span<const Vec3> normals, const SamplingGaps& gaps,
                            std::span<const std::uint8_t> foreign, const Context& context,
                            std::vector<std::uint32_t> neighbors) {
  SignPieces pieces;
  if (points.empty()) return pieces;
  if (neighbors.empty()) neighbors = graph_neighbors(tree, gaps, context);
  const SignGraph graph(std::move(neighbors), points, normals, foreign, context);
  pieces.scatter = graph.scatter();
  DisjointSets sets(points.size());
  CancelPoll poll;
  for (std::size_t e = 0; e < graph.size(); ++e) {
    poll();
    if (graph[e].says == Says::kAgree) sets.unite(graph.from(e), graph.to(e));
  }
  number_pieces(graph, foreign, sets, pieces);
  for (std::size_t e = 0; e < graph.size(); ++e) {
    poll();
    if (graph[e].says == Says::kAgree) continue;  // the edge is within a piece
    const std::uint32_t i = graph.from(e), j = graph.to(e);
    if (!foreign.empty() && foreign[i] != 0) continue;
    const bool contradicts = graph[e].says == Says::kContradict;
    const std::uint32_t own = pieces.piece[i], other = pieces.piece[j];
    if (own == other && !contradicts) continue;
    PiecePair pair;
    pair.edges = 1;
    std::tie(pair.a, pair.b) = std::minmax(own, other);
    if (contradicts) {
      pair.heights.add(static_cast<double>(graph[e].height));
      pieces.quarrels.push_back({i, other});
    }
    if (own != other && graph.is_crease(e)) pair.bends.add(graph.agreement_at(e));
    pieces.pairs.push_back(pair);
  }
  merge(pieces.pairs);
  std::erase_if(pieces.pairs,
                [](const PiecePair& pair) { return pair.heights.n == 0 && pair.bends.n == 0; });
  return pieces;
}

}  // namespace rholm
