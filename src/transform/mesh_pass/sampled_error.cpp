// A second reading of a large mesh would take as long as the first, so a sample shows the error of
// the pass. Elements are edges and faces. The error of an element is the adjoint of its sources by
// the rule of the plan minus their adjoint by a much finer rule. Runs of faces are taken, run b of
// error e_b with the chance c_b: half of them evenly, half by the model's error of each. An edge or
// a vertex belongs to the run of the first face that has it. So the runs of all faces add up to the
// whole error e. Every other run of the sample is summed into p, the others into q, as e_b /
// sqrt(c_b). Then |p|^2 + |q|^2 has the mean sum |e_b|^2, which is |e|^2 if errors of runs are
// independent. Errors that add up over the mesh, as for needles about an axis, are in p and q
// alike. The product p . q has the mean 1/4 of the sum of e_b . e_b' sqrt(c_b c_b') over all pairs.
// This root is replaced by its mean over errors, 1 / SampledRuns::common. Random errors give p . q
// the variance sum p_i^2 q_i^2, small beside |p|^2 |q|^2 where the error has many coefficients. So
// an error that adds up is seen although the sample is a hundredth of the mesh.
//
// A source is a node, or a vertex with all its lumps. Its window error is its adjoint on the plan's
// grid minus its adjoint on a much finer grid. The squares of all sources give the error of random
// sources, better than a sample does. Errors add up where sources crowd in a few directions or are
// aligned with the grid. This shows in the products g_i . g_j of the sums of G groups of runs.
// Their sum over i < j has the mean (1 - 1/G)/2 of the sum over all pairs of runs. These errors
// have few coefficients, or are alike except for their signs. So the variance is the sum of the
// squares of all g_i . g_j, if that is more.
#include "transform/mesh_pass/sampled_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "base/cancel.h"
#include "harmonic/coefficients/laplacian.h"
#include "harmonic/nonuniform/nonuniform.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/harmonic.h"
#include "transform/mesh_pass/own_nodes.h"
#include "transform/mesh_pass/sampled_runs.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {
namespace {

// Errors and rounding of the finer rules, relative to what the plan's rules may have (chosen).
constexpr double kFinerRules = 0.1, kFinerRounding = 0.1;
constexpr double kElements = 2.5;  // edges and faces per triangle
constexpr double kLeastPrecision = 1e-14;
// Nanoseconds for a face of the pass, for one of its nodes, and for each coefficient of a transform
// of few sources (all chosen).
constexpr double kTriangleCost = 50, kNodeCost = 100, kCoefficientCost = 52;
// Number of groups that windows are measured by, and the largest part of the pass that their
// transforms may take (chosen). Two groups did not see the window errors of a rod of 120 200 faces
// at degree 128, four groups did.
struct GroupChoice {
  std::size_t groups;
  double most;
};
constexpr GroupChoice kGroups[] = {{8, 0.05}, {4, 0.1}};
// Window errors count as adding up from this many standard deviations on (chosen).
constexpr double kSignificant = 2;

// Source of a vertex or a node: a weight and factors of the gradient and the Hessian.
struct Source {
  double weight = 0;
  Vec3 gradient;
  std::array<double, 6> hessian = {};

  void add(const Source& other) {
    weight += other.weight;
    gradient += other.gradient;
    for (std::size_t k = 0; k < hessian.size(); ++k) hessian[k] += other.hessian[k];
  }
};

// Point sources at points of any length; each added source counts `scale` times.
class Sources : public NodeSink {
 public:
  void add(std::span<const Node> nodes) override {
    for (const Node& node : nodes) {
      at_.push_back(node.x / norm(node.x));
      weights_.push_back(scale * node.weight);
    }
  }
  void add_gradient(const GradientNode& node) override {
    add(node.x, {.weight = 0, .gradient = node.weight});
  }
  void add_undivided(const Vec3& x, double weight) override {
    undivided_at_.push_back(x / norm(x));
    undivided_.push_back(scale * weight);
  }
  void add(const Vec3& x, const Source& source) {
    const double over_r = 1 / norm(x);
    curved_at_.push_back(over_r * x);
    curved_weights_.push_back(scale * source.weight);
    gradients_.push_back(scale * over_r * source.gradient);
    hessians_.push_back(source.hessian);
    for (double& h : hessians_.back()) h *= scale * over_r * over_r;
  }

