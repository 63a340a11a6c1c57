#include "transform/mesh_pass/plan/lumping.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "harmonic/nonuniform/cost_model.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {
namespace {

// Returns the sum of squares of lumping errors if faces up to a tolerance are lumped. An edge has
// the sum of its half-edges, or the half-edge that is lumped. Stops above `enough`.
double lumped_error2(const MeshSample& sample, double tolerance2, double enough) {
  double faces = 0, edges = 0;
  for (const MeshSample::Entry& entry : sample.entries) {
    if (entry.error2 <= tolerance2) faces += entry.face_error2;
  }
  faces *= sample.share;
  if (!(sample.edge_share > 0)) return (1 + sample.unseen_edges) * faces;
  for (const MeshSample::Edge& edge : sample.edges) {
    if (edge.lower2 > tolerance2) continue;
    const double error = edge.upper2 > tolerance2 ? edge.lower : edge.lower + edge.upper;
    edges += error * error;
    if (sample.edge_share * edges > enough) break;
  }
  return faces + sample.edge_share * edges;
}

// Returns the energy of all errors if everything is lumped, relative to the energy that faces have
// on their own. It is small where the half-edges of each edge nearly cancel.
double cancellation(const MeshSample& sample) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  double own = 0;
  for (const MeshSample::Entry& entry : sample.entries) own += entry.error2;
  const double whole = lumped_error2(sample, kAll, kAll);
  return sample.edge_share > 0 && own > 0 ? std::min(1.0, whole / (sample.share * own)) : 1;
}

// Returns the largest tolerance that a sample allows, because the sample does not contain the worst
// faces. At 95 %, the faces of a kind that it lacks number at most three times what one of its
// faces stands for. They may take a seventh of the allowed error, and cancel as others do, ten
// times at most. If they do not cancel, they take one and a half times the allowed error. With
// windows and quanta this is at most 0.9 of the wanted error. A single face may always take a
// forty-fifth of the error: the pass knows the sum, and there is a second try.
double largest_tolerance(const MeshSample& sample, double allowed2) {
  constexpr double kMostCancelled = 0.1;
  return allowed2 * std::max(0.15 / (3 * sample.share), 1.0 / 2000) /
         std::max(cancellation(sample), kMostCancelled);
}

bool may_all_be_lumped(const MeshSample& sample, double allowed2) {
  const double most = largest_tolerance(sample, allowed2);
  for (const MeshSample::Entry& entry : sample.entries) {
    if (entry.error2 > most) return false;
  }
  const double lumps2 = (1 - node_share2(false)) * allowed2;
  return lumped_error2(sample, most, lumps2) <= lumps2;
}

// Steps of tolerances, eight to a power of two: the exponent of a double and the first three bits
// behind it.
struct Steps {
  static constexpr int kDropped = 52 - 3;
  static constexpr std::size_t kCount = std::size_t{0x7ff} << 3;
  static std::size_t of(double error2) {
    return std::min<std::size_t>(kCount, std::bit_cast<std::uint64_t>(error2) >> kDropped);
  }
  // Returns the largest number below step n; if n is kCount, the largest finite number.
  static double below(std::size_t n) {
    return n == 0 ? 0 : std::bit_cast<double>((std::uint64_t{n} << kDropped) - 1);
  }
};

}  // namespace

double node_share2(bool some_noded) { return some_noded ? 0.5 : 0.1; }

