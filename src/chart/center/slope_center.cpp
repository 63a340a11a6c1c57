// The slope of the radius r(u) of a star-shaped surface, int |grad_S r|^2 dOmega, is the sum over
// its degrees of l(l+1) times their energy: what is small by it ends early. A face at distance rho,
// whose plane is at distance d, has tan^2 gamma = rho^2 / d^2 - 1 and dOmega = d / rho^3 dA, so
// that its part is int (rho / d - d / rho) dA.
//
// The point with the least slope is sought on the line through the middle of the kernel and the
// centroid of the solid. Both keep every symmetry of the body, and so does what lies between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/random.h"
#include "chart/center/kernel.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Chosen: so many faces tell where the least slope is to a few hundredths of the way, in a
// millisecond or two.
constexpr std::size_t kSampled = 2048;

// A point of a face as seen from middle + t way: d = d_0 - t d_way, rho^2 = rho2_0 - 2 t along +
// t^2 |way|^2.
struct SamplePoint {
  double d_0, d_way;
  double rho2_0, along;
  double area;
};

struct Line {
  Vec3 middle, way;
};

struct SampledFace {
  Vec3 normal;
  std::array<Vec3, 3> corners;  // in the unit frame
  double area = 0;              // of it, and of the faces that it stands for
};

// Of many faces one of every `step`; which one is random, so that rows of a lattice are not met in
// step.
std::vector<SampledFace> sampled_faces(const LocalView& view) {
  const std::size_t n = view.mesh.n_triangles;
  const std::size_t step = std::max<std::size_t>(1, n / kSampled);
  std::vector<SampledFace> faces;
  faces.reserve(n / step + 1);
  for (std::size_t first = 0; first < n; first += step) {
    const std::size_t room = std::min(step, n - first);
    const std::size_t t = first + static_cast<std::size_t>(random_bits(0, first) % room);
    const FacePlane face = view.plane(t);
    if (!face.exists() || face.slack() > 0) continue;  // a plane that rounding turns says nothing
    std::array<Vec3, 3> corners = view.corners(t);
    for (Vec3& corner : corners) corner -= view.frame.center;
    const double area = norm(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
    faces.push_back({face.normal, corners, area * static_cast<double>(room)});
  }
  return faces;
}

// Three points on each face, the rule of degree 2, or on each of `side`^2 pieces of it.
void add_points(const SampledFace& face, int side, const Line& line,
                std::vector<SamplePoint>& points) {
  const auto& [a, b, c] = face.corners;
  const Vec3 along_b = (b - a) / side, along_c = (c - a) / side;
  const double area = face.area / (3 * side * side);
  const auto add_piece = [&](const Vec3& middle, double sign) {
    for (const Vec3& to : {-(along_b + along_c), 2 * along_b - along_c, 2 * along_c - along_b}) {
      // Half of the way from the middle to a corner.
      const Vec3 m = middle + sign / 6 * to - line.middle;
      points.push_back({.d_0 = dot(face.normal, m),
                        .d_way = dot(face.normal, line.way),
                        .rho2_0 = dot(m, m),
                        .along = dot(m, line.way),
                        .area = area});
    }
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side - i; ++j) {
      const Vec3 corner = a + i * along_b + j * along_c;
      add_piece(corner + (along_b + along_c) / 3, 1);
      if (i + j + 1 < side) add_piece(corner + 2 * (along_b + along_c) / 3, -1);
    }
  }
}

// Large faces have more of the points, so that it does not matter how a body is cut into faces.
std::vector<SamplePoint> sample_points(const LocalView& view, const Line& line) {
  const std::vector<SampledFace> faces = sampled_faces(view);
  double whole = 0;
  for (const SampledFace& face : faces) whole += face.area;
  std::vector<SamplePoint> points;
  points.reserve(6 * kSampled);
  for (const SampledFace& face : faces) {
    const double pieces = std::round(std::sqrt(face.area / whole * kSampled));
    add_points(face, std::max(1, static_cast<int>(pieces)), line, points);
  }
  return points;
}

// Infinite where a face turns its back.
double slope_at(const std::vector<SamplePoint>& points, double way2, double t) {
  double slope = 0;
  for (const SamplePoint& p : points) {
    const double d = p.d_0 - t * p.d_way, rho2 = p.rho2_0 - 2 * t * p.along + t * t * way2;
    if (!(d > 0 && rho2 > 0)) return kInfinity;
    slope += p.area * (rho2 - d * d) / (std::sqrt(rho2) * d);
  }
  return slope;
}

// Its derivative by t, where it is finite.
double rise_at(const std::vector<SamplePoint>& points, double way2, double t) {
  double rise = 0;
  for (const SamplePoint& p : points) {
    const double d = p.d_0 - t * p.d_way, rho2 = p.rho2_0 - 2 * t * p.along + t * t * way2;
    if (!(d > 0 && rho2 > 0)) return kInfinity;
    // rho rho' (1 / (rho d) + d / rho^3) - d' (rho / d^2 + 1 / rho)
    const double rho = std::sqrt(rho2), rho_rise = t * way2 - p.along;
    rise += p.area * (rho2 + d * d) / (rho * d) * (rho_rise / rho2 + p.d_way / d);
  }
  return rise;
}

}  // namespace

Vec3 least_slope(const LocalView& view, const KernelCenter& middle, const Vec3& centroid) {
  const Line line = {.middle = middle.point, .way = centroid - middle.point};
  const std::vector<SamplePoint> points = sample_points(view, line);
  const double way2 = dot(line.way, line.way);
  // Chosen: from as far behind the middle of the kernel to as far beyond the centroid as they are
  // apart, in steps that no second valley is narrower than.
  constexpr double kFirst = -1, kStep = 0.25;
  constexpr int kSteps = 12;
  double best = 0, least = slope_at(points, way2, 0);
  for (int i = 0; i <= kSteps; ++i) {
    const double t = kFirst + i * kStep;
    if (const double value = slope_at(points, way2, t); value < least) {
      least = value;
      best = t;
    }
  }
  // Where the slope stops falling, by halving. Beyond the border of the kernel it would rise
  // towards the best point.
  constexpr int kHalvings = 20;  // to 1e-6 of the way
  double low = best - kStep, high = best + kStep;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = (low + high) / 2, rise = rise_at(points, way2, t);
    const bool falls = std::isfinite(rise) ? rise < 0 : t < best;
    (falls ? low : high) = t;
  }
  return line.middle + (low + high) / 2 * line.way;
}

}  // namespace rholm