  // Returns the sum, with window errors of at most about `left`.
  Coefficients sum(int degree, double left, const Context& context) const {
    const double precision =
        std::clamp(left / std::max(generic(degree), 1e-300), kLeastPrecision, 1e-3);
    const NonuniformPlan plan = plan_nonuniform({.degree = degree,
                                                 .allowed = precision,
                                                 .sources = at_.size() + curved_at_.size(),
                                                 .derivatives = 2,
                                                 .forbid_single = true});
    Coefficients sum = sum_by(plan, context);
    if (!undivided_.empty()) {
      add_adjoint({.directions = undivided_at_, .weights = undivided_}, sum,
                  {.precision = precision}, context);
    }
    return sum;
  }
  // Returns the sum by that plan, without the sources that are not divided.
  Coefficients sum_by(const NonuniformPlan& plan, const Context& context) const {
    Coefficients sum(plan.fourier.degree);
    nonuniform_add_adjoint(plan, {.directions = at_, .weights = weights_},
                           {.directions = curved_at_,
                            .weights = curved_weights_,
                            .gradients = gradients_,
                            .hessians = hessians_},
                           sum, context);
    divide_by_eigenvalue(sum);
    return sum;
  }

  double scale = 1;

 private:
  // Returns the l2 norm over l > 0 that sums of these sources with random signs have, divided by
  // l(l+1).
  double generic(int degree) const {
    const double slope2 = std::pow(gradient_as_weight(degree), 2), bend2 = std::pow(degree, 4);
    double sum = 0;
    for (const double weight : weights_) sum += weight * weight;
    for (std::size_t i = 0; i < hessians_.size(); ++i) {
      sum += std::pow(curved_weights_[i], 2) + slope2 * dot(gradients_[i], gradients_[i]);
      for (const double h : hessians_[i]) sum += bend2 * h * h;
    }
    for (const double weight : undivided_) sum += std::pow(degree + 1.0, 4) * weight * weight;
    return std::sqrt(sum / (4 * std::numbers::pi));
  }

  std::vector<Vec3> at_, curved_at_, gradients_, undivided_at_;
  std::vector<double> weights_, curved_weights_, undivided_;
  std::vector<std::array<double, 6>> hessians_;
};

// Passes all sources on except those not divided.
class Divided : public NodeSink {
 public:
  explicit Divided(NodeSink& to) : to_(to) {}
  void add(std::span<const Node> nodes) override { to_.add(nodes); }
  void add_gradient(const GradientNode& node) override { to_.add_gradient(node); }
  void add_undivided(const Vec3&, double) override {}

