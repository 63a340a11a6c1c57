#include "report/picture/balls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "rholm/topology.h"
#include "shape/points/point_tree.h"

namespace rholm {
namespace {

constexpr std::size_t kProbes = 1000;  // points that are asked; the median is good to some 2 %
constexpr std::size_t kNeighbors = 8;  // of each, as a square on a grid has
// Of the diagonal: few points stay points. Chosen by eye.
constexpr double kLargest = 0.03;

}  // namespace

double ball_radius(const std::vector<Vec3>& points, const Context& context) {
  const double diagonal = bounds(points).diagonal();
  const double largest = diagonal > 0 ? kLargest * diagonal : kLargest;
  if (points.size() < 2) return largest;
  const PointTree tree(points, context);
  const std::size_t n = tree.size(), probes = std::min(n, kProbes);
  const std::size_t k = std::min(kNeighbors, n - 1);
  std::vector<double> distances;
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < probes; ++i) {
    tree.nearest_to(i * n / probes, k + 1, near);  // with itself
    distances.push_back(std::sqrt(static_cast<double>(near.back().distance2)));
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(probes / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  // k points within a disc of that radius have pi r^2 / k each, the square of their distance.
  // Balls of that radius leave exp(-pi), 4 %, of a surface uncovered by random points.
  const double spacing = *middle * std::sqrt(std::numbers::pi / static_cast<double>(k));
  return spacing > 0 ? std::min(spacing, largest) : largest;
}

}  // namespace rholm
