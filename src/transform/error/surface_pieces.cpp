#include "transform/error/surface_pieces.h"

#include <array>
#include <cmath>

#include "base/cancel.h"
#include "base/random.h"
#include "shape/face.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr int kMostHalvings = 60;  // after these a piece is as small as rounding
constexpr std::uint64_t kSeed = 2;
// Values that differ by less count as equal: another unit of length may round equal values apart.
// So halvings do not depend on the unit.
constexpr double kSame = 1 + 1e-9;

// Computes the solid angle as in Van Oosterom and Strackee 1983.
double solid_angle(const Corners& p) {
  const double a = norm(p[0]), b = norm(p[1]), c = norm(p[2]);
  const double volume = dot(p[0], cross(p[1], p[2]));
  const double rest = a * b * c + dot(p[0], p[1]) * c + dot(p[1], p[2]) * a + dot(p[2], p[0]) * b;
  return std::abs(2 * std::atan2(volume, rest));
}

class Pieces {
 public:
  Pieces(const MeshView& mesh, const Vec3& center, std::size_t n)
      : mesh_(mesh), center_(center), n_(static_cast<double>(n)), all_(mesh.n_faces <= n) {
    const VertexRange r = vertex_range(mesh, {.threads = 1});
    found_.scale =
        unit_frame({{r.min[0], r.min[1], r.min[2]}, {r.max[0], r.max[1], r.max[2]}}).scale;
  }

  SurfacePieces run() {
    for_each_face([&](const Corners& p, const Vec3& twice_area, std::int64_t) {
      area_ += norm(twice_area) / 2;
      angle_ += solid_angle(p);
    });
    if (!(area_ > 0) || !(angle_ > 0)) return std::move(found_);
    for_each_face([&](const Corners& p, const Vec3& twice_area, std::int64_t face) {
      face_ = face;
      const double area = norm(twice_area) / 2;
      add(p, area, twice_area / (2 * area), 0);
    });
    return std::move(found_);
  }

 private:
  template <typename Function>
  void for_each_face(const Function& function) const {
    CancelPoll poll;
    for (std::size_t t = 0; t < mesh_.n_faces; ++t) {
      poll();
      const Triangle triangle = mesh_.triangle(t);
      Corners p;
      for (int i = 0; i < 3; ++i) p[i] = found_.scale * (mesh_.vertex(triangle[i]) - center_);
      const FaceNormal normal = face_normal(p);
      if (normal.degenerate || !(norm(normal.twice_area) > 0)) continue;
      function(p, normal.twice_area, static_cast<std::int64_t>(t));
    }
  }

  // Returns the part of the n points that a piece should have.
  double share(const Corners& p, double area) const {
    return n_ / 2 * (area / area_ + solid_angle(p) / angle_);
  }

  void add(const Corners& p, double area, const Vec3& normal, int halvings) {
    const double points = share(p, area);
    if (points > kSame && halvings < kMostHalvings) {
      int longest = 0;
      for (int i = 1; i < 3; ++i) {
        if (edge2(p, i) > kSame * edge2(p, longest)) longest = i;
      }
      const Vec3 &a = p[longest], &b = p[(longest + 1) % 3], &c = p[(longest + 2) % 3];
      const Vec3 middle = (a + b) / 2;
      add({a, middle, c}, area / 2, normal, halvings + 1);
      add({middle, b, c}, area / 2, normal, halvings + 1);
    } else {
      add_by_chance(p, area, normal, points);
    }
  }
  static double edge2(const Corners& p, int i) {
    const Vec3 e = p[(i + 1) % 3] - p[i];
    return dot(e, e);
  }

  // Adds a random point of each piece: midpoints would miss the edges of faces, where errors are
  // largest. If there are too many pieces, adds one in each whole unit of the sum of shares.
  void add_by_chance(const Corners& p, double area, const Vec3& normal, double points) {
    sum_ += points;
    const auto next = static_cast<double>(taken_);
    if (!all_ && next + random_uniform(kSeed, 3 * taken_) >= sum_) return;
    const double s = std::sqrt(random_uniform(kSeed, 3 * taken_ + 1));
    const double b = s * random_uniform(kSeed, 3 * taken_ + 2);
    ++taken_;
    add_point((1 - s) * p[0] + b * p[1] + (s - b) * p[2], all_ ? area : area / points, normal);
  }

  void add_point(const Vec3& x, double area, const Vec3& normal) {
    const double r = norm(x);
    if (!(r > 0)) return;
    found_.directions.push_back(x / r);
    found_.radii.push_back(r);
    found_.cosines.push_back(std::abs(dot(normal, x)) / r);
    found_.areas.push_back(area);
    found_.faces.push_back(face_);
  }

  const MeshView& mesh_;
  Vec3 center_;
  double n_;
  bool all_;
  double area_ = 0, angle_ = 0, sum_ = 0;
  std::uint64_t taken_ = 0;
  std::int64_t face_ = 0;
  SurfacePieces found_;
};

}  // namespace

SurfacePieces surface_pieces(const MeshView& mesh, const Vec3& center, std::size_t n) {
  return Pieces(mesh, center, n).run();
}

}  // namespace rholm
