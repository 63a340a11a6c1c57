#include "transform/mesh_pass/plan/coherence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/random.h"
#include "shape/face.h"
#include "transform/mesh_pass/plan/wave_kernels.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;

// Packets: the energy to some 35 % with eight, 60 % with three; fewer where each has many
// triangles.
constexpr int kMostPackets = 8, kFewestPackets = 3;
constexpr double kEnough = 4000;  // triangles in all packets together
constexpr double kWidth = 6;      // s in units of 1/L: about one wave length
constexpr double kReach = 4;      // of a packet, in units of s: exp(-8) beyond
// Where the first packets leave so many times the limit the others would not change it.
constexpr double kFar = 8;
// As lumping_error() has it, the square of sqrt(35/128) / 720 of weight and z^4.
constexpr double kUnit = 35.0 / 128 / (720.0 * 720.0);
constexpr std::size_t kFewest = 200;  // triangles in all packets together
constexpr double kFarthestRun = 0.3;  // radians: beyond, neighbours are not together in the file
// At most so many triangles are worked out, some 0.5 us each.
constexpr double kMost = 20000;

struct Packet {
  Vec3 middle, wave;
};

struct Looker {
  const MeshView& mesh;
  Vec3 center;
  double scale;
  std::array<Vec3, 3> corners(std::size_t t) const {
    std::array<Vec3, 3> p;
    const Triangle triangle = mesh.triangle(t);
    for (int i = 0; i < 3; ++i) {
      p[i] = triangle[i] < mesh.n_vertices ? scale * (mesh.vertex(triangle[i]) - center) : Vec3{};
    }
    return p;
  }
  Vec3 direction(std::size_t t) const {
    const std::array<Vec3, 3> p = corners(t);
    return normalized(p[0] + p[1] + p[2]);
  }
};

// Points of one triangle, and a wave there.
class WavePoints {
 public:
  void clear() { n_ = 0; }
  void add(const Vec3& p) {
    x_[n_] = p.x;
    y_[n_] = p.y;
    z_[n_++] = p.z;
  }
  // Wave vector L times a unit vector.
  void find_values(const Vec3& k) {
    const std::size_t n = n_;
    while (n_ % 8 != 0) add({1, 0, 0});
    wave_values(k, n, x_, y_, z_, cosine_, sine_);
    n_ = n;
  }
  Complex operator[](std::size_t i) const { return {cosine_[i], sine_[i]}; }

 private:
  static constexpr std::size_t kMost = 128;
  std::size_t n_ = 0;
  double x_[kMost], y_[kMost], z_[kMost], cosine_[kMost], sine_[kMost];
};

// The wave and its gradient at a corner.
struct CornerWave {
  Complex value, turned;  // turned: i times the value
  Vec3 phase;             // gradient of the phase
  Complex slope(const Vec3& e) const { return dot(phase, e) * turned; }
};
CornerWave corner_wave(const Vec3& k, const Vec3& x, const Complex& value) {
  const double over = 1 / dot(x, x);
  return {value, {-value.imag(), value.real()}, std::sqrt(over) * (k - (over * dot(k, x)) * x)};
}

struct TriangleError {
  Complex error;
  double face = 0;  // (F z^4)^2
};

// Nodes that leave nothing worth mentioning: good for waves across some 4 radians.
struct FineNodes {
  NodeAllowance fine{.degree = 1, .error = 1e-5, .divided = false};
  EdgeRule edge = edge_rule(fine, Extent{3}, 1);
  std::span<const FaceNode> face = face_rule(fine, Extent{3}, 1);
};

// Corners, nodes of the edges, nodes of the face.
void place_points(const std::array<Vec3, 3>& p, const FineNodes& nodes, WavePoints& points) {
  points.clear();
  for (const Vec3& corner : p) points.add(corner);
  for (int i = 0; i < 3; ++i) {
    for (const double t : nodes.edge.nodes) points.add(p[i] + t * (p[(i + 1) % 3] - p[i]));
  }
  for (const FaceNode& node : nodes.face) {
    points.add(node.at[0] * p[0] + node.at[1] * p[1] + node.at[2] * p[2]);
  }
}