 private:
  NodeSink& to_;
};

// Adds factor (a b^T + b a^T) / 2 to sum.
void add_product(const Vec3& a, const Vec3& b, double factor, std::array<double, 6>& sum) {
  sum[0] += factor * a.x * b.x;
  sum[1] += factor * (a.x * b.y + a.y * b.x) / 2;
  sum[2] += factor * (a.x * b.z + a.z * b.x) / 2;
  sum[3] += factor * a.y * b.y;
  sum[4] += factor * (a.y * b.z + a.z * b.y) / 2;
  sum[5] += factor * a.z * b.z;
}

// Hermite's rules, element by element; lump_gradients() and lump_hessians() do the same with whole
// faces. Rules without Hessians are VG, with constants as in hermite_rules.h.
constexpr HermiteEdge kGradientEdge = {1.0 / 2, 1.0 / 12, 0, 0, 0, 0, 4};
constexpr HermiteFace kGradientFace = {1.0 / 3, 1.0 / 24, 0, 0, 0, {}, 0, 4};

// Calls corner(0, source at a), corner(1, source at b) and node(x, weight).
template <typename Corner, typename VisitNode>
void visit_edge(const HermiteEdge& rule, const Vec3& a, const Vec3& b, double weight,
                const Corner& corner, const VisitNode& node) {
  const Vec3 e = b - a;
  Source source{.weight = rule.value * weight, .gradient = rule.gradient * weight * e};
  add_product(e, e, rule.hessian * weight, source.hessian);
  corner(0, source);
  source.gradient = -source.gradient;
  corner(1, source);
  for (int k = 1; k <= rule.nodes; ++k) {
    node(a + static_cast<double>(k) / (rule.nodes + 1) * e, rule.node * weight);
  }
}

template <typename Corner, typename VisitNode>
void visit_face(const HermiteFace& rule, const std::array<Vec3, 3>& p, double weight,
                const Corner& corner, const VisitNode& node) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    Source source{.weight = rule.value * weight, .gradient = rule.gradient * weight * (a + b)};
    add_product(a, a, rule.square * weight, source.hessian);
    add_product(b, b, rule.square * weight, source.hessian);
    add_product(a, b, 2 * rule.product * weight, source.hessian);
    corner(i, source);
  }
  const auto add_node = [&](double u, double v, double part) {
    node(u * p[0] + v * p[1] + (1 - u - v) * p[2], part * weight);
  };
  if (rule.center != 0) add_node(1.0 / 3, 1.0 / 3, rule.center);
  for (const auto& [part, u, v] : rule.orbits) {
    if (part == 0) continue;
    const double w = 1 - u - v;
    add_node(u, v, part), add_node(v, w, part), add_node(w, u, part);
    if (u != v) add_node(v, u, part), add_node(w, v, part), add_node(u, w, part);
  }
}

// Returns z^2 of an edge, as the kernel computes it.
double extent2(const Vec3& a, const Vec3& b, double degree, double bend) {
  const Vec3 across = cross(a, b), e = b - a;
  const double over = 1 / std::min(dot(a, a), dot(b, b));
  return degree * degree * over * over * dot(across, across) + bend * over * dot(e, e);
}

// Visits the sources of a lumped face, element by element: corner(element, i, source at corner i)
// and node(element, x, weight). Elements 0 ... 2 are the edges from these corners, 3 is the face
// itself.
template <typename Corner, typename VisitNode>
void visit_lumped(const SampledTriangle& t, const BlockParameters& b, const Corner& corner,
                  const VisitNode& node) {
  const double bend = b.hessians ? kHermiteBend : 16;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double z2 = extent2(t.p[i], t.p[j], b.degree, bend);
    most = std::max(most, z2);
    const HermiteEdge& rule =
        b.hessians ? kHermiteEdges[hermite_rule(b.edge_reach2, z2)] : kGradientEdge;
    visit_edge(
        rule, t.p[i], t.p[j], t.weight[i],
        [&](std::size_t end, const Source& source) { corner(i, end == 0 ? i : j, source); },
        [&](const Vec3& x, double weight) { node(i, x, weight); });
  }
  visit_face(
      b.hessians ? kHermiteFaces[hermite_rule(b.face_reach2, most)] : kGradientFace, t.p,
      t.face_weight, [&](std::size_t i, const Source& source) { corner(3, i, source); },
      [&](const Vec3& x, double weight) { node(3, x, weight); });
}

class Sampler {
 public:
  Sampler(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan)
      : vertices_{.mesh = mesh,
                  .center = plan.block.scale * plan.block.center,
                  .scale = plan.block.scale},
        plan_(plan) {
    const double elements = kElements * static_cast<double>(mesh.n_faces);
    left_ = std::max(kFinerRules * plan.allowed.rules,
                     kFinerRounding * plan.allowed.rounding * plan.block.scale);
    finer_.divided = {
        .degree = options.degree, .allowed = left_ / std::sqrt(elements), .divided = true};
    finer_.rounding = plan_.face_rounding;
  }

