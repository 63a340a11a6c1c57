#include "transform/error/error_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/cancel.h"
#include "shape/face.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

// Worst points that are this far apart, in waves' 1/L, are peaks of their own.
constexpr std::size_t kCandidates = 2048;
constexpr double kApart = 2;
// On each face around them steps of this many 1/L at first (points lie within 1.5 of them), halved
// each time: four leave 1/10 of 1/L at most, 6e-4 of a peak of that curvature. After the first the
// best faces go on.
constexpr double kFirstStep = 0.75;
constexpr int kRounds = 4;

struct Climber {
  std::array<Vec3, 3> corners;  // from the centre, scaled
  FaceNormal normal;
  double a = 0, b = 0;  // weights of the first two corners
  double step = 0;      // of the weights
  double value = 0;

  Vec3 at(double wa, double wb) const {
    return wa * corners[0] + wb * corners[1] + (1 - wa - wb) * corners[2];
  }
};

// The worst points, none near a worse one.
std::vector<std::size_t> sites(const ErrorPoints& points, const std::vector<double>& values,
                               int degree, std::size_t n) {
  const std::vector<std::size_t> order = indices_of_largest(values, kCandidates);
  const double apart = kApart / std::max(degree, 1);
  std::vector<std::size_t> found;
  std::size_t different = 0;
  for (std::size_t k = 0; k < order.size() && different < n; ++k) {
    double nearest = 4;
    for (const std::size_t i : found) {
      const Vec3 chord = points.directions[order[k]] - points.directions[i];
      nearest = std::min(nearest, dot(chord, chord));
    }
    // Copies of a point, each with faces of its own, are one site together.
    constexpr double kSame = 1e-24;
    if (nearest > kSame && nearest <= apart * apart) continue;
    if (nearest > kSame) ++different;
    found.push_back(order[k]);
  }
  return found;
}

// The weights of the first two corners at the direction u, in the face or on its border.
void place(const Vec3& u, Climber& climber) {
  const auto& [p, q, r] = climber.corners;
  const double wa = dot(u, cross(q, r)), wb = dot(u, cross(r, p)), wc = dot(u, cross(p, q));
  const double sum = std::max(wa, 0.0) + std::max(wb, 0.0) + std::max(wc, 0.0);
  climber.a = sum > 0 ? std::max(wa, 0.0) / sum : 0;
  climber.b = sum > 0 ? std::max(wb, 0.0) / sum : 0;
}

std::vector<Climber> climbers(const MeshView& mesh, const Vec3& center, double scale,
                              const ErrorPoints& points, const std::vector<std::size_t>& sites,
                              const std::vector<double>& values, int degree) {
  std::vector<Climber> found;
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_triangles; ++t) {
    poll();
    const Triangle triangle = mesh.triangle(t);
    for (const std::size_t i : sites) {
      const std::int64_t owner = points.owners[i];
      const bool is_corner = std::ranges::any_of(
          triangle, [&](std::uint32_t v) { return -1 - static_cast<std::int64_t>(v) == owner; });
      if (!is_corner && owner != static_cast<std::int64_t>(t)) continue;
      Climber climber;
      for (int k = 0; k < 3; ++k) {
        climber.corners[k] = scale * (mesh.vertex(triangle[k]) - center);
      }
      climber.normal = face_normal(climber.corners);
      if (climber.normal.degenerate) continue;
      place(points.directions[i], climber);
      climber.value = values[i];
      double longest = 0;
      for (int k = 0; k < 3; ++k) {
        longest = std::max(longest, norm(climber.corners[k] - climber.corners[(k + 1) % 3]));
      }
      const double wave = kFirstStep / std::max(degree, 1) * norm(climber.at(climber.a, climber.b));
      climber.step = std::min(0.5, wave / longest);
      found.push_back(climber);
    }
  }
  return found;
}

// All climbers to the best of their six neighbours, if it is better.
void climb(std::vector<Climber>& climbers, double scale, const ErrorAt& error) {
  constexpr std::array<std::array<double, 2>, 6> kWays = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}}};
  ErrorPoints points;
  std::vector<std::array<double, 2>> weights;
  for (const Climber& c : climbers) {
    const double size = norm(c.normal.twice_area);
    for (const auto& way : kWays) {
      double a = std::clamp(c.a + c.step * way[0], 0.0, 1.0);
      double b = std::clamp(c.b + c.step * way[1], 0.0, 1.0);
      const double over = std::max(1.0, a + b);
      a /= over;
      b /= over;
      const Vec3 x = c.at(a, b);
      const double r = std::max(norm(x), 1e-300);
      weights.push_back({a, b});
      points.directions.push_back(x / r);
      points.radii.push_back(r / scale);
      points.cosines.push_back(std::abs(dot(c.normal.twice_area, x)) / (size * r));
    }
  }
  const std::vector<double> values = error(points);
  for (std::size_t i = 0; i < values.size(); ++i) {
    Climber& c = climbers[i / kWays.size()];
    if (!(values[i] > c.value)) continue;
    c.value = values[i];
    c.a = weights[i][0];
    c.b = weights[i][1];
  }
  for (Climber& c : climbers) c.step /= 2;
}

}  // namespace

double highest_peak(const MeshView& mesh, const Vec3& center, const ErrorPoints& points,
                    const std::vector<double>& values, int degree, std::size_t n_sites,
                    const ErrorAt& error) {
  const VertexRange r = vertex_range(mesh, 0, mesh.n_vertices);
  const double scale =
      unit_frame({{r.min[0], r.min[1], r.min[2]}, {r.max[0], r.max[1], r.max[2]}}).scale;
  double highest = largest(values);
  std::vector<Climber> all =
      climbers(mesh, center, scale, points, sites(points, values, degree, n_sites), values, degree);
  for (int round = 0; round < kRounds && !all.empty(); ++round) {
    climb(all, scale, error);
    std::stable_sort(all.begin(), all.end(),
                     [](const Climber& a, const Climber& b) { return a.value > b.value; });
    if (all.size() > n_sites + 1) all.resize(n_sites + 1);
    highest = std::max(highest, all[0].value);
  }
  return highest;
}

}  // namespace rholm
