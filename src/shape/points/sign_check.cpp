#include "shape/points/sign_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/signed_sets.h"
#include "shape/points/orient_sides.h"
#include "shape/points/side_balance.h"
#include "shape/points/sign_graph.h"
#include "shape/queries/winding_tree.h"

namespace rholm {
namespace {

// Limits for two walls: standard errors of the mean height, and its least share of the
// mean edge length (chosen).
constexpr double kWalls = 4, kLeastWall = 0.03;
// Least number of edges that flip a piece or prove two walls. One or two may occur by chance at
// corners, and the standard error of one height is 0. It also applies to contradicting points.
constexpr std::uint32_t kFewestVotes = 3;
// Least share of the edges between two pieces that flips one. At tips thinner than the
// spacing, few edges contradict.
constexpr double kLeastShare = 0.34;
// Twice the number of edges of a point: the divisor that converts undecided edges to points.
constexpr double kEdgesOfPoint = 10;

// Limit of the mean of the winding numbers behind and before a point, relative to 1/2, the value of
// a right sign. Beyond the limit it is nearer to a wrong value, -1/2 or 3/2.
constexpr double kInward = 0.75;
constexpr std::size_t kLeastPart = 30;  // least number of samples of a component that may flip
constexpr double kClosed = 0.2;         // largest length of the mean normal: side_balance.cpp
constexpr double kOpen = 0.25;          // mean error of the winding numbers of a body's surface
constexpr double kMost = 0.6;           // share of the area of a component that is flipped
constexpr int kRounds = 16;             // largest number of components that are flipped

// Limits for creases between pieces, where noise hides the bend of the surface: mean agreement of
// the edges, and its distance from zero in standard errors.
constexpr double kBend = 0.1, kSureBend = 4;
// Share of flipped points above which undecided creases are reported.
constexpr double kManyTurned = 0.02;

bool is_decided(const Moments& votes, double edges) {
  return votes.n >= kFewestVotes && votes.n >= kLeastShare * edges;
}

bool are_walls(const Moments& heights) {
  return heights.n >= kFewestVotes && std::abs(heights.mean()) > kLeastWall &&
         heights.significance() > kWalls;
}

std::vector<std::uint32_t> wholes_of(const AllPieces& all) {
  DisjointSets sets(all.own.size());
  for (const auto& [a, b] : all.same) sets.unite(a, b);
  std::vector<std::uint32_t> whole(all.own.size());
  for (std::uint32_t i = 0; i < whole.size(); ++i) whole[i] = sets.find(i);
  return whole;
}

// Returns the pairs of pieces as pairs of wholes.
std::vector<PiecePair> pairs_of_wholes(const AllPieces& all,
                                       const std::vector<std::uint32_t>& whole) {
  std::vector<PiecePair> pairs = all.pairs;
  for (PiecePair& pair : pairs) {
    std::tie(pair.a, pair.b) = std::minmax({whole[pair.a], whole[pair.b]});
    if (pair.a == pair.b) pair.edges = pair.heights.n, pair.bends = {};
  }
  merge(pairs);
  return pairs;
}

// Winding numbers behind and before each sample, of all samples.
struct BothSides {
  double behind = 0, before = 0;
  double mean() const { return (behind + before) / 2; }
};
std::vector<BothSides> ask_both_sides(std::span<const SignSample> samples, double scatter,
                                      const Context& context) {
  const std::size_t n = samples.size();
  std::vector<Vec3> points(n), area_normals(n), places(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const SignSample& sample = samples[i];
    points[i] = sample.at;
    area_normals[i] = sample.area * sample.normal;
    const double radius = std::sqrt(sample.area / std::numbers::pi);
    const Vec3 step = (kClearOfPatches * radius + kNoiseOfScatter * scatter) * sample.normal;
    places[2 * i] = sample.at - step;
    places[2 * i + 1] = sample.at + step;
  }
  const WindingTree tree(points, area_normals);
  const std::vector<double> w = tree.winding(places, context);
  std::vector<BothSides> sides(n);
  for (std::size_t i = 0; i < n; ++i) sides[i] = {w[2 * i], w[2 * i + 1]};
  return sides;
}

// Returns true if points bound a body by themselves. Then the winding number of these points alone
// is 0 on one side, and 1 or -1 on the other.
bool bound_a_body(std::span<const SignSample> samples, double scatter, const Context& context) {
  double off = 0;
  for (const BothSides& s : ask_both_sides(samples, scatter, context)) {
    const double less = std::min(std::abs(s.behind), std::abs(s.before));
    const double more = std::max(std::abs(s.behind), std::abs(s.before));
    off += std::min(1.0, less + std::abs(more - 1));
  }
  return off < kOpen * static_cast<double>(samples.size());
}

// Returns for each whole that contradicts others: 1 if it bounds a body. Bodies that touch
// contradict each other there, which is no reason to flip one.
std::vector<std::uint8_t> find_closed(const std::vector<PiecePair>& pairs,
                                      const std::vector<std::uint32_t>& whole,
                                      std::span<const SignSample> samples, double scatter,
                                      const Context& context) {
  std::vector<std::uint8_t> closed(whole.size(), 0);
  std::vector<std::uint32_t> asked;
  for (const PiecePair& pair : pairs) {
    if (pair.a != pair.b && pair.heights.n > 0) asked.insert(asked.end(), {pair.a, pair.b});
  }
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  std::vector<std::vector<SignSample>> own(asked.size());
  for (const SignSample& sample : samples) {
    const std::uint32_t piece = whole[sample.piece];
    const auto found = std::lower_bound(asked.begin(), asked.end(), piece);
    if (found != asked.end() && *found == piece) own[found - asked.begin()].push_back(sample);
  }
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (own[k].size() < kLeastPart) continue;
    closed[asked[k]] = bound_a_body(own[k], scatter, context) ? 1 : 0;
  }
  return closed;
}

// Flips pieces to agree, in descending order of their contradicting edges.
SignedSets join_pieces(std::vector<PiecePair> pairs, const std::vector<std::uint32_t>& whole,
                       const std::vector<std::uint8_t>& closed) {
  SignedSets sets(whole.size());
  for (std::uint32_t i = 0; i < whole.size(); ++i) sets.unite(whole[i], i, false);
  std::stable_sort(pairs.begin(), pairs.end(), [](const PiecePair& x, const PiecePair& y) {
    return x.heights.n > y.heights.n;
  });
  for (const PiecePair& pair : pairs) {
    if (pair.a == pair.b || !is_decided(pair.heights, pair.edges)) continue;
    const bool touch = closed[pair.a] != 0 && closed[pair.b] != 0;
    if (!touch && !are_walls(pair.heights)) sets.unite(pair.a, pair.b, true);
  }
  return sets;
}

// Joins pieces across creases. Returns the number of edges at creases that stay undecided.
double join_at_creases(const std::vector<PiecePair>& pairs, SignedSets& sets) {
  std::vector<PiecePair> votes;
  for (PiecePair pair : pairs) {
    const SignedSets::Member a = sets.find(pair.a), b = sets.find(pair.b);
    if (a.set == b.set) continue;
    if (a.opposite != b.opposite) pair.bends.sum = -pair.bends.sum;
    std::tie(pair.a, pair.b) = std::minmax({a.set, b.set});
    votes.push_back(pair);
  }
  merge(votes);
  std::erase_if(votes, [](const PiecePair& pair) { return !is_decided(pair.bends, pair.edges); });
  std::stable_sort(votes.begin(), votes.end(), [](const PiecePair& x, const PiecePair& y) {
    return std::abs(x.bends.sum) > std::abs(y.bends.sum);
  });
  for (const PiecePair& pair : votes) {
    const bool sure = std::abs(pair.bends.mean()) > kBend && pair.bends.significance() > kSureBend;
    if (sure) sets.unite(pair.a, pair.b, pair.bends.sum < 0);
  }
  double undecided = 0;
  for (const PiecePair& pair : votes) {
    if (sets.find(pair.a).set != sets.find(pair.b).set) undecided += pair.bends.n;
  }
  return undecided;
}

// Flips the smaller number of points in every set.
void turn_fewer(const AllPieces& all, SignedSets& sets, SignCheck& check) {
  const std::size_t n = all.own.size();
  std::vector<std::array<std::uint64_t, 2>> sizes(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const SignedSets::Member own = sets.find(i);
    sizes[own.set][own.opposite ? 1 : 0] += all.own[i];
  }
  check.turned.resize(n), check.component.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const SignedSets::Member own = sets.find(i);
    const bool opposite_ones = sizes[own.set][1] <= sizes[own.set][0];
    check.turned[i] = own.opposite == opposite_ones ? 1 : 0;
    check.component[i] = own.set;
    if (check.turned[i] != 0) check.n_turned += all.own[i];
  }
}