  // Returns the number of groups of runs that windows are measured by; 0: windows are not measured.
  std::size_t group_count(int degree) const {
    const double transforms = 2 * kCoefficientCost * std::pow(degree + 1.0, 2);
    const double pass =
        (kTriangleCost + kNodeCost * plan_.nodes) * static_cast<double>(vertices_.mesh.n_faces);
    for (const auto& [groups, most] : kGroups) {
      if (static_cast<double>(groups) * transforms < most * pass) return groups;
    }
    return 0;
  }

  SampledError run(const SampledRuns& sample, std::size_t n_groups, const NonuniformPlan& transform,
                   const Context& context) const {
    const int degree = transform.fourier.degree;
    Sources halves[2];
    std::vector<Sources> groups(n_groups);
    // Rules, which have many more sources, are measured by every other run.
    const std::size_t step = sample.share == 1 || groups.empty() ? 1 : 2;
    const double part = 1 / static_cast<double>(step);
    for (std::size_t k = 0; k < sample.runs.size(); ++k) {
      ask_cancel();
      const SampledRun& run = sample.runs[k];
      if (k % step == 0) add_rules(run, run.chance * part, halves[k / step % 2]);
      if (!groups.empty()) add_own(run, groups[k % groups.size()]);
    }
    SampledError found{.share = part * sample.share};
    const double left = left_ * std::sqrt(found.share);
    set_rules({halves[0].sum(degree, left, context), halves[1].sum(degree, left, context)},
              sample.common / part, sample.runs.size() / step, found);
    std::vector<Coefficients> windows;
    for (const Sources& group : groups) {
      Coefficients& error = windows.emplace_back(group.sum_by(transform, context));
      const Coefficients fine = group.sum(degree, left, context);
      for (std::size_t i = 0; i < error.values().size(); ++i) error.values()[i] -= fine.values()[i];
    }
    if (!windows.empty()) found.windows = windows_of(windows, sample);
    return found;
  }

 private:
  // Adds sources whose sum is the error of the rules.
  void add_rules(const SampledRun& run, double chance, Sources& to) const {
    to.scale = 1 / std::sqrt(chance);
    std::map<std::uint32_t, Lump> lumps;
    NodeWriter nodes({plan_.divided, plan_.face_rounding}, vertices_, to);
    for (const SampledTriangle& t : run.faces) {
      const auto belongs = [&](std::size_t element) {
        return element == 3 ? t.face : t.edges[element];
      };
      add_sources(
          t, nodes, to, belongs, [&](std::size_t element, std::size_t) { return belongs(element); },
          lumps);
    }
    nodes.flush();
    for (const auto& [vertex, lump] : lumps) to.add(lump.at, lump.source);
    to.scale = -to.scale;
    NodeWriter finer(finer_, vertices_, to);
    for (const SampledTriangle& t : run.faces) {
      finer.add_triangle(t.p, t.vertices, t.edges, t.face);
    }
    finer.flush();
  }

  // Adds the sources that the pass has: nodes and whole vertices. Sources that are not divided have
  // windows of their own, which keep a bound.
  void add_own(const SampledRun& run, Sources& to) const {
    to.scale = 1 / std::sqrt(run.chance);
    std::map<std::uint32_t, Lump> lumps;
    Divided divided(to);
    NodeWriter nodes({plan_.divided, plan_.face_rounding}, vertices_, divided);
    for (const SampledTriangle& t : run.faces) {
      add_sources(
          t, nodes, to,
          [&](std::size_t element) { return element == 3 ? t.face : t.edges[element]; },
          [&](std::size_t, std::size_t corner) { return t.corners[corner]; }, lumps);
    }
    nodes.flush();
    for (const auto& [vertex, lump] : lumps) to.add(lump.at, lump.source);
  }

