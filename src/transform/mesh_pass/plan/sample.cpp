#include "transform/mesh_pass/plan/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "transform/geometry/star_geometry.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {
namespace {

constexpr std::size_t kSampleBlocks = 24;  // 3072 faces: some 1 ms, and planning as much again
constexpr double kPi = std::numbers::pi;

// Moments of r over the directions of faces, by corners and centroid, with exact solid angles.
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

// Weights of edges, of all and of edges along meridians or parallels; sum of the edges' angles.
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

// Adds the edges of a block, whose faces begin at `first` of the sample. Half-edges are matched by
// the vertices at their ends.
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

// Some of the vertices are enough to bring lengths near 1.
double scale_of(MeshView mesh, const Vec3& center) {
  const std::size_t step = std::max<std::size_t>(1, mesh.n_vertices / 1024);
  mesh.vertex_stride *= step;
  mesh.n_vertices = (mesh.n_vertices + step - 1) / step;
  return unit_scale(mesh, center, {.threads = 1});
}

// Returns parameters for blocks of which only the errors are used: nothing is too large.
BlockParameters judging_only(const Vec3& center, double scale, int degree) {
  return {.center = center,
          .scale = scale,
          .degree = static_cast<double>(degree),
          .grazing2 = 0,
          .tolerance2 = std::numeric_limits<double>::infinity(),
          .mean_reach2 = 1,
          .per_weight = 1,
          .per_gradient = 1,
          .largest = std::numeric_limits<double>::infinity()};
}

void add_triangles(const TriangleBlock<double>& block, std::size_t n, int degree, Moments& moments,
                   EdgeStatistics& edges, MeshSample& sample) {
  for (std::size_t t = 0; t < n; ++t) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = {block.corner[i][0][t], block.corner[i][1][t], block.corner[i][2][t]};
    }
    moments.add(p);
    sample.faces.push_back(triangle_of(block, t, p, degree));
    for (int i = 0; i < 3; ++i) {
      const double weight = std::abs(block.edge_weight[i][t]);
      if (std::isfinite(weight) && weight > 0) edges.add(p[i], p[(i + 1) % 3], weight);
    }
    if (std::isfinite(block.error2[t])) {
      sample.entries.push_back(
          {block.error2[t], std::pow(block.face_error[t], 2), std::pow(block.face_weight[t], 2)});
    }
  }
}

double source2_of(const MeshSample& sample) {
  double faces = 0, edges = 0;
  for (const MeshSample::Entry& entry : sample.entries) faces += entry.face_weight2;
  for (const MeshSample::Edge& edge : sample.edges) edges += edge.weight * edge.weight;
  // Edges that are not known count as if they were as smooth as faces.
  const double whole = sample.edge_share > 0 ? sample.edge_share * edges : sample.share * faces;
  return whole / 2 + sample.share * faces / 3;
}

double modulus_of(const MeshSample& sample) {
  double faces = 0, edges = 0;
  for (const MeshSample::Entry& entry : sample.entries) faces += std::sqrt(entry.face_weight2);
  for (const MeshSample::Edge& edge : sample.edges) edges += std::abs(edge.weight);
  faces *= sample.share;
  return faces + (sample.edge_share > 0 ? sample.edge_share * edges : faces);
}

void set_statistics(const Moments& moments, const EdgeStatistics& edges, std::size_t n_faces,
                    MeshSample& sample) {
  if (moments.solid > 0) {
    sample.mean = moments.sum / moments.solid;
    const double variance = moments.square / moments.solid - sample.mean * sample.mean;
    sample.norm = std::sqrt(4 * kPi * std::max(0.0, variance));
  }
  sample.aligned = edges.all > 0 ? edges.aligned / edges.all : 0;
  sample.angle = edges.count > 0 ? edges.angles / edges.count : 0;
  const double all = static_cast<double>(n_faces);
  const double n = static_cast<double>(std::max<std::size_t>(sample.entries.size(), 1));
  sample.share = all / n;
  sample.overlaps = moments.solid > 1.01 * std::abs(moments.signed_solid);
  // A tenth of the edges should have both half-edges in the sample; in random order none has.
  const double met = static_cast<double>(sample.edges.size());
  if (met > 0.1 * n) sample.edge_share = 1.5 * all / met;
  sample.source2 = source2_of(sample);
  sample.modulus = modulus_of(sample);
}

}  // namespace

MeshSample sample_mesh(const MeshView& mesh, const Vec3& center, int degree) {
  MeshSample sample;
  sample.scale = scale_of(mesh, center);
  BlockParameters parameters = judging_only(center, sample.scale, degree);
  constexpr std::size_t kSize = TriangleBlock<double>::kSize;
  const std::size_t blocks = (mesh.n_faces + kSize - 1) / kSize;
  const std::size_t taken = std::min(blocks, kSampleBlocks);
  auto block = std::make_unique<TriangleBlock<double>>();
  Moments moments;
  EdgeStatistics edges;
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t first = k * blocks / taken * kSize;
    const std::size_t n = std::min(kSize, mesh.n_faces - first);
    parameters.largest_index = largest_index(mesh, first, n);
    if (parameters.largest_index >= mesh.n_vertices) continue;  // the pass reports it
    BlockSums sums = no_triangles();
    work_block(mesh, first, n, parameters, *block, sums);
    add_triangles(*block, n, degree, moments, edges, sample);
    add_edges(*block, n, sample.faces.size() - n, sample);
  }
  set_statistics(moments, edges, mesh.n_faces, sample);
  return sample;
}

}  // namespace rholm
