#include "transform/mesh_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "transform/mesh_nodes.h"
#include "transform/star_geometry.h"

namespace rholm {
namespace {

constexpr std::size_t kSampleBlocks = 24;  // 3072 triangles: some 0.3 ms
constexpr double kPi = std::numbers::pi;

// Shares of the wanted error; they add up in squares.
constexpr double kRuleShare = 0.5;
constexpr double kWindowShare = 0.5;
constexpr double kQuantumShare = 0.1;

// Rounding of the double sums against c_00, as in the direct engine.
constexpr double kRounding = 1e-15;

// A rule chosen as just good enough leaves, in the mean, this part of what it may.
constexpr double kTypicalShare = 0.35;
// Elements (edges and faces) per triangle.
constexpr double kElements = 2.5;

// Moments of r over the directions of triangles: corners and centroid, exact solid angles.
struct Moments {
  double solid = 0, sum = 0, square = 0;
  void add(const std::array<Vec3, 3>& p) {
    const double omega = std::abs(solid_angle(p));
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

// The largest tolerance (squared, in units of lumping) that keeps the sum of squares allowed.
double tolerance_of(const MeshSample& sample, double allowed2) {
  double kept = 0, best = 0;
  const auto& entries = sample.entries;
  const std::size_t n = entries.size();
  const double noded = kElements * kTypicalShare * kTypicalShare;
  for (std::size_t i = 0; i <= n; ++i) {
    // Lump the first i; the others get rules that leave up to the tolerance.
    const double rest = static_cast<double>(n - i) * noded;
    const double room = allowed2 / sample.share - kept;
    if (room <= 0) break;
    const double top = i < n ? entries[i].error2 : std::numeric_limits<double>::infinity();
    const double tolerance = std::min(rest > 0 ? room / rest : room, top);
    if (i > 0 && tolerance < entries[i - 1].error2) break;
    best = std::max(best, tolerance);
    if (i < n) kept += entries[i].error2;
  }
  // No single triangle may take more than a tenth of it all: the sample does not know the worst.
  return std::min(best, allowed2 / 100);
}

}  // namespace

MeshSample sample_mesh(const MeshView& mesh, const Vec3& center, int degree) {
  MeshSample sample;
  sample.scale = unit_scale(mesh, center);
  const BlockParameters parameters{.center = center,
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
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t first = k * blocks / taken * kSize;
    const std::size_t n = std::min(kSize, mesh.n_triangles - first);
    if (largest_index(mesh, first, n) >= mesh.n_vertices) continue;  // the pass will say so
    BlockSums sums = no_triangles();
    work_block(mesh, first, n, parameters, *block, sums);
    for (std::size_t t = 0; t < n; ++t) {
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = {block->corner[i][0][t], block->corner[i][1][t], block->corner[i][2][t]};
      }
      moments.add(p);
      if (std::isfinite(block->error2[t])) {
        sample.entries.push_back({block->error2[t], block->weight2[t]});
      }
    }
  }
  std::sort(sample.entries.begin(), sample.entries.end(),
            [](const auto& a, const auto& b) { return a.error2 < b.error2; });
  if (moments.solid > 0) {
    sample.mean = moments.sum / moments.solid;
    const double variance = moments.square / moments.solid - sample.mean * sample.mean;
    sample.norm = std::sqrt(4 * kPi * std::max(0.0, variance));
  }
  const double n = static_cast<double>(std::max<std::size_t>(sample.entries.size(), 1));
  sample.share = static_cast<double>(mesh.n_triangles) / n;
  return sample;
}

MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, double tighten) {
  MeshPlan plan;
  const double c00 = sample.mean * std::sqrt(4 * kPi);
  const double budget = std::max(precision * sample.norm, kRounding * c00) / tighten;
  plan.rules = kRuleShare * budget;
  plan.window = kWindowShare * budget;
  plan.mean_error = std::max(precision, kRounding);
  plan.rounding = 4 * kRounding * c00 / sample.scale;
  const double unit = lumping_error(degree);
  const double tolerance2 = tolerance_of(sample, plan.rules * plan.rules / (unit * unit));
  double nodes = 0, lumped2 = 0;
  for (const MeshSample::Entry& entry : sample.entries) {
    if (entry.error2 > tolerance2) {
      nodes += 1;
      // Some three nodes to an edge, six to a face.
      plan.source2 += sample.share * entry.weight2 / 4;
    } else {
      lumped2 += sample.share * entry.weight2 / 8;
    }
  }
  plan.source2 += lumped2;
  plan.node_share = nodes / static_cast<double>(std::max<std::size_t>(sample.entries.size(), 1));
  const double vertices = static_cast<double>(mesh.n_vertices);
  plan.single = kSingleNoise * std::sqrt(plan.source2 / (4 * kPi)) < 0.3 * plan.window;
  // Rounding to quanta, six corners a vertex, adds variance q^2 / 2 to each vertex.
  const double noise = kQuantumShare * budget * std::sqrt(8 * kPi / vertices);
  const double quantum = std::exp2(std::floor(std::log2(noise)) - (plan.single ? 0 : 6));
  plan.block = {.center = center,
                .scale = sample.scale,
                .degree = static_cast<double>(degree),
                .grazing2 = std::pow(grazing_slope(degree), 2),
                .tolerance2 = tolerance2,
                // 1/|x|^2 by the rule of lumping leaves 5!/720 z^4 and less.
                .mean_reach2 = std::sqrt(6 * plan.mean_error),
                .per_weight = 1 / quantum,
                .per_gradient = std::max(degree, 1) / quantum,
                // A weight in single precision: 31 bits less a valence of 128.
                .largest = std::exp2(plan.single ? 24 : 44)};
  const double element = std::sqrt(tolerance2) * unit;
  plan.divided = {.degree = degree, .error = element, .divided = true};
  plan.undivided = {.degree = degree, .error = element, .divided = false};
  return plan;
}

double rule_error(const MeshPlan& plan, double lumped2, double noded) {
  const double unit = lumping_error(plan.divided.degree);
  const double element = kTypicalShare * plan.divided.error;
  return std::sqrt(unit * unit * lumped2 + kElements * noded * element * element);
}

double window_error(const MeshPlan& plan, double source2) {
  return plan.window / std::sqrt(std::max(source2, 1e-300) / (4 * kPi));
}

}  // namespace rholm
