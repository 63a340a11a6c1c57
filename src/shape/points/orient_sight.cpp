#include "shape/points/orient_sight.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape/points/orient_graph.h"

namespace rholm {
namespace {

// Cosine of the angle between a normal and the line of sight, below which neighbours decide the
// sign. Normals of exact points are off by less than these six degrees, most of noisy points too.
constexpr float kGlancing = 0.1f;

}  // namespace

OrientSigns turn_by_sight(std::span<const Vec3> points, const LocalFits& fits,
                          std::span<const Vec3> sensors, bool from_inside) {
  OrientSigns signs{.normals = fits.normals};
  const std::size_t n = signs.normals.size();
  signs.agreement.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 away = normalized(points[i] - sensors[i]);
    const double cosine = dot(signs.normals[i], from_inside ? away : -away);
    if (cosine < 0) signs.normals[i] = -signs.normals[i];
    signs.agreement[i] = static_cast<float>(std::abs(cosine));
  }
  return signs;
}

void turn_glancing(std::span<const Vec3> points, const LocalFits& fits, OrientSigns& signs) {
  const std::vector<Vec3> seen = signs.normals;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!(signs.agreement[i] < kGlancing)) continue;
    double sum = 0;
    for (std::size_t k = 0; k < kGraphNeighbors; ++k) {
      const std::uint32_t j = fits.neighbors[i * kGraphNeighbors + k];
      if (signs.agreement[j] < kGlancing) continue;
      sum += agreement(points[i], seen[i], points[j], seen[j], 0);
    }
    if (sum < 0) signs.normals[i] = -seen[i];
  }
}

}  // namespace rholm
