#include "shape/points/orient_graph.h"

#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/signed_sets.h"

namespace rholm {
namespace {

// Identifies an edge, point to i-th neighbour, by its place in fits.neighbors.
using EdgeIndex = std::uint32_t;

// Number of sorting steps of weights; normals are not known well enough for finer steps.
constexpr std::size_t kSteps = 4096;
// Extra weight of an edge along the normals: its ends may be on two sheets, so edges within a sheet
// come first. Chosen: at most half the weight of normals at a right angle.
constexpr double kAcross = 0.5;
// Largest weight of a sure edge: its normals agree within about 45 degrees.
constexpr double kDoubt = 0.3;
constexpr double kSlack = 3;  // standard deviations of the points from their surface

class Graph {
 public:
  Graph(std::span<const Vec3> points, const LocalFits& fits, std::span<const Vec3> normals)
      : points_(points), fits_(fits), normals_(normals), noise_(noise_of(fits)) {}

  std::size_t n_places() const { return fits_.neighbors.size(); }
  std::uint32_t from(EdgeIndex e) const { return e / kGraphNeighbors; }
  std::uint32_t to(EdgeIndex e) const { return fits_.neighbors[e]; }
  double agreement_of(EdgeIndex e) const {
    const std::uint32_t i = from(e), j = to(e);
    // Points within the scatter are one sheet. On clean points, the scatter of the fits is caused
    // by curvature, which grows with the distance.
    const double scatter = fits_.noisy ? noise_ : fits_.typical_residual * fits_.radius[i];
    return agreement(points_[i], normals_[i], points_[j], normals_[j], kSlack * scatter);
  }
  // Returns the weight of an edge, 0 ... 1 + kAcross.
  double weight(EdgeIndex e, double agreed) const {
    const Vec3 edge = normalized(points_[to(e)] - points_[from(e)]);
    const double across =
        std::max(std::abs(dot(edge, normals_[from(e)])), std::abs(dot(edge, normals_[to(e)])));
    return 1 - std::abs(agreed) + (fits_.noisy ? 0 : kAcross * across * across);
  }
  // Returns true if the edge joins two different points that both have a normal.
  bool exists(EdgeIndex e) const {
    const std::uint32_t i = from(e), j = to(e);
    return i != j && norm(normals_[i]) > 0 && norm(normals_[j]) > 0;
  }

 private:
  static double noise_of(const LocalFits& fits) {
    std::vector<double> scatter(fits.radius.size());
    for (std::size_t i = 0; i < scatter.size(); ++i) {
      scatter[i] = static_cast<double>(fits.residual[i]) * fits.radius[i];
    }
    const auto middle = scatter.begin() + static_cast<std::ptrdiff_t>(scatter.size() / 2);
    std::nth_element(scatter.begin(), middle, scatter.end());
    return *middle;
  }