std::uint64_t count_turned(const AllPieces& all, const std::vector<std::uint8_t>& turned) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < turned.size(); ++i) n += turned[i] != 0 ? all.own[i] : 0;
  return n;
}

SideBalance balance_of_samples(std::span<const SignSample> samples) {
  std::vector<double> discs;
  std::vector<Vec3> points, normals;
  for (const SignSample& sample : samples) {
    discs.push_back(sample.disc), points.push_back(sample.at), normals.push_back(sample.normal);
  }
  return balance_of(std::move(discs), points, normals);
}

bool faces_inward(double mean_winding) { return std::abs(mean_winding - 0.5) > kInward; }

// Sums over the samples of a component.
struct Part {
  double area = 0, inward = 0;
  Vec3 normal;
  std::size_t n = 0;

  bool is_to_turn() const {
    return n >= kLeastPart && norm(normal) < kClosed * area && inward > kMost * area;
  }
};

}  // namespace

AllPieces all_of(const SignPieces& part) {
  return {.own = part.own, .pairs = part.pairs, .scatter = part.scatter};
}

bool SignCheck::counts(std::uint32_t a, std::uint32_t b, bool after) const {
  if (after && turned[a] != turned[b]) return false;
  const auto [least, most] = std::minmax({whole[a], whole[b]});
  return !std::binary_search(walls.begin(), walls.end(), Walls{least, most});
}

