// An oracle for distances between a mesh of few faces and a model, computed from closest points.
// Distances are taken from points of the model to every triangle, and from points of the mesh to a
// dense triangulation of the model.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/random.h"
#include "rholm/coefficients.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "shape/points/point_tree.h"
#include "shape/queries/closest_point.h"

namespace rholm::test {

struct TrueDistance {
  double there_rms = 0, back_rms = 0, there_max = 0, back_max = 0;
  double there_error = 0, back_error = 0;  // relative standard errors of the root mean squares
  double rms() const { return std::max(there_rms, back_rms); }
  double max() const { return std::max(there_max, back_max); }
};

inline std::vector<Vec3> model_points(const Coefficients& c, const std::vector<Vec3>& directions) {
  const std::vector<double> r =
      evaluate(c, directions, {.precision = 1e-10}, {.threads = 1, .progress = {}});
  std::vector<Vec3> points(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) points[i] = r[i] * directions[i];
  return points;
}

// A weighted root mean square and its relative standard error, from the scatter of 20 parts. Part k
// has the points k, k + 20, k + 40, ...
struct WeightedMean {
  std::array<double, 20> squares = {}, weights = {};
  std::size_t n = 0;
  void add(double distance, double weight) {
    squares[n % 20] += weight * distance * distance;
    weights[n % 20] += weight;
    ++n;
  }
  double rms() const {
    double square = 0, weight = 0;
    for (std::size_t k = 0; k < 20; ++k) square += squares[k], weight += weights[k];
    return std::sqrt(square / weight);
  }
  double error() const {
    double weight = 0, sum = 0;
    for (const double w : weights) weight += w / 20;
    const double mean = rms() * rms();
    for (std::size_t k = 0; k < 20; ++k) {
      sum += std::pow((squares[k] - mean * weights[k]) / (weight * mean), 2);
    }
    return std::sqrt(sum / (20 * 19)) / 2;
  }
};

// The model as triangles with edges of 1/230: for waves of degree 64 the error is below 1 %. The
// triangles at the eight nearest vertices are compared. (Descent over directions alone ends in
// narrow valleys of steep models, where distances are 5 % too large.)
class ModelNet {
 public:
  explicit ModelNet(const Coefficients& c)
      : c_(c), points_(model_points(c, sphere().vertices)), tree_(points_) {}

  // Distances up to `trusted` are taken from the triangles; larger ones from the model itself.
  std::vector<double> distances(const std::vector<Vec3>& x, double trusted) const {
    std::vector<double> result;
    std::vector<Neighbor> found;
    for (const Vec3& from : x) {
      tree_.nearest(from, 8, found);
      double nearest = 1e300;
      for (const Neighbor& neighbor : found) {
        for (const std::uint32_t t : triangles_at()[tree_.order()[neighbor.index]]) {
          const Triangle& f = sphere().faces[t];
          const Vec3 to =
              closest_point_of_triangle(from, {points_[f[0]], points_[f[1]], points_[f[2]]});
          nearest = std::min(nearest, norm(from - to));
        }
      }
      if (nearest > trusted) nearest = downhill(from, tree_.order()[found.front().index]);
      result.push_back(nearest);
    }
    return result;
  }

 private:
  // Descends from a vertex to the point of the model nearest to x. The result is an upper bound.
  double downhill(const Vec3& x, std::size_t at) const {
    Vec3 u = sphere().vertices[at];
    double nearest = norm(x - points_[at]);
    for (double step = 0.01; step > 1e-9;) {
      const Vec3 e = normalized(cross(u, std::abs(u.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
      const Vec3 f = cross(u, e);
      std::vector<Vec3> around;
      for (int k = 0; k < 16; ++k) {
        const double angle = k * std::numbers::pi / 8;
        around.push_back(normalized(u + step * (std::cos(angle) * e + std::sin(angle) * f)));
      }
      const std::vector<Vec3> points = model_points(c_, around);
      bool nearer = false;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double distance = norm(x - points[k]);
        if (distance < nearest) nearest = distance, u = around[k], nearer = true;
      }
      if (!nearer) step /= 2;
    }
    return nearest;
  }
  static const Mesh& sphere() {
    static const Mesh mesh = icosphere(8);
    return mesh;
  }
  static const std::vector<std::vector<std::uint32_t>>& triangles_at() {
    static const std::vector<std::vector<std::uint32_t>> lists = [] {
      std::vector<std::vector<std::uint32_t>> at(sphere().vertices.size());
      for (std::uint32_t t = 0; t < sphere().faces.size(); ++t) {
        for (const std::uint32_t v : sphere().faces[t]) at[v].push_back(t);
      }
      return at;
    }();
    return lists;
  }
  const Coefficients& c_;
  std::vector<Vec3> points_;
  PointTree tree_;
};

// Compares `n` points on each surface. Points of the mesh are distributed by area; points of the
// model have equal solid angles and are weighted by area. The flat triangles of the model lie a
// little within it. Points of the mesh that are farther than `trusted` from the triangles are
// therefore compared with the model itself.
inline TrueDistance true_distance(const Mesh& mesh, const Coefficients& c, std::size_t n,
                                  double trusted = INFINITY) {
  const ModelNet net(c);
  std::vector<double> areas;
  double whole = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3& a = mesh.vertices[t[0]];
    areas.push_back(norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2);
    whole += areas.back();
  }
  std::vector<Vec3> x;
  std::vector<double> weights;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const auto count =
        static_cast<std::size_t>(std::ceil(static_cast<double>(n) * areas[t] / whole));
    for (std::size_t k = 0; k < count; ++k) {
      // Roberts' sequence of low discrepancy, folded into the triangle.
      double s = std::fmod(0.7548776662466927 * static_cast<double>(k + 1), 1.0);
      double v = std::fmod(0.5698402909980532 * static_cast<double>(k + 1), 1.0);
      if (s + v > 1) s = 1 - s, v = 1 - v;
      const Triangle& f = mesh.faces[t];
      x.push_back((1 - s - v) * mesh.vertices[f[0]] + s * mesh.vertices[f[1]] +
                  v * mesh.vertices[f[2]]);
      weights.push_back(areas[t] / static_cast<double>(count));
    }
  }
  TrueDistance result;
  WeightedMean there, back;
  const std::vector<double> distances = net.distances(x, trusted);
  for (std::size_t i = 0; i < x.size(); ++i) there.add(distances[i], weights[i]);
  const std::vector<double> at_vertices = net.distances(mesh.vertices, trusted);
  result.there_max = std::max(std::ranges::max(distances), std::ranges::max(at_vertices));

  std::vector<Vec3> u(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(n);
    const double phi = 2.399963229728653 * static_cast<double>(k), s = std::sqrt(1 - z * z);
    u[k] = {s * std::cos(phi), s * std::sin(phi), z};
  }
  const ValuesAndGradients model = evaluate_with_gradient(c, u, {.precision = 1e-10});
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 y = model.values[k] * u[k];
    double nearest = 1e300;
    for (const Triangle& t : mesh.faces) {
      const Vec3 to = closest_point_of_triangle(
          y, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
      nearest = std::min(nearest, norm(y - to));
    }
    const double r = std::abs(model.values[k]);
    back.add(nearest, r * std::hypot(r, norm(model.gradients[k])));
    result.back_max = std::max(result.back_max, nearest);
  }
  result.there_rms = there.rms();
  result.back_rms = back.rms();
  result.there_error = there.error();
  result.back_error = back.error();
  return result;
}

}  // namespace rholm::test