double tolerance_of(const MeshSample& sample, double allowed2) {
  const double most = largest_tolerance(sample, allowed2);
  if (may_all_be_lumped(sample, allowed2)) return most;
  // Terms of the sum of squares in each step of tolerances; the last element has terms that never
  // join.
  std::vector<double> steps(Steps::kCount + 1);
  double least = std::numeric_limits<double>::infinity();
  for (const MeshSample::Entry& entry : sample.entries) {
    steps[Steps::of(entry.error2)] += sample.share * entry.face_error2;
    least = std::min(least, entry.error2);
  }
  if (!(sample.edge_share > 0)) {
    for (double& step : steps) step *= 1 + sample.unseen_edges;
  }
  for (const MeshSample::Edge& edge : sample.edges) {
    const double alone = edge.lower * edge.lower, both = edge.lower + edge.upper;
    steps[Steps::of(edge.lower2)] += sample.edge_share * alone;
    steps[Steps::of(edge.upper2)] += sample.edge_share * (both * both - alone);
  }
  const double lumps2 = (1 - node_share2(true)) * allowed2;
  double sum = 0;
  std::size_t n = 0;
  while (n < Steps::kCount && !((sum += steps[n]) > lumps2)) ++n;
  const double tolerance2 = std::min(most, Steps::below(n));
  return tolerance2 < least ? 0 : tolerance2;
}

namespace {

double power(double z2, int p) {
  double result = p % 2 == 0 ? 1 : std::sqrt(z2);
  for (int k = 0; k < p / 2; ++k) result *= z2;
  return result;
}

// L^2 times the factors of an edge's Hessians, for the half-edges of the faces with the smaller and
// with the larger error.
struct EdgeHessian {
  double lower2, upper2;
  double lower, upper;
};

// Errors, by each rule, of a face's half-edges and of the face itself, whose z^2 is the largest of
// its half-edges.
struct RuleErrors {
  std::array<std::array<double, kHermiteEdgeRules>, 3> edges;
  std::array<double, kHermiteFaceRules> face;
  double z2;
};
std::vector<RuleErrors> rule_errors(const MeshSample& sample) {
  std::vector<RuleErrors> all;
  all.reserve(sample.faces.size());
  for (const MeshSample::Triangle& t : sample.faces) {
    RuleErrors errors = {
        .edges = {}, .face = {}, .z2 = *std::max_element(t.z2.begin(), t.z2.end())};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < kHermiteEdgeRules; ++k) {
        errors.edges[i][k] =
            t.weight[i] * kHermiteEdgeUnits[k] * power(t.z2[i], kHermiteEdges[k].power);
      }
    }
    for (std::size_t k = 0; k < kHermiteFaceRules; ++k) {
      errors.face[k] = t.face * kHermiteFaceUnits[k] * power(errors.z2, kHermiteFaces[k].power);
    }
    all.push_back(errors);
  }
  return all;
}

// The sample as rules with Hessians see it.
struct Seen {
  MeshSample sample;
  std::vector<EdgeHessian> hessians;
};
Seen with_hessians(const MeshSample& sample, const std::vector<RuleErrors>& rules,
                   HermiteLumps& lumps) {
  Seen result;
  MeshSample& seen = result.sample;
  seen.share = sample.share;
  seen.edge_share = sample.edge_share;
  seen.unseen_edges = 0;                      // the entries contain them
  std::vector<std::array<double, 3>> errors;  // errors of half-edges
  std::vector<double> errors2;
  errors.reserve(sample.faces.size());
  errors2.reserve(sample.faces.size());
  seen.entries.reserve(sample.faces.size());
  seen.edges.reserve(sample.edges.size());
  double nodes = 0;
  for (std::size_t n = 0; n < rules.size(); ++n) {
    const MeshSample::Triangle& t = sample.faces[n];
    std::array<double, 3> error;
    double edges2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = hermite_rule(lumps.edge_reach2, t.z2[i]);
      error[i] = rules[n].edges[i][k];
      edges2 += error[i] * error[i];
      nodes += kHermiteEdges[k].nodes / 2.0;
    }
    const std::size_t k = hermite_rule(lumps.face_reach2, rules[n].z2);
    nodes += kHermiteFaces[k].nodes();
    const double face2 = rules[n].face[k] * rules[n].face[k];
    errors.push_back(error);
    errors2.push_back(edges2 + face2);
    if (!std::isfinite(edges2 + face2)) continue;
    // If no neighbours are known, (a + b)^2 <= 2 (a^2 + b^2) bounds an edge.
    const double own2 = sample.edge_share > 0 ? face2 : face2 + 2 * edges2;
    seen.entries.push_back({edges2 + face2, own2, t.face * t.face});
  }
  lumps.between = nodes / static_cast<double>(std::max<std::size_t>(sample.faces.size(), 1));
  for (const auto& [first, second] : sample.twins) {
    const double a = errors[first / 3][first % 3], b = errors[second / 3][second % 3];
    const double a2 = errors2[first / 3], b2 = errors2[second / 3];
    const MeshSample::Triangle &t = sample.faces[first / 3], &u = sample.faces[second / 3];
    const double z2 = t.z2[first % 3];
    const double factor = kHermiteEdges[hermite_rule(lumps.edge_reach2, z2)].hessian * z2;
    const double ta = t.weight[first % 3], tb = u.weight[second % 3];
    if (a2 <= b2) {
      seen.edges.push_back({a2, b2, a, b, ta + tb});
      result.hessians.push_back({a2, b2, factor * ta, factor * tb});
    } else {
      seen.edges.push_back({b2, a2, b, a, ta + tb});
      result.hessians.push_back({b2, a2, factor * tb, factor * ta});
    }
  }
  return result;
}

