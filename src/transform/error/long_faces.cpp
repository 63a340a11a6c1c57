#include "transform/error/long_faces.h"

#include <algorithm>
#include <cmath>

#include "base/cancel.h"

namespace rholm {
namespace {

// Points are at most this many 1/L apart (chosen).
constexpr double kDense = 1.5;
constexpr int kMostDivisions = 3;
// Largest number of divisions of the lattice of a part. Chosen: larger parts are fewer and share
// fewer points, but are denser than needed where they are far.
constexpr int kMostOfPart = 12;
// Largest number of halvings, where a face nearly touches the centre: to 2^-20 of its longest edge.
constexpr int kMostHalvings = 40;

// Returns the number of parts into which the edges of a face, or of a part of it, are divided.
int divisions(const std::array<Vec3, 3>& corners, int degree) {
  double angle2 = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
    const Vec3 e = b - a;
    const double distance2 = std::min(dot(a, a), dot(b, b));
    angle2 = std::max(angle2, distance2 > 0 ? dot(e, e) / distance2 : 0.0);
  }
  const double parts = std::ceil(std::min(1e3, degree * std::sqrt(angle2) / kDense));
  return std::max(static_cast<int>(parts), 1);
}

using OnFace = std::array<double, 3>;
constexpr std::array<OnFace, 3> kHalves = {{{0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}}};
constexpr double kThird = 1.0 / 3, kTwoThirds = 2.0 / 3;
constexpr std::array<OnFace, 7> kThirds = {{{kThird, kThird, kThird},
                                            {kTwoThirds, kThird, 0},
                                            {kThird, kTwoThirds, 0},
                                            {0, kTwoThirds, kThird},
                                            {0, kThird, kTwoThirds},
                                            {kThird, 0, kTwoThirds},
                                            {kTwoThirds, 0, kThird}}};
static_assert(kMostDivisions == 3);

// Sets the points between corners whose edges are divided into n parts, and returns their number.
std::size_t lattice(const std::array<Vec3, 3>& p, int n, std::array<Vec3, 7>& points) {
  if (n == 1) return 0;
  const std::span<const OnFace> places = n == 2 ? std::span<const OnFace>(kHalves) : kThirds;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& [a, b, c] = places[k];
    points[k] = a * p[0] + b * p[1] + c * p[2];
  }
  return places.size();
}

class DensePoints {
 public:
  DensePoints(int degree, std::size_t t, const PointsOnFace& visit)
      : degree_(degree), t_(t), visit_(visit) {}

  // Adds the points of a part, which is halved at its longest edge until a lattice is dense enough.
  // Also visits the middle of that edge.
  void add(const std::array<Vec3, 3>& p, int halvings) {
    const int n = divisions(p, degree_);
    if (n <= kMostOfPart || halvings == kMostHalvings) {
      visit_lattice(p, std::min(n, kMostOfPart));
      return;
    }
    int longest = 0;
    for (int i = 1; i < 3; ++i) {
      if (edge2(p, i) > edge2(p, longest)) longest = i;
    }
    const Vec3 &a = p[longest], &b = p[(longest + 1) % 3], &c = p[(longest + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    visit_(std::span(&middle, 1), t_);
    add({a, middle, c}, halvings + 1);
    add({middle, b, c}, halvings + 1);
  }

 private:
  // Visits all points of a lattice except the corners.
  void visit_lattice(const std::array<Vec3, 3>& p, int n) {
    if (n == 1) return;
    const Vec3 along = (p[1] - p[0]) / n, across = (p[2] - p[0]) / n;
    std::size_t found = 0;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        if (i == n || j == n || i + j == 0) continue;
        points_[found++] = p[0] + i * along + j * across;
      }
    }
    visit_(std::span(points_).first(found), t_);
  }
  static double edge2(const std::array<Vec3, 3>& p, int i) {
    const Vec3 e = p[(i + 1) % 3] - p[i];
    return dot(e, e);
  }

  int degree_;
  std::size_t t_;
  const PointsOnFace& visit_;
  std::array<Vec3, (kMostOfPart + 1) * (kMostOfPart + 2) / 2> points_;
};

// Calls visit(corners, t) for the faces of runs [begin, end). Leaves out runs whose edges are all
// shorter than `least` times 1/L.
template <typename Visit>
void visit_runs(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                double least, std::size_t begin, std::size_t end, const Visit& visit) {
  for (std::size_t run = begin; run < end; ++run) {
    if (degree * std::sqrt(scan.sizes.angles2[run]) <= least) continue;
    const std::size_t first = run * FaceSizes::kRun;
    for (std::size_t t = first; t < std::min(mesh.n_faces, first + FaceSizes::kRun); ++t) {
      visit(corners_of(mesh, mesh.triangle(t), center, scan.sizes.scale), t);
    }
  }
}

}  // namespace

std::array<Vec3, 3> corners_of(const MeshView& mesh, const Triangle& triangle, const Vec3& center,
                               double scale) {
  std::array<Vec3, 3> corners;
  for (int i = 0; i < 3; ++i) corners[i] = scale * (mesh.vertex(triangle[i]) - center);
  return corners;
}

void visit_long_faces(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                      std::size_t begin, std::size_t end, const PointsOnFace& visit) {
  std::array<Vec3, 7> points;
  visit_runs(mesh, center, scan, degree, kDense, begin, end,
             [&](const std::array<Vec3, 3>& p, std::size_t t) {
               const int n = std::min(divisions(p, degree), kMostDivisions);
               const std::size_t found = lattice(p, n, points);
               if (found > 0) visit(std::span(points).first(found), t);
             });
}

std::vector<std::size_t> longest_faces(const MeshView& mesh, const Vec3& center,
                                       const FaceScan& scan, int degree) {
  std::vector<std::size_t> faces;
  CancelPoll poll;
  for (std::size_t run = 0; run < scan.sizes.angles2.size(); ++run) {
    poll();
    visit_runs(mesh, center, scan, degree, kMostDivisions * kDense, run, run + 1,
               [&](const std::array<Vec3, 3>& p, std::size_t t) {
                 if (divisions(p, degree) > kMostDivisions) faces.push_back(t);
               });
  }
  return faces;
}

void visit_dense_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan, int degree,
                        std::size_t t, const PointsOnFace& visit) {
  DensePoints(degree, t, visit)
      .add(corners_of(mesh, mesh.triangle(t), center, scan.sizes.scale), 0);
}

}  // namespace rholm