  std::span<const Vec3> points_;
  const LocalFits& fits_;
  std::span<const Vec3> normals_;
  double noise_ = 0;
};

struct SortedEdges {
  std::vector<EdgeIndex> edges;  // by weight, then by place
  std::vector<char> opposite;    // true if the ends have opposite signs; in the order of `edges`
  std::size_t n_sure = 0;        // number of sure edges, which come first
};

// Sorts the edges in one counting sort over steps of weight.
SortedEdges sort_edges(const Graph& graph) {
  const std::size_t n = graph.n_places();
  std::vector<std::uint16_t> step(n);  // kSteps: no edge
  std::vector<char> opposite(n);
  std::vector<std::size_t> begin(kSteps + 1, 0);
  CancelPoll poll;
  for (EdgeIndex e = 0; e < n; ++e) {
    poll();
    step[e] = kSteps;
    if (!graph.exists(e)) continue;
    const double agreed = graph.agreement_of(e);
    opposite[e] = agreed < 0;
    const double share = std::clamp(graph.weight(e, agreed) / (1 + kAcross), 0.0, 1.0);
    step[e] = static_cast<std::uint16_t>(share * (kSteps - 1));
    ++begin[step[e] + 1];
  }
  for (std::size_t s = 0; s < kSteps; ++s) begin[s + 1] += begin[s];
  SortedEdges sorted;
  sorted.n_sure = begin[static_cast<std::size_t>(kDoubt / (1 + kAcross) * (kSteps - 1)) + 1];
  sorted.edges.resize(begin[kSteps]);
  sorted.opposite.resize(begin[kSteps]);
  for (EdgeIndex e = 0; e < n; ++e) {
    poll();
    if (step[e] == kSteps) continue;
    const std::size_t place = begin[step[e]]++;
    sorted.edges[place] = e;
    sorted.opposite[place] = opposite[e];
  }
  return sorted;
}

// The sum of the votes of all edges between two pieces.
struct Votes {
  std::uint32_t a = 0, b = 0;  // smallest point of each piece, a < b
  double sum = 0;              // positive: both points need the same sign
};

// Sums votes by pieces; counts(e) tells whether an edge has a vote.
template <typename Counts>
std::vector<Votes> sum_votes(const Graph& graph, const SortedEdges& sorted, const Counts& counts,
                             SignedSets& sets) {
  std::vector<Votes> votes;
  CancelPoll poll;
  for (std::size_t place = sorted.n_sure; place < sorted.edges.size(); ++place) {
    poll();
    const EdgeIndex e = sorted.edges[place];
    if (!counts(e)) continue;
    SignedSets::Member a = sets.find(graph.from(e)), b = sets.find(graph.to(e));
    if (a.set == b.set) continue;
    if (a.set > b.set) std::swap(a, b);
    const double agreed = graph.agreement_of(e);
    votes.push_back({a.set, b.set, a.opposite == b.opposite ? agreed : -agreed});
  }
  std::stable_sort(votes.begin(), votes.end(), [&](const Votes& x, const Votes& y) {
    poll();
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::size_t n = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (n > 0 && votes[n - 1].a == votes[i].a && votes[n - 1].b == votes[i].b) {
      votes[n - 1].sum += votes[i].sum;
    } else {
      votes[n++] = votes[i];
    }
  }
  votes.resize(n);
  return votes;
}

// Returns the votes, with the largest absolute sum first.
std::vector<Votes> count_votes(const Graph& graph, const SortedEdges& sorted, SignedSets& sets) {
  std::vector<Votes> votes = sum_votes(
      graph, sorted, [](EdgeIndex) { return true; }, sets);
  std::stable_sort(votes.begin(), votes.end(), [](const Votes& x, const Votes& y) {
    return std::abs(x.sum) > std::abs(y.sum);
  });
  return votes;
}

void unite_sure(const Graph& graph, const SortedEdges& sorted, SignedSets& sets) {
  CancelPoll poll;
  for (std::size_t place = 0; place < sorted.n_sure; ++place) {
    poll();
    const EdgeIndex e = sorted.edges[place];
    sets.unite(graph.from(e), graph.to(e), sorted.opposite[place]);
  }
}

void unite_small(const Graph& graph, const SortedEdges& sorted, std::size_t least, SignedSets& sets,
                 std::size_t n) {
  std::vector<std::uint32_t> size(n, 0);
  for (std::uint32_t i = 0; i < n; ++i) ++size[sets.find(i).set];
  for (const Votes& votes : count_votes(graph, sorted, sets)) {
    const std::uint32_t a = sets.find(votes.a).set, b = sets.find(votes.b).set;
    if (a == b || (size[a] >= least && size[b] >= least)) continue;
    sets.unite(votes.a, votes.b, votes.sum < 0);
    size[std::min(a, b)] = size[a] + size[b];
  }
}

// Numbers the sets in the order of their first points.
std::size_t number_sets(SignedSets& sets, std::vector<std::uint32_t>& number) {
  std::size_t count = 0;
  CancelPoll poll;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    poll();
    const std::uint32_t first = sets.find(i).set;
    number[i] = first == i ? static_cast<std::uint32_t>(count++) : number[first];
  }
  return count;
}

}  // namespace

double agreement(const Vec3& p, const Vec3& np, const Vec3& q, const Vec3& nq, double slack) {
  const Vec3 edge = q - p;
  const auto height = [&](const Vec3& n) {
    const double h = dot(edge, n);
    return std::copysign(std::max(std::abs(h) - slack, 0.0), h);
  };
  const double length2 = dot(edge, edge);
  if (!(length2 > 0)) return dot(np, nq);
  return std::clamp(dot(np, nq) - 2 * height(np) * height(nq) / length2, -1.0, 1.0);
}

OrientedParts orient_along_graph(std::span<const Vec3> points, const LocalFits& fits,
                                 std::vector<Vec3>& normals) {
  const Graph graph(points, fits, normals);
  const SortedEdges sorted = sort_edges(graph);
  SignedSets sets(points.size());
  unite_sure(graph, sorted, sets);
  OrientedParts parts;
  parts.piece.resize(points.size());
  parts.component.resize(points.size());
  parts.n_pieces = number_sets(sets, parts.piece);
  for (const Votes& votes : count_votes(graph, sorted, sets)) {
    sets.unite(votes.a, votes.b, votes.sum < 0);
  }
  parts.n_components = number_sets(sets, parts.component);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (sets.find(i).opposite) normals[i] = -normals[i];
  }
  return parts;
}