// Returns the sum of squares over edges of lumped faces, at both ends.
double hessians2(const Seen& seen, double tolerance2) {
  double sum = 0;
  for (const EdgeHessian& edge : seen.hessians) {
    if (edge.lower2 > tolerance2) continue;
    const double h = edge.upper2 > tolerance2 ? edge.lower : edge.lower + edge.upper;
    sum += 2 * h * h;
  }
  return seen.sample.edge_share * sum;
}

// Mean moduli of the weights of edges (of half-edges where no neighbours are known) and faces.
struct MeanWeights {
  double edge = 0, face = 0;
};
MeanWeights mean_weights(const MeshSample& sample) {
  MeanWeights mean;
  double faces = 0, halves = 0;
  for (const MeshSample::Triangle& t : sample.faces) {
    const double sum = std::abs(t.weight[0]) + std::abs(t.weight[1]) + std::abs(t.weight[2]);
    if (!std::isfinite(sum + t.face)) continue;
    mean.face += std::abs(t.face);
    halves += sum / 3;
    ++faces;
  }
  for (const MeshSample::Edge& edge : sample.edges) mean.edge += std::abs(edge.weight);
  mean.edge = sample.edge_share > 0
                  ? mean.edge / static_cast<double>(std::max<std::size_t>(sample.edges.size(), 1))
                  : halves / std::max(faces, 1.0);
  mean.face /= std::max(faces, 1.0);
  return mean;
}

}  // namespace

double noded_share(const MeshSample& sample, double tolerance2) {
  double noded = 0;
  for (const MeshSample::Entry& entry : sample.entries) noded += entry.error2 > tolerance2;
  return noded / static_cast<double>(std::max<std::size_t>(sample.entries.size(), 1));
}

double own_nodes_of(const MeshSample& sample, const NodeAllowance& element) {
  // Every fourth edge and face is enough (chosen): rules take as long to look up as nodes.
  constexpr std::size_t kEvery = 4;
  // An element that is better halved counts for two of the largest rules (chosen).
  constexpr double kHalvedEdge = 16, kHalvedFace = 60;
  double edges = 0, faces = 0, n_edges = 0, n_faces = 0;
  const auto add_edge = [&](double weight, double z2) {
    if (!std::isfinite(weight + z2) || weight == 0) return;
    const EdgeRule rule = edge_rule(element, {.wave2 = z2}, weight);
    edges += rule.nodes.empty() ? kHalvedEdge : static_cast<double>(rule.nodes.size());
    ++n_edges;
  };
  for (std::size_t n = 0; n < sample.twins.size(); n += kEvery) {
    const auto [a, b] = sample.twins[n];
    add_edge(sample.faces[a / 3].weight[a % 3] + sample.faces[b / 3].weight[b % 3],
             sample.faces[a / 3].z2[a % 3]);
  }
  for (std::size_t t = 0; t < sample.faces.size(); t += kEvery) {
    const MeshSample::Triangle& triangle = sample.faces[t];
    const double z2 = *std::max_element(triangle.z2.begin(), triangle.z2.end());
    if (sample.twins.empty()) add_edge(triangle.weight[t % 3], triangle.z2[t % 3]);
    if (!std::isfinite(triangle.face + z2) || triangle.face == 0) continue;
    const FaceRule rule = face_rule(element, {.wave2 = z2}, triangle.face);
    faces += rule.nodes.empty() ? kHalvedFace : static_cast<double>(rule.nodes.size());
    ++n_faces;
  }
  return 1.5 * edges / std::max(n_edges, 1.0) + faces / std::max(n_faces, 1.0);
}

