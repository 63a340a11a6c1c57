#include "transform/mesh_pass/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "harmonic/nonuniform/nonuniform.h"
#include "rholm/error.h"
#include "transform/geometry/star_geometry.h"
#include "transform/mesh_pass/plan/coherence.h"
#include "transform/mesh_pass/plan/lumping.h"

namespace rholm {
namespace {

constexpr std::size_t kSampleBlocks = 24;  // 3072 triangles: some 1 ms, and planning as much again
constexpr double kPi = std::numbers::pi;

// Shares of the wanted error; they add up in squares.
constexpr double kRuleShare = 0.46;
constexpr double kWindowShare = 0.45;
constexpr double kQuantumShare = 0.2;
// A cube-sphere of a million triangles left 0.5 times the window's error of the norm (measured).
constexpr double kInStep = 0.4;
// Sources along a meridian or a parallel, as on extruded shapes, are all alike to the grid: its
// error is that of the parts, which cancel in the whole (8 times measured on such a shape, a fifth
// of whose edges lie so), and grows with the share of the edges.
constexpr double kAlignedTimes = 7, kAlignedShare = 0.2;
double in_step(double aligned) {
  return kInStep / (1 + kAlignedTimes * std::min(1.0, aligned / kAlignedShare));
}

// What windows in single precision leave of sources in step, relative to the sum of the moduli of
// their weights (6e-10 measured on boxes of a million faces).
constexpr double kSingleInStep = 9e-10;

// Rounding of the double sums against c_00, as in the direct engine.
constexpr double kRounding = 1e-15;

// A rule chosen as just good enough leaves, in the mean, this part of what it may.
constexpr double kTypicalShare = 0.4;
// What the measured coherence is multiplied by: eight packets scatter by a third.
constexpr double kScatter = 2;
// Elements (edges and faces) per triangle.
constexpr double kElements = 2.5;

// Moments of r over the directions of triangles: corners and centroid, exact solid angles.
struct Moments {
  double solid = 0, signed_solid = 0, sum = 0, square = 0;
  void add(const std::array<Vec3, 3>& p) {
    const double signed_omega = solid_angle(p), omega = std::abs(signed_omega);
    if (std::isfinite(omega)) signed_solid += signed_omega;
    if (!(omega > 0)) return;
    const auto at = [&](const Vec3& x, double weight) {
      const double r = norm(x);
      sum += weight * omega * r;
      square += weight * omega * r * r;
    };
    for (const Vec3& corner : p) at(corner, 1.0 / 12);
    at((p[0] + p[1] + p[2]) / 3.0, 0.75);
    solid += omega;
  }
};

// Weights of edges, all and those along meridians or parallels; their angles.
struct EdgeStatistics {
  double all = 0, aligned = 0, angles = 0, count = 0;
  void add(const Vec3& a, const Vec3& b, double weight) {
    constexpr double kStraight = 1e-3;  // chosen: part of the edge's own angle
    const double across = norm(cross(a, b));
    const double r = norm(a), s = norm(b);
    const double by_meridian = std::abs(a.x * b.y - a.y * b.x);
    const double by_parallel = std::abs(a.z * s - b.z * r);
    all += weight;
    angles += across / (r * s);
    ++count;
    if (std::min(by_meridian, by_parallel) < kStraight * across) aligned += weight;
  }
};

// Half-edges of a block, whose triangles begin at `first` of the sample, by the vertices at their
// ends.
void add_edges(const TriangleBlock<double>& block, std::size_t n, std::size_t first,
               MeshSample& sample) {
  struct Half {
    std::uint64_t name;
    double error, error2, weight;
    std::uint32_t number;
  };
  std::vector<Half> halves;
  for (std::size_t t = 0; t < n; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = block.hash[i][t], b = block.hash[(i + 1) % 3][t];
      halves.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b),
                        block.edge_error[i][t], block.error2[t], block.edge_weight[i][t],
                        static_cast<std::uint32_t>(3 * (first + t) + i)});
    }
  }
  std::sort(halves.begin(), halves.end(),
            [](const Half& a, const Half& b) { return a.name < b.name; });
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    const Half &a = halves[i], &b = halves[i + 1];
    if (a.name != b.name || !std::isfinite(a.error2 + b.error2)) continue;
    const bool in_order = a.error2 <= b.error2;
    const Half &lower = in_order ? a : b, &upper = in_order ? b : a;
    sample.twins.push_back({a.number, b.number});
    sample.edges.push_back(
        {lower.error2, upper.error2, lower.error, upper.error, lower.weight + upper.weight});
    ++i;
  }
}

