// A second reading of a large mesh would take as long as the first. What its rules leave shows on a
// sample. An element, an edge or a face, has an error: the adjoint of its sources by the rule of
// the plan minus that of its sources by a much finer one. Runs of triangles are taken, run b of
// error e_b with the chance c_b: half of them evenly, half by what the model says of each. An edge
// belongs to the run of the first triangle that has it, so that the runs of all triangles add up to
// the whole error e. Every other run of the sample is summed into p, the others into q, as e_b /
// sqrt(c_b). Then |p|^2 + |q|^2 has the mean sum |e_b|^2: what |e|^2 is where the errors of runs
// know nothing of each other. What adds up over the mesh, as that of needles about an axis, is in p
// and q alike, and p . q has the mean 1/4 of the sum of e_b . e_b' sqrt(c_b c_b') over all pairs.
// That root is taken for its mean over the errors of the model, 1 / common_. Of what is random p .
// q has the variance sum p_i^2 q_i^2, small beside |p|^2 |q|^2 where the error has many
// coefficients: so something that adds up is seen although the sample is a hundredth.
#include "transform/mesh_pass/sampled_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/random.h"
#include "harmonic/coefficients/laplacian.h"
#include "harmonic/nonuniform/nonuniform.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/harmonic.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/own_nodes.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {
namespace {

constexpr double kFewestRuns = 24, kMostRuns = 128;
constexpr std::size_t kScanGrain = std::size_t{1} << 15;  // triangles, some 50 us (chosen)
// Of what the plan's rules may leave, and of rounding, the finer ones leave that much (chosen).
constexpr double kFinerRules = 0.02, kFinerRounding = 0.1;
constexpr double kElements = 2.5;  // edges and faces per triangle
constexpr double kLeastPrecision = 1e-14;

// Point sources, at points of any length; what is added counts `scale` times.
class Sources : public NodeSink {
 public:
  void add(std::span<const Node> nodes) override {
    for (const Node& node : nodes) {
      at_.push_back(node.x / norm(node.x));
      weights_.push_back(scale * node.weight);
    }
  }
  void add_gradient(const GradientNode& node) override { add(node.x, 0, node.weight, {}); }
  void add_undivided(const Vec3& x, double weight) override {
    undivided_at_.push_back(x / norm(x));
    undivided_.push_back(scale * weight);
  }
  // With factors of the gradient and the Hessian.
  void add(const Vec3& x, double weight, const Vec3& gradient,
           const std::array<double, 6>& hessian) {
    const double over_r = 1 / norm(x);
    curved_at_.push_back(over_r * x);
    curved_weights_.push_back(scale * weight);
    gradients_.push_back(scale * over_r * gradient);
    hessians_.push_back(hessian);
    for (double& h : hessians_.back()) h *= scale * over_r * over_r;
  }

  // Windows leave at most about `left`.
  Coefficients sum(int degree, double left, const Context& context) const {
    const double precision =
        std::clamp(left / std::max(generic(degree), 1e-300), kLeastPrecision, 1e-3);
    Coefficients sum(degree);
    const NonuniformPlan plan = plan_nonuniform({.degree = degree,
                                                 .allowed = precision,
                                                 .sources = at_.size() + curved_at_.size(),
                                                 .derivatives = 2,
                                                 .forbid_single = true});
    nonuniform_add_adjoint(plan, {.directions = at_, .weights = weights_},
                           {.directions = curved_at_,
                            .weights = curved_weights_,
                            .gradients = gradients_,
                            .hessians = hessians_},
                           sum, context);
    divide_by_eigenvalue(sum);
    if (!undivided_.empty()) {
      add_adjoint({.directions = undivided_at_, .weights = undivided_}, sum,
                  {.precision = precision}, context);
    }
    return sum;
  }

  double scale = 1;