OrientedPieces orient_pieces(std::span<const Vec3> points, const LocalFits& fits, std::size_t least,
                             std::span<const std::uint8_t> foreign, std::vector<Vec3>& normals) {
  const Graph graph(points, fits, normals);
  const SortedEdges sorted = sort_edges(graph);
  SignedSets sets(points.size());
  unite_sure(graph, sorted, sets);
  unite_small(graph, sorted, least, sets, points.size());
  OrientedPieces pieces;
  pieces.piece.resize(points.size());
  pieces.n_pieces = number_sets(sets, pieces.piece);
  const auto counts = [&](EdgeIndex e) { return foreign[graph.from(e)] == 0; };
  for (const Votes& votes : sum_votes(graph, sorted, counts, sets)) {
    pieces.votes.push_back({pieces.piece[votes.a], pieces.piece[votes.b], votes.sum});
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (sets.find(i).opposite) normals[i] = -normals[i];
  }
  return pieces;
}

PieceAgreement agreement_of_pieces(std::span<const Vec3> points, const LocalFits& fits,
                                   const OrientedPieces& pieces,
                                   std::span<const std::uint8_t> foreign,
                                   std::span<const Vec3> normals) {
  const Graph graph(points, fits, normals);
  PieceAgreement sums;
  sums.within.assign(points.size(), 0.0f);
  sums.edges.assign(points.size(), 0);
  CancelPoll poll;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    poll();
    if (foreign[i] != 0) continue;
    double sum = 0;
    for (EdgeIndex e = i * kGraphNeighbors; e < (i + 1) * kGraphNeighbors; ++e) {
      if (!graph.exists(e)) continue;
      ++sums.edges[i];
      const double agreed = graph.agreement_of(e);
      const std::uint32_t other = pieces.piece[graph.to(e)];
      if (other == pieces.piece[i]) {
        sum += agreed;
      } else {
        sums.across.push_back({i, other, static_cast<float>(agreed)});
      }
    }
    sums.within[i] = static_cast<float>(sum);
  }
  return sums;
}

std::vector<float> mean_agreement(std::span<const Vec3> points, const LocalFits& fits,
                                  std::span<const Vec3> normals) {
  const Graph graph(points, fits, normals);
  std::vector<float> mean(points.size(), 0.0f);
  CancelPoll poll;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    poll();
    double sum = 0;
    int n = 0;
    for (EdgeIndex e = i * kGraphNeighbors; e < (i + 1) * kGraphNeighbors; ++e) {
      if (!graph.exists(e)) continue;
      sum += graph.agreement_of(e);
      ++n;
    }
    if (n > 0) mean[i] = static_cast<float>(std::max(0.0, sum / n));
  }
  return mean;
}

}  // namespace rholm