SignCheck check_signs(const AllPieces& all, std::span<const SignSample> samples,
                      const Context& context) {
  SignCheck check;
  check.whole = wholes_of(all);
  const std::vector<PiecePair> pairs = pairs_of_wholes(all, check.whole);
  for (const PiecePair& pair : pairs) {
    if (are_walls(pair.heights)) check.walls.push_back({pair.a, pair.b});
  }
  const std::vector<std::uint8_t> closed =
      find_closed(pairs, check.whole, samples, all.scatter, context);
  SignedSets sets = join_pieces(pairs, check.whole, closed);
  const double undecided = join_at_creases(pairs, sets);
  turn_fewer(all, sets, check);
  // Signs between the sides of an undecided crease are not known: one side may need a flip too.
  const auto n =
      static_cast<double>(std::accumulate(all.own.begin(), all.own.end(), std::uint64_t{0}));
  if (static_cast<double>(check.n_turned) > kManyTurned * n) {
    check.undecided = static_cast<std::uint64_t>(undecided / kEdgesOfPoint);
  }
  return check;
}

std::vector<std::uint32_t> contradicting_points(const SignPieces& part, std::uint32_t first,
                                                const SignCheck& check, bool after) {
  std::vector<std::uint32_t> found;
  const std::vector<SignPieces::Quarrel>& quarrels = part.quarrels;
  for (std::size_t begin = 0, end = 0; begin < quarrels.size(); begin = end) {
    const std::uint32_t i = quarrels[begin].point;
    std::uint32_t against = 0;
    for (; end < quarrels.size() && quarrels[end].point == i; ++end) {
      against += check.counts(first + part.piece[i], first + quarrels[end].other, after) ? 1 : 0;
    }
    if (against >= kFewestVotes) found.push_back(i);
  }
  return found;
}

MendedSigns mend_signs(const AllPieces& all, std::vector<SignSample> samples, bool closed,
                       const Context& context) {
  MendedSigns mended{.check = check_signs(all, samples, context)};
  const SignCheck& check = mended.check;
  mended.turned = check.turned;
  for (SignSample& sample : samples) {
    if (check.turned[sample.piece] != 0) sample.normal = -sample.normal;
  }
  const bool inwards = balance_of_samples(samples).inwards;
  if (inwards) {
    for (std::uint8_t& turned : mended.turned) turned ^= 1;
    for (SignSample& sample : samples) sample.normal = -sample.normal;
  }
  if (closed) {
    std::vector<std::uint32_t> component;
    component.reserve(samples.size());
    for (const SignSample& sample : samples) component.push_back(check.component[sample.piece]);
    const SideCheck sides = check_sides(std::move(samples), component, all.scatter, context);
    mended.inward = sides.inward;
    for (std::size_t i = 0; i < mended.turned.size(); ++i) {
      const bool turned = std::find(sides.turned.begin(), sides.turned.end(), check.component[i]) !=
                          sides.turned.end();
      if (turned) mended.turned[i] ^= 1;
    }
  }
  mended.n_turned = count_turned(all, mended.turned);
  const auto n = std::accumulate(all.own.begin(), all.own.end(), std::uint64_t{0});
  mended.all_inward = inwards && mended.n_turned == n;
  return mended;
}

SideCheck check_sides(std::vector<SignSample> samples, std::span<const std::uint32_t> component,
                      double scatter, const Context& context) {
  SideCheck check;
  std::vector<std::uint32_t> firsts(component.begin(), component.end());
  std::sort(firsts.begin(), firsts.end());
  firsts.erase(std::unique(firsts.begin(), firsts.end()), firsts.end());
  const auto part_of = [&](std::size_t s) {
    return static_cast<std::size_t>(std::lower_bound(firsts.begin(), firsts.end(), component[s]) -
                                    firsts.begin());
  };
  for (int round = 0;; ++round) {
    const std::vector<BothSides> sides = ask_both_sides(samples, scatter, context);
    std::vector<Part> parts(firsts.size());
    std::size_t inward = 0;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      Part& own = parts[part_of(s)];
      ++own.n;
      own.area += samples[s].area;
      own.normal += samples[s].area * samples[s].normal;
      if (!faces_inward(sides[s].mean())) continue;
      own.inward += samples[s].area;
      ++inward;
    }
    const auto n = static_cast<double>(samples.size());
    check.inward = n > 0 ? static_cast<double>(inward) / n : 0;
    if (parts.size() < 2 || round == kRounds) return check;
    // Flips the largest first, because this changes the winding numbers inside it.
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
    for (std::size_t s = 0; s < samples.size(); ++s) {
      if (part_of(s) == largest) samples[s].normal = -samples[s].normal;
    }
  }
}

}  // namespace rholm