// Sum of squares of all faces.
double face_error2(const MeshSample& sample) {
  double faces = 0;
  for (const MeshSample::Entry& entry : sample.entries) faces += entry.face_error2;
  return sample.share * faces;
}

// Sum of squares of what is spread, roughly: edges in some three nodes or two lumps, faces in some
// six or three, with gradients that count about as much again.
double source2_of(const MeshSample& sample) {
  double faces = 0, edges = 0;
  for (const MeshSample::Entry& entry : sample.entries) faces += entry.face_weight2;
  for (const MeshSample::Edge& edge : sample.edges) edges += edge.weight * edge.weight;
  // Edges nobody knows are taken for as smooth as faces.
  const double whole = sample.edge_share > 0 ? sample.edge_share * edges : sample.share * faces;
  return whole / 2 + sample.share * faces / 3;
}

// Sum of the moduli of what is spread, roughly.
double moduli_of(const MeshSample& sample) {
  double faces = 0, edges = 0;
  for (const MeshSample::Entry& entry : sample.entries) faces += std::sqrt(entry.face_weight2);
  for (const MeshSample::Edge& edge : sample.edges) edges += std::abs(edge.weight);
  faces *= sample.share;
  return faces + (sample.edge_share > 0 ? sample.edge_share * edges : faces);
}

// On smooth surfaces the edges' part is a few times the faces'; where every edge is a crease
// nothing cancels, and to measure it is a waste of time.
bool may_cancel(const MeshSample& sample) {
  constexpr double kCreased = 30;  // chosen
  double edges = 0;
  for (const MeshSample::Edge& edge : sample.edges) edges += std::pow(edge.lower + edge.upper, 2);
  return sample.edge_share * edges <= kCreased * face_error2(sample);
}

// Some four thousand edges: the sum of squares to a few per cent, if none outweighs the others.
std::uint32_t sampled_names(std::size_t n_triangles) {
  const double part = 4000 / (1.5 * static_cast<double>(n_triangles));
  return static_cast<std::uint32_t>(std::min(1.0, part) * 4294967295.0);
}

MeshSample::Triangle triangle_of(const TriangleBlock<double>& block, std::size_t t,
                                 const std::array<Vec3, 3>& p, int degree) {
  MeshSample::Triangle triangle{.weight = {}, .z2 = {}, .face = block.face_weight[t]};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    const Vec3 across = cross(a, b), e = b - a;
    const double over = 1 / std::min(dot(a, a), dot(b, b));
    triangle.weight[i] = block.edge_weight[i][t];
    triangle.z2[i] = degree * static_cast<double>(degree) * over * over * dot(across, across) +
                     kHermiteBend * over * dot(e, e);
  }
  return triangle;
}

}  // namespace

double sampled_error2(std::vector<SampledHalfEdge>& sample, std::uint32_t sampled_names) {
  std::sort(sample.begin(), sample.end(), [](const SampledHalfEdge& a, const SampledHalfEdge& b) {
    return a.name != b.name ? a.name < b.name : a.error < b.error;
  });
  double sum = 0;
  for (std::size_t i = 0; i < sample.size();) {
    double error = 0;
    const std::uint64_t name = sample[i].name;
    for (; i < sample.size() && sample[i].name == name; ++i) {
      if (sample[i].lumped) error += sample[i].error;
    }
    sum += error * error;
  }
  return sum * 4294967296.0 / std::max(1.0, static_cast<double>(sampled_names));
}

