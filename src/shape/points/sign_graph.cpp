#include "shape/points/sign_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "shape/points/orient_graph.h"

namespace rholm {
namespace {

// Cosine of 45 degrees, which allows for noise of normals and for curvature.
constexpr double kSure = 0.7;
// Largest height of one end above the other, in edge lengths (chosen). The longest edges have two
// spacings: single edges detect walls 0.4 spacings apart, means over many edges nearer walls.
constexpr double kLevel = 0.2;
// Number of points from which the scatter is computed.
constexpr std::size_t kSeeds = 2000;
// Cosine of 37 degrees: two faces that meet at an obtuse angle of 143 degrees (chosen).
constexpr double kCrease = 0.8;

}  // namespace

SignGraph::SignGraph(std::vector<std::uint32_t> neighbors, std::span<const Vec3> points,
                     std::span<const Vec3> normals, std::span<const std::uint8_t> foreign,
                     const Context& context)
    : points_(points),
      normals_(normals),
      neighbors_(std::move(neighbors)),
      edges_(neighbors_.size()),
      scatter_(find_scatter()) {
  const double slack = kNoiseOfScatter * scatter_;
  parallel_for(points.size(), 1024, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!foreign.empty() && foreign[i] != 0) continue;
      for (std::size_t e = i * kGraphNeighbors; e < (i + 1) * kGraphNeighbors; ++e) {
        edges_[e] = look(e, slack);
      }
    }
  });
}

bool SignGraph::is_crease(std::size_t e) const {
  return std::abs(dot(normals_[from(e)], normals_[to(e)])) < kCrease;
}

double SignGraph::agreement_at(std::size_t e) const {
  const std::uint32_t i = from(e), j = to(e);
  return agreement(points_[i], normals_[i], points_[j], normals_[j], 0);
}

double SignGraph::height_over(std::size_t e, const Vec3& normal) const {
  return dot(points_[to(e)] - points_[from(e)], normal);
}

double SignGraph::find_scatter() const {
  const std::size_t n = points_.size(), seeds = std::min(n, kSeeds);
  std::vector<double> heights;
  heights.reserve(seeds * kGraphNeighbors);
  for (std::size_t s = 0; s < seeds; ++s) {
    const std::size_t i = s * n / seeds;
    for (std::size_t e = i * kGraphNeighbors; e < (i + 1) * kGraphNeighbors; ++e) {
      if (to(e) != i) heights.push_back(std::abs(height_over(e, normals_[i])));
    }
  }
  if (heights.empty()) return 0;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

SignEdge SignGraph::look(std::size_t e, double slack) const {
  const std::uint32_t i = from(e), j = to(e);
  if (i == j) return {};
  const double agreed = agreement(points_[i], normals_[i], points_[j], normals_[j], slack);
  if (std::abs(agreed) < kSure) return {};
  const double length = norm(points_[j] - points_[i]);
  if (!(length > 0)) return {};
  const Vec3 across = normals_[j] + (agreed < 0 ? -1.0 : 1.0) * normals_[i];
  const double height = height_over(e, across) / 2;
  if (std::abs(height) > slack + kLevel * length) return {};
  return {agreed < 0 ? Says::kContradict : Says::kAgree, static_cast<float>(height / length)};
}

}  // namespace rholm