 private:
  // The l2 norm over l > 0 that sums of these with random signs have, divided by l(l+1).
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

// sum += factor (a b^T + b a^T) / 2.
void add_product(const Vec3& a, const Vec3& b, double factor, std::array<double, 6>& sum) {
  sum[0] += factor * a.x * b.x;
  sum[1] += factor * (a.x * b.y + a.y * b.x) / 2;
  sum[2] += factor * (a.x * b.z + a.z * b.x) / 2;
  sum[3] += factor * a.y * b.y;
  sum[4] += factor * (a.y * b.z + a.z * b.y) / 2;
  sum[5] += factor * a.z * b.z;
}

// Hermite's rules, element by element: what lump_gradients() and lump_hessians() do with whole
// triangles. Without Hessians VG, as constants of hermite_rules.h.
constexpr HermiteEdge kGradientEdge = {1.0 / 2, 1.0 / 12, 0, 0, 0, 0, 4};
constexpr HermiteFace kGradientFace = {1.0 / 3, 1.0 / 24, 0, 0, 0, {}, 0, 4};

void add_edge(const HermiteEdge& rule, const Vec3& a, const Vec3& b, double weight, Sources& to) {
  const Vec3 e = b - a;
  std::array<double, 6> hessian = {};
  add_product(e, e, rule.hessian * weight, hessian);
  to.add(a, rule.value * weight, rule.gradient * weight * e, hessian);
  to.add(b, rule.value * weight, -rule.gradient * weight * e, hessian);
  for (int k = 1; k <= rule.nodes; ++k) {
    const Node node = {a + static_cast<double>(k) / (rule.nodes + 1) * e, rule.node * weight};
    to.add({&node, 1});
  }
}

void add_face(const HermiteFace& rule, const std::array<Vec3, 3>& p, double weight, Sources& to) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    std::array<double, 6> hessian = {};
    add_product(a, a, rule.square * weight, hessian);
    add_product(b, b, rule.square * weight, hessian);
    add_product(a, b, 2 * rule.product * weight, hessian);
    to.add(p[i], rule.value * weight, rule.gradient * weight * (a + b), hessian);
  }
  const auto add_node = [&](double u, double v, double part) {
    const Node node = {u * p[0] + v * p[1] + (1 - u - v) * p[2], part * weight};
    to.add({&node, 1});
  };
  if (rule.center != 0) add_node(1.0 / 3, 1.0 / 3, rule.center);
  for (const auto& [part, u, v] : rule.orbits) {
    if (part == 0) continue;
    const double w = 1 - u - v;
    add_node(u, v, part), add_node(v, w, part), add_node(w, u, part);
    if (u != v) add_node(v, u, part), add_node(w, v, part), add_node(u, w, part);
  }
}

// A triangle as the pass sees it, and what of it belongs to a run.
struct SampledTriangle {
  std::size_t number = 0;
  std::array<Vec3, 3> p;
  std::array<std::uint32_t, 3> vertices;
  std::array<double, 3> weight;  // W
  double face_weight = 0;        // F
  bool lumped = true;
  bool face = true;
  std::array<bool, 3> edges = {};
};
// A run of triangles with all of their edges but those that a triangle before the run has; of later
// triangles at its border the edges alone.
using Run = std::vector<SampledTriangle>;

// A half-edge, by the vertices at its ends in ascending order.
struct HalfEdge {
  std::uint64_t name;
  std::size_t run, triangle, side;
};
std::uint64_t edge_name(std::uint64_t a, std::uint64_t b) {
  return std::min(a, b) << 32 | std::max(a, b);
}

// z^2 of an edge, as the kernel has it.
double extent2(const Vec3& a, const Vec3& b, double degree, double bend) {
  const Vec3 across = cross(a, b), e = b - a;
  const double over = 1 / std::min(dot(a, a), dot(b, b));
  return degree * degree * over * over * dot(across, across) + bend * over * dot(e, e);
}

class Sampler {
 public:
  Sampler(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
          std::span<const float> errors, double share)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        errors_(errors),
        share_(share),
        parameters_(plan.block) {
    parameters_.largest_index = static_cast<std::uint32_t>(mesh.n_vertices - 1);
    const double elements = kElements * static_cast<double>(mesh.n_triangles);
    left_ = std::max(kFinerRules * plan.allowed.rules,
                     kFinerRounding * plan.allowed.rounding * plan.block.scale);
    finer_.divided = {
        .degree = options.degree, .allowed = left_ / std::sqrt(elements), .divided = true};
    finer_.undivided = finer_.divided;
    finer_.undivided.divided = false;
  }