// Lumping less the integrals by many nodes.
TriangleError error_of(const std::array<Vec3, 3>& p, const Vec3& k, int degree,
                       WavePoints& points) {
  TriangleError result;
  const FaceNormal normal = face_normal(p);
  const double d2 = dot(normal.twice_area, p[0]);
  if (normal.degenerate || d2 == 0) return result;
  const Vec3& n = normal.twice_area;
  const double face = -dot(n, n) / d2;
  static const FineNodes nodes;
  place_points(p, nodes, points);
  points.find_values(k);
  std::array<CornerWave, 3> waves;
  for (std::size_t i = 0; i < 3; ++i) waves[i] = corner_wave(k, p[i], points[i]);
  std::size_t at = 3;  // the next node
  double z2 = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 &a = p[i], &b = p[j], &c = p[(i + 2) % 3];
    const Vec3 e = b - a, across = cross(a, b);
    const double weight = dot(n, across) / d2;
    Complex mean = 0;
    for (const double node_weight : nodes.edge.weights) mean += node_weight * points[at++];
    const CornerWave &here = waves[i], &there = waves[j];
    const Complex leaving = here.slope(e);
    const Complex lumped = 0.5 * (here.value + there.value) + (leaving - there.slope(e)) / 12.0;
    result.error += weight * (lumped - mean);
    result.error += face * (here.value / 3.0 + (leaving + here.slope(c - a)) / 24.0);
    const double r2 = std::min(dot(a, a), dot(b, b));
    z2 = std::max(z2, degree * static_cast<double>(degree) * dot(across, across) / (r2 * r2) +
                          16 * dot(e, e) / r2);
  }
  Complex mean = 0;
  for (const FaceNode& node : nodes.face) mean += node.weight * points[at++];
  result.error -= face * mean;
  result.face = std::pow(face * z2 * z2, 2);
  return result;
}

std::vector<Packet> packets_on(const Looker& look, int count) {
  std::vector<Packet> packets;
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<std::uint64_t>(k);
    const double n = static_cast<double>(look.mesh.n_triangles);
    // One in each part of the file.
    const double place = (k + random_uniform(1, at)) / count;
    const Vec3 middle =
        look.direction(std::min(look.mesh.n_triangles - 1, static_cast<std::size_t>(place * n)));
    const double turn = 6.283185307179586 * random_uniform(2, at);
    const Vec3 axis = std::abs(middle.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Vec3 a = normalized(cross(axis, middle)), b = cross(middle, a);
    packets.push_back({middle, std::cos(turn) * a + std::sin(turn) * b});
  }
  return packets;
}

}  // namespace

double error_coherence(const MeshView& mesh, const Vec3& center, double scale, int degree,
                       double limit) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const Looker look{mesh, center, scale};
  const double width = kWidth / std::max(degree, 1), reach = kReach * width;
  // Runs of neighbours in the file, of each one triangle is looked at; powers of 4, as subdivision
  // makes groups of neighbours.
  const std::size_t length = mesh.n_triangles < 1'500'000 ? 16 : 64;
  if (reach > 0.5 || mesh.n_triangles < 100 * length) return kUnknown;
  // Directions of one triangle in each run, and how far a run goes.
  std::vector<Vec3> runs;
  std::vector<double> extents;
  for (std::size_t t = 0; t < mesh.n_triangles; t += length) {
    runs.push_back(look.direction(t));
    if (runs.size() % 16 == 1) {
      const std::size_t end = std::min(t + length, mesh.n_triangles);
      double extent = 0;
      for (std::size_t other = t; other < end; other += 7) {
        extent = std::max(extent, norm(look.direction(other) - runs.back()));
      }
      extents.push_back(extent);
    }
  }
  // A run in five may jump from one part of the mesh to another: it is taken for its own place or
  // that of the next one.
  const auto usual =
      extents.begin() + static_cast<std::ptrdiff_t>(0.8 * static_cast<double>(extents.size()));
  std::nth_element(extents.begin(), usual, extents.end());
  if (*usual > kFarthestRun) return kUnknown;
  const double around = std::pow(reach + 1.2 * *usual, 2);
  // A packet covers this part of the sphere.
  const double expected = static_cast<double>(mesh.n_triangles) * reach * reach / 4;
  const int packets =
      std::clamp(static_cast<int>(kEnough / expected), kFewestPackets, kMostPackets);
  if (packets * expected > kMost) return kUnknown;
  double energy = 0, faces = 0;
  std::size_t used = 0;
  int done = 0;
  const auto points = std::make_unique<WavePoints>();
  for (const Packet& packet : packets_on(look, packets)) {
    const Vec3 k = static_cast<double>(degree) * packet.wave;
    const auto near = [&](const Vec3& u) {
      const Vec3 away = u - packet.middle;
      return dot(away, away) < around;
    };
    Complex sum = 0;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      if (!near(runs[run]) && !(run + 1 < runs.size() && near(runs[run + 1]))) continue;
      const std::size_t end = std::min((run + 1) * length, mesh.n_triangles);
      for (std::size_t t = run * length; t < end; ++t) {
        const std::array<Vec3, 3> p = look.corners(t);
        const Vec3 from = normalized(p[0] + p[1] + p[2]) - packet.middle;
        const double distance2 = dot(from, from);
        if (!(distance2 < reach * reach)) continue;
        if (static_cast<double>(++used) > 3 * kMost) return kUnknown;
        const TriangleError error = error_of(p, k, degree, *points);
        const double window = std::exp(-distance2 / (2 * width * width));
        sum += window * error.error;
        faces += window * window * error.face;
      }
    }
    energy += std::norm(sum);
    ++done;
    if (done >= kFewestPackets && energy > kFar * limit * faces * kUnit) break;
  }
  if (used < kFewest || !(faces > 0) || !std::isfinite(energy)) return kUnknown;
  return energy / (faces * kUnit);
}

}  // namespace rholm
