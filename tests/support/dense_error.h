// A slow search for the largest radial error of an expansion. Errors are computed at dense points
// on each face and its edges, then at random steps uphill from the worst points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "rholm/coefficients.h"
#include "rholm/harmonic.h"
#include "rholm/mesh.h"

namespace rholm::test {

// A point of a face, given by the weights of the face's corners.
struct FacePoint {
  std::size_t face = 0;
  std::array<double, 3> weights = {};
};

inline std::vector<double> radial_errors(const Mesh& mesh, const Coefficients& c,
                                         const std::vector<FacePoint>& points) {
  std::vector<Vec3> directions;
  std::vector<double> errors;
  for (const FacePoint& p : points) {
    Vec3 x{};
    for (std::size_t k = 0; k < 3; ++k) {
      x = x + p.weights[k] * mesh.vertices[mesh.faces[p.face][k]];
    }
    errors.push_back(norm(x));
    directions.push_back(x / norm(x));
  }
  const std::vector<double> model = evaluate(c, directions);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::abs(errors[i] - model[i]);
  return errors;
}

// Returns the largest error about the origin. Edges of faces are divided into n parts; between the
// points the surface must be so smooth that climbing finds the maximum. `rounds`: number of steps.
inline double largest_error_of_dense_points(const Mesh& mesh, const Coefficients& c, int n,
                                            int rounds = 150) {
  std::vector<FacePoint> points;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
        points.push_back({t, {a, b, 1 - a - b}});
      }
    }
  }
  std::vector<double> errors = radial_errors(mesh, c, points);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t best = std::min<std::size_t>(200, points.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(best), order.end(),
                    [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  std::vector<FacePoint> at;
  std::vector<double> values;
  for (std::size_t k = 0; k < best; ++k) {
    at.push_back(points[order[k]]);
    values.push_back(errors[order[k]]);
  }
  std::vector<double> steps(best, 1.0 / n);
  std::uint64_t draw = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<FacePoint> trial = at;
    for (std::size_t k = 0; k < best; ++k) {
      // Every second step keeps weights of 0, so that a point on an edge moves along the edge.
      const bool along = round % 2 == 1;
      double sum = 0;
      for (double& w : trial[k].weights) {
        const double change = steps[k] * (2 * random_uniform(9, draw++) - 1);
        if (!along || w > 0) w = std::max(0.0, w + change);
        sum += w;
      }
      for (double& w : trial[k].weights) w /= sum;
    }
    const std::vector<double> found = radial_errors(mesh, c, trial);
    for (std::size_t k = 0; k < best; ++k) {
      if (found[k] > values[k]) {
        values[k] = found[k];
        at[k] = trial[k];
      } else {
        steps[k] *= 0.93;
      }
    }
  }
  return *std::max_element(values.begin(), values.end());
}

}  // namespace rholm::test