  // The lumps at a vertex.
  struct Lump {
    Vec3 at;
    Source source;
  };
  // Adds a face's sources: nodes of the requested elements, by `nodes` if it is not lumped, and
  // lumps at corners where `lumped` is true.
  template <typename Belongs, typename Lumped>
  void add_sources(const SampledTriangle& t, NodeWriter& nodes, Sources& to, const Belongs& belongs,
                   const Lumped& lumped, std::map<std::uint32_t, Lump>& lumps) const {
    if (!t.lumped) return nodes.add_triangle(t.p, t.vertices, t.edges, t.face);
    visit_lumped(
        t, plan_.block,
        [&](std::size_t element, std::size_t corner, const Source& source) {
          if (!lumped(element, corner)) return;
          Lump& lump = lumps[t.vertices[corner]];
          lump.at = t.p[corner];
          lump.source.add(source);
        },
        [&](std::size_t element, const Vec3& x, double weight) {
          const Node node = {x, weight};
          if (belongs(element)) to.add({&node, 1});
        });
  }

  static void set_rules(const std::array<Coefficients, 2>& halves, double counted, std::size_t n,
                        SampledError& found) {
    const auto from = [&](int first) {
      const double own = product(halves[0], halves[0], first).sum;
      const double other = product(halves[1], halves[1], first).sum;
      const Product common = product(halves[0], halves[1], first);
      const double whole = 4 * counted - 2, both = own + other;
      const auto runs = static_cast<double>(n);
      const double apart = both > 0 ? std::hypot(std::sqrt(2 / runs), (own - other) / both) : 0;
      const double error2 = both + std::max(0.0, whole * common.sum);
      return std::array{std::sqrt(error2), std::sqrt(error2 + 2 * apart * both +
                                                     2 * whole * std::sqrt(common.squares))};
    };
    const auto [error, most] = from(1);
    found.rules = error;
    found.uncertainty = most - error;
    found.band = from(3 * halves[0].degree() / 4 + 1)[0];
  }

  // Returns the errors that add up; if all runs are taken, the whole error.
  static double windows_of(const std::vector<Coefficients>& groups, const SampledRuns& sample) {
    double own = 0, pairs = 0, squares = 0, by_coefficients = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      own += product(groups[i], groups[i], 1).sum;
      for (std::size_t j = i + 1; j < groups.size(); ++j) {
        const Product one = product(groups[i], groups[j], 1);
        pairs += one.sum;
        squares += one.sum * one.sum;
        by_coefficients += one.squares;
      }
    }
    if (sample.share == 1) return std::sqrt(std::max(0.0, own + 2 * pairs));
    if (!(pairs > kSignificant * std::sqrt(std::max(squares, by_coefficients)))) return 0;
    const auto n = static_cast<double>(groups.size());
    return std::sqrt(sample.common * 2 * n / (n - 1) * pairs);
  }

  // Over the degrees from `first` on: the sum of products of coefficients, and of their squares.
  struct Product {
    double sum = 0, squares = 0;
  };
  static Product product(const Coefficients& a, const Coefficients& b, int first) {
    Product all;
    for (int l = first; l <= a.degree(); ++l) {
      for (int m = 0; m <= l; ++m) {
        const double c = a.c(l, m) * b.c(l, m), s = a.s(l, m) * b.s(l, m);
        all.sum += c + s;
        all.squares += c * c + s * s;
      }
    }
    return all;
  }

  ScaledVertices vertices_;
  const MeshPlan& plan_;
  NodeOptions finer_;
  double left_ = 0;  // error of the finer rules
};

}  // namespace

SampledError sample_error(const MeshView& mesh, const MeshPassOptions& options,
                          const MeshPlan& plan, const NonuniformPlan& transform,
                          std::span<const float> block_errors, const Context& context,
                          double share) {
  const Context silent{.threads = context.threads};
  const Sampler sampler(mesh, options, plan);
  const std::size_t groups = share == 1 ? 2 : sampler.group_count(options.degree);
  // Windows need twice as many runs.
  const RunCount one, number = groups == 0 ? one : RunCount{2 * one.fewest, 2 * one.most};
  const SampledRuns sample =
      sample_runs(mesh, options, plan.block, block_errors, share, number, silent);
  return sampler.run(sample, groups, transform, silent);
}

}  // namespace rholm