MeshSample sample_mesh(const MeshView& mesh, const Vec3& center, int degree) {
  MeshSample sample;
  // Some of the vertices are enough to bring lengths near 1.
  MeshView few = mesh;
  const std::size_t step = std::max<std::size_t>(1, mesh.n_vertices / 1024);
  few.vertex_stride *= step;
  few.n_vertices = (mesh.n_vertices + step - 1) / step;
  sample.scale = unit_scale(few, center);
  BlockParameters parameters{.center = center,
                             .scale = sample.scale,
                             .degree = static_cast<double>(degree),
                             .grazing2 = 0,
                             .tolerance2 = std::numeric_limits<double>::infinity(),
                             .mean_reach2 = 1,
                             .per_weight = 1,
                             .per_gradient = 1,
                             .largest = std::numeric_limits<double>::infinity()};
  constexpr std::size_t kSize = TriangleBlock<double>::kSize;
  const std::size_t blocks = (mesh.n_triangles + kSize - 1) / kSize;
  const std::size_t taken = std::min(blocks, kSampleBlocks);
  auto block = std::make_unique<TriangleBlock<double>>();
  Moments moments;
  EdgeStatistics edges;
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t first = k * blocks / taken * kSize;
    const std::size_t n = std::min(kSize, mesh.n_triangles - first);
    parameters.largest_index = largest_index(mesh, first, n);
    if (parameters.largest_index >= mesh.n_vertices) continue;  // the pass will say so
    BlockSums sums = no_triangles();
    work_block(mesh, first, n, parameters, *block, sums);
    for (std::size_t t = 0; t < n; ++t) {
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = {block->corner[i][0][t], block->corner[i][1][t], block->corner[i][2][t]};
      }
      moments.add(p);
      sample.triangles.push_back(triangle_of(*block, t, p, degree));
      for (int i = 0; i < 3; ++i) {
        const double weight = std::abs(block->edge_weight[i][t]);
        if (std::isfinite(weight) && weight > 0) edges.add(p[i], p[(i + 1) % 3], weight);
      }
      if (std::isfinite(block->error2[t])) {
        sample.entries.push_back({block->error2[t], std::pow(block->face_error[t], 2),
                                  std::pow(block->face_weight[t], 2)});
      }
    }
    add_edges(*block, n, sample.triangles.size() - n, sample);
  }
  std::sort(sample.entries.begin(), sample.entries.end(),
            [](const auto& a, const auto& b) { return a.error2 < b.error2; });
  if (moments.solid > 0) {
    sample.mean = moments.sum / moments.solid;
    const double variance = moments.square / moments.solid - sample.mean * sample.mean;
    sample.norm = std::sqrt(4 * kPi * std::max(0.0, variance));
  }
  sample.aligned = edges.all > 0 ? edges.aligned / edges.all : 0;
  sample.angle = edges.count > 0 ? edges.angles / edges.count : 0;
  const double n = static_cast<double>(std::max<std::size_t>(sample.entries.size(), 1));
  sample.share = static_cast<double>(mesh.n_triangles) / n;
  sample.overlaps = moments.solid > 1.01 * std::abs(moments.signed_solid);
  // A tenth of the edges should meet; in a mesh of random order none does.
  if (static_cast<double>(sample.edges.size()) > 0.1 * n) {
    sample.edge_share =
        1.5 * static_cast<double>(mesh.n_triangles) / static_cast<double>(sample.edges.size());
  }
  return sample;
}

MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, const PlanLimits& limits) {
  MeshPlan plan;
  if (!(sample.mean > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                "no direction sees the surface from the centre: its faces have no area");
  }
  const double c00 = sample.mean * std::sqrt(4 * kPi);
  const double budget = std::max(precision * sample.norm, kRounding * c00) / limits.tighten;
  // Where sheets overlap the norm of their alternating sum is below what the sample says.
  plan.caution = sample.overlaps ? 1.5 : 1;
  plan.rules = kRuleShare * budget / plan.caution;
  plan.window = kWindowShare * budget;
  plan.most_window = in_step(sample.aligned) * precision / limits.tighten;
  plan.mean_error = std::max(precision, kRounding);
  plan.rounding = 4 * kRounding * c00 / sample.scale;
  const double unit = lumping_error(degree);
  plan.in_step = neighbours_in_step(std::pow(degree * sample.angle, 2));
  const double rules2 = std::pow(plan.rules / unit, 2);
  const double allowed2 = rules2 / (plan.in_step * plan.in_step);
  plan.source2 = source2_of(sample);
  double tolerance2 = tolerance_of(sample, allowed2);
  if (!sample.entries.empty() && tolerance2 < sample.entries.back().error2) {
    // The measured energy may be too low by its scatter. What is four times as bad as all of the
    // sample gets nodes.
    const double limit = (1 - node_share2(false)) * rules2 / face_error2(sample);
    const double coherence =
        may_cancel(sample)
            ? kScatter * error_coherence(mesh, center, sample.scale, degree, limit / kScatter)
            : std::numeric_limits<double>::infinity();
    if (std::isfinite(coherence) && coherence <= limit) {
      plan.coherence = coherence;
      plan.in_step = 1;  // it has been measured
      tolerance2 = 16 * sample.entries.back().error2;
    }
  }
  plan.node_share = noded_share(sample, tolerance2);
  std::optional<HermiteLumps> hermite;
  if (plan.node_share > 0) hermite = hermite_lumps(sample, allowed2);
  if (hermite && hermite->cost < kNodedCost * plan.node_share) {
    tolerance2 = hermite->tolerance2;
    plan.node_share = hermite->node_share;
    plan.between = hermite->between;
    plan.hessian2 = hermite->hessian2;
  } else {
    hermite.reset();
  }
  if (limits.many_nodes) plan.node_share = 1;
  const double vertices = static_cast<double>(mesh.n_vertices);
  plan.single = !limits.forbid_single &&
                single_rounding(degree, hermite ? 2 : 1) * std::sqrt(plan.source2 / (4 * kPi)) <
                    0.3 * plan.window &&
                kSingleInStep * moduli_of(sample) < plan.window;
  // Rounding to quanta adds variance q^2 / 12 at two corners of a triangle and twice that at the
  // third: at six corners a vertex 2/3 q^2.
  const double noise = kQuantumShare * budget * std::sqrt(6 * kPi / vertices);
  const double quantum = std::exp2(std::floor(std::log2(noise)) - (plan.single ? 0 : 6));
  plan.quanta = kQuantumShare * budget * quantum / noise;
  plan.block = {.center = center,
                .scale = sample.scale,
                .degree = static_cast<double>(degree),
                .grazing2 = std::pow(grazing_slope(degree), 2),
                .tolerance2 = tolerance2,
                // 1/|x|^2 by the rule of lumping leaves 5!/720 z^4 and less.
                .mean_reach2 = std::sqrt(6 * plan.mean_error),
                .per_weight = 1 / quantum,
                .per_gradient = std::max(degree, 1) / quantum,
                // Sums wrap around: only those of whole vertices must fit into 31 bits, where the
                // weights of neighbours cancel.
                .largest = std::exp2(plan.single ? 28 : 48),
                .hessians = hermite.has_value(),
                // Nothing makes up for their rounding: finer. Still they are smaller than weights
                // by kFarthest of plane_wave_rules.cpp.
                .per_hessian = 4 * std::pow(std::max(degree, 1), 2) / quantum,
                .edge_reach2 = hermite ? hermite->edge_reach2 : HermiteReach{},
                .face_reach2 = hermite ? hermite->face_reach2 : HermiteReach{},
                .sampled_names = sampled_names(mesh.n_triangles)};
  // What the sample has none of counts as three of its triangles, as in largest_tolerance().
  const double noded = std::max(plan.node_share * static_cast<double>(mesh.n_triangles),
                                std::max(3 * sample.share, 10.0));
  const double element = plan.rules *
                         std::sqrt(node_share2(plan.node_share > 0) / (kElements * noded)) /
                         kTypicalShare;
  plan.divided = {.degree = degree, .error = element, .divided = true};
  plan.undivided = {.degree = degree, .error = element, .divided = false};
  return plan;
}

double rule_error(const MeshPlan& plan, double lumped2, double noded) {
  const double unit = lumping_error(plan.divided.degree);
  const double element = kTypicalShare * plan.divided.error;
  const double lumps = unit * plan.in_step;
  return plan.caution * std::sqrt(lumps * lumps * lumped2 + kElements * noded * element * element);
}

double window_error(const MeshPlan& plan, double source2) {
  return std::min(plan.most_window, plan.window / std::sqrt(std::max(source2, 1e-300) / (4 * kPi)));
}

}  // namespace rholm