  SampledRules run(const Context& context) {
    const std::vector<Chosen> chosen = choose();
    std::vector<Run> runs;
    runs.reserve(chosen.size());
    double seen = 0;
    for (const Chosen& one : chosen) {
      const std::size_t n = std::min(kTrianglesPerBlock, mesh_.n_triangles - one.first);
      runs.push_back(read(one.first, n));
      seen += static_cast<double>(n);
    }
    find_edges(context, runs);
    Sources halves[2];
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      ask_cancel();
      halves[k % 2].scale = 1 / std::sqrt(chosen[k].chance);
      add(runs[k], halves[k % 2]);
    }
    const double share = seen / static_cast<double>(mesh_.n_triangles);
    const double left = left_ * std::sqrt(share);
    return judged(halves[0].sum(options_.degree, left, context),
                  halves[1].sum(options_.degree, left, context), share,
                  static_cast<double>(chosen.size()));
  }

 private:
  struct Chosen {
    std::size_t first;
    double chance;
  };

  // Runs with the chance of what the model says of them, or half of an even one.
  std::vector<Chosen> choose() {
    const std::size_t blocks = errors_.size();
    const double count = std::clamp(share_ * static_cast<double>(blocks), kFewestRuns, kMostRuns);
    double sum = 0;
    for (const double error : errors_) sum += error;
    const double even = 1 / static_cast<double>(blocks);
    std::vector<Chosen> chosen;
    double weighted = 0, before = random_uniform(0x70726f6265, mesh_.n_triangles);
    for (std::size_t b = 0; b < blocks; ++b) {
      const double part = sum > 0 ? (errors_[b] / sum + even) / 2 : even;
      const double chance = share_ < 1 ? std::min(1.0, count * part) : 1;
      weighted += (sum > 0 ? errors_[b] : 1) * std::sqrt(chance);
      const double after = before + chance;
      if (std::floor(after) > std::floor(before)) {
        chosen.push_back({b * kTrianglesPerBlock, chance});
      }
      before = after;
    }
    common_ = std::pow((sum > 0 ? sum : static_cast<double>(blocks)) / weighted, 2);
    return chosen;
  }

  Run read(std::size_t first, std::size_t n) {
    check_triangles(options_, first, n);
    BlockSums sums = no_triangles();
    work_block(mesh_, first, n, parameters_, *block_, sums);
    Run run(n);
    for (std::size_t t = 0; t < n; ++t) {
      SampledTriangle& triangle = run[t];
      triangle.number = first + t;
      for (std::size_t i = 0; i < 3; ++i) {
        triangle.p[i] = {block_->corner[i][0][t], block_->corner[i][1][t], block_->corner[i][2][t]};
        triangle.vertices[i] = mesh_.triangle(first + t)[i];
        triangle.weight[i] = block_->edge_weight[i][t];
      }
      triangle.face_weight = block_->face_weight[t];
      triangle.lumped = (block_->flag[t] & kNodes) == 0;
    }
    return run;
  }

  // Which edges belong to each run, and the triangles beyond its border that have them, too.
  void find_edges(const Context& context, std::vector<Run>& runs) {
    std::vector<HalfEdge> open;
    for (std::size_t r = 0; r < runs.size(); ++r) find_inner_edges(r, runs[r], open);
    std::sort(open.begin(), open.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.name != b.name ? a.name < b.name : a.run < b.run;
    });
    const std::vector<std::size_t> beyond = triangles_at(open, context);
    std::vector<bool> owned(open.size(), true);
    struct Twin {
      std::size_t half_edge, triangle, side;
    };
    std::vector<Twin> twins;
    twins.reserve(3 * beyond.size());
    for (const std::size_t number : beyond) {
      const Triangle t = mesh_.triangle(number);
      for (std::size_t side = 0; side < 3; ++side) {
        for_each_of(open, edge_name(t[side], t[(side + 1) % 3]), [&](std::size_t k) {
          const std::size_t own = runs[open[k].run][open[k].triangle].number;
          if (number < own) owned[k] = false;
          if (number > own) twins.push_back({k, number, side});
        });
      }
    }
    for (std::size_t k = 0; k < open.size(); ++k) {
      runs[open[k].run][open[k].triangle].edges[open[k].side] = owned[k];
    }
    for (const Twin& twin : twins) {
      if (!owned[twin.half_edge]) continue;
      SampledTriangle other = read(twin.triangle, 1).front();
      other.face = false;
      other.edges[twin.side] = true;
      runs[open[twin.half_edge].run].push_back(other);
    }
  }

  // Edges within a run are its own; appends the half-edges at its border.
  static void find_inner_edges(std::size_t number, Run& run, std::vector<HalfEdge>& open) {
    std::vector<HalfEdge> all;
    all.reserve(3 * run.size());
    for (std::size_t t = 0; t < run.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        all.push_back({edge_name(run[t].vertices[i], run[t].vertices[(i + 1) % 3]), number, t, i});
      }
    }
    std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return a.name != b.name ? a.name < b.name : a.triangle < b.triangle;
    });
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool inner = (k > 0 && all[k - 1].name == all[k].name) ||
                         (k + 1 < all.size() && all[k + 1].name == all[k].name);
      if (inner) {
        run[all[k].triangle].edges[all[k].side] = true;
      } else {
        open.push_back(all[k]);
      }
    }
  }

  template <typename Visit>
  static void for_each_of(const std::vector<HalfEdge>& sorted, std::uint64_t name,
                          const Visit& visit) {
    auto at = std::lower_bound(sorted.begin(), sorted.end(), name,
                               [](const HalfEdge& a, std::uint64_t b) { return a.name < b; });
    for (; at != sorted.end() && at->name == name; ++at) {
      visit(static_cast<std::size_t>(at - sorted.begin()));
    }
  }

  // The triangles of the mesh that may have one of these edges, in order.
  std::vector<std::size_t> triangles_at(const std::vector<HalfEdge>& open,
                                        const Context& context) const {
    std::vector<std::uint64_t> marks(mesh_.n_vertices / 64 + 1);
    for (const HalfEdge& edge : open) {
      for (const std::uint64_t vertex : {edge.name >> 32, edge.name & 0xFFFFFFFF}) {
        marks[vertex / 64] |= std::uint64_t{1} << vertex % 64;
      }
    }
    const auto marked = [&](std::uint32_t v) { return marks[v / 64] >> v % 64 & 1; };
    std::vector<std::vector<std::size_t>> found((mesh_.n_triangles + kScanGrain - 1) / kScanGrain);
    parallel_for(mesh_.n_triangles, kScanGrain, {.threads = context.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     const Triangle t = mesh_.triangle(i);
                     if (marked(t[0]) + marked(t[1]) + marked(t[2]) < 2) continue;
                     found[begin / kScanGrain].push_back(i);
                   }
                   if (options_.release) options_.release(begin, end - begin);
                 });
    std::vector<std::size_t> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  // The sources of the plan, less those of the finer rules.
  void add(const Run& run, Sources& to) const {
    const ScaledVertices vertices{.mesh = mesh_,
                                  .center = parameters_.scale * parameters_.center,
                                  .scale = parameters_.scale};
    NodeWriter own({plan_.divided, plan_.undivided}, vertices, to);
    for (const SampledTriangle& t : run) {
      if (t.lumped) {
        add_lumped(t, to);
      } else {
        own.add_triangle(t.p, t.vertices, t.edges, t.face);
      }
    }
    own.flush();
    to.scale = -to.scale;
    NodeWriter finer(finer_, vertices, to);
    for (const SampledTriangle& t : run) finer.add_triangle(t.p, t.vertices, t.edges, t.face);
    finer.flush();
  }

  void add_lumped(const SampledTriangle& t, Sources& to) const {
    const BlockParameters& b = parameters_;
    const double bend = b.hessians ? kHermiteBend : 16;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &x = t.p[i], &y = t.p[(i + 1) % 3];
      const double z2 = extent2(x, y, b.degree, bend);
      most = std::max(most, z2);
      const HermiteEdge& rule =
          b.hessians ? kHermiteEdges[hermite_rule(b.edge_reach2, z2)] : kGradientEdge;
      if (t.edges[i]) add_edge(rule, x, y, t.weight[i], to);
    }
    if (!t.face) return;
    add_face(b.hessians ? kHermiteFaces[hermite_rule(b.face_reach2, most)] : kGradientFace, t.p,
             t.face_weight, to);
  }

  SampledRules judged(const Coefficients& p, const Coefficients& q, double share,
                      double runs) const {
    const auto from = [&](int first) {
      double own = 0, other = 0, common = 0, noise = 0;
      for (int l = first; l <= p.degree(); ++l) {
        for (int m = 0; m <= l; ++m) {
          const auto count = [&](double x, double y) {
            own += x * x, other += y * y, common += x * y, noise += x * x * y * y;
          };
          count(p.c(l, m), q.c(l, m));
          count(p.s(l, m), q.s(l, m));
        }
      }
      const double whole = 4 * common_ - 2, both = own + other;
      const double apart = both > 0 ? std::hypot(std::sqrt(2 / runs), (own - other) / both) : 0;
      const double error2 = both + std::max(0.0, whole * common);
      return std::array{std::sqrt(error2),
                        std::sqrt(error2 + 2 * apart * both + 2 * whole * std::sqrt(noise))};
    };
    const auto [error, most] = from(1);
    return {.error = error,
            .band = from(3 * p.degree() / 4 + 1)[0],
            .doubt = most - error,
            .share = share};
  }

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  const MeshPlan& plan_;
  std::span<const float> errors_;
  double share_;
  BlockParameters parameters_;
  NodeOptions finer_;
  double left_ = 0;    // by the finer rules
  double common_ = 1;  // what errors that are alike count for
  std::unique_ptr<TriangleBlock<double>> block_ = std::make_unique<TriangleBlock<double>>();
};

}  // namespace

SampledRules sample_rules(const MeshView& mesh, const MeshPassOptions& options,
                          const MeshPlan& plan, std::span<const float> block_errors,
                          const Context& context, double share) {
  return Sampler(mesh, options, plan, block_errors, share).run({.threads = context.threads});
}

}  // namespace rholm