double crowding_of(const MeshSample& sample) {
  double sum = 0, weights = 0;
  for (const MeshSample::Triangle& t : sample.faces) {
    const auto [a, b, c] = t.z2;
    const double longest = std::max({a, b, c});
    const double weight = std::pow(t.face * std::pow(longest, 4), 2);  // for an error as z^8
    if (!std::isfinite(weight) || weight == 0) continue;
    // Heron: area2 is 16 times the square of the area; the height is twice the area over the
    // length.
    const double area2 = std::max(0.0, 2 * (a * b + b * c + c * a) - (a * a + b * b + c * c));
    const double along = neighbours_in_step(longest);
    const double across = neighbours_in_step(area2 / (4 * longest));
    sum += weight * crowd_in_step2(along, across);
    weights += weight;
  }
  return weights > 0 ? std::sqrt(sum / weights) : 1;
}

std::optional<HermiteLumps> hermite_lumps(const MeshSample& sample, double allowed2,
                                          double own_nodes) {
  const MeanWeights mean = mean_weights(sample);
  if (!(mean.edge > 0) || !(mean.face > 0) || !(allowed2 > 0)) return {};
  // Errors of an edge and a face if all were alike; a face has one and a half edges.
  const double triangles = sample.share * static_cast<double>(sample.faces.size());
  const double edge = std::sqrt(allowed2 / (3 * triangles)) / mean.edge;
  const double face = std::sqrt(allowed2 / (2 * triangles)) / mean.face;
  const std::vector<RuleErrors> rules = rule_errors(sample);
  // With a larger allowed error, rules have fewer nodes between vertices, but more faces have to be
  // taken out.
  const auto with_errors = [&](double factor) {
    HermiteLumps lumps{.edge_reach2 = hermite_edge_reach(factor * edge),
                       .face_reach2 = hermite_face_reach(factor * face)};
    const Seen seen = with_hessians(sample, rules, lumps);
    lumps.tolerance2 = tolerance_of(seen.sample, allowed2);
    lumps.hessian2 = hessians2(seen, lumps.tolerance2);
    lumps.node_share = noded_share(seen.sample, lumps.tolerance2);
    lumps.cost = hessians_cost() + common_node_cost() * lumps.between +
                 own_node_cost() * own_nodes * lumps.node_share;
    return lumps;
  };
  HermiteLumps best;
  best.cost = std::numeric_limits<double>::infinity();
  double at = 1;
  // Returns true if the search should go on in this direction.
  const auto take = [&](double factor) {
    const HermiteLumps lumps = with_errors(factor);
    if (lumps.cost < best.cost) best = lumps, at = factor;
    return lumps.cost <= 1.2 * best.cost;
  };
  constexpr double kStart = 8, kMost = 1e4, kLeast = 0.1;
  bool better = take(kStart);
  if (best.node_share == 0) {
    // There are only nodes between vertices. Where errors cancel, many fewer may be enough.
    for (double f = 2 * kStart; better && best.between > 0 && f < kMost; f *= 2) better = take(f);
  } else {
    for (double f = kStart / 2; better && best.node_share > 0 && f > kLeast; f /= 2) {
      better = take(f);
    }
  }
  if (best.between == 0 && best.node_share == 0) return best;
  for (const double step : {1.7, 1.4, 1.2, 0.85}) {
    const HermiteLumps lumps = with_errors(step * at);
    if (lumps.cost < best.cost) best = lumps;
  }
  return best;
}

}  // namespace rholm
