#include "transform/error/distance_check.h"

#include <cmath>
#include <numbers>

namespace rholm {
namespace {

constexpr std::size_t kCoarse = 100, kMostFaces = 2'000'000;
constexpr double kFarApart = 1e3;

// Errors below this part of the diagonal are the rounding of distances (chosen).
constexpr double kRounding = 1e-11;

}  // namespace

bool is_coarse(const MeshView& mesh) { return mesh.n_faces <= kCoarse; }

bool may_be_refined(const MeshView& mesh, const Expansion& expansion, double largest_radial_error,
                    double diagonal) {
  const double mean = std::abs(expansion.coefficients.c(0, 0)) / std::sqrt(4 * std::numbers::pi);
  const double radius = expansion.function == RadialFunction::kGauge ? 1 / mean : mean;
  return mesh.n_faces <= kMostFaces && largest_radial_error < kFarApart * diagonal &&
         largest_radial_error > kRounding * diagonal && kFarApart * radius > diagonal;
}

}  // namespace rholm
