// A tolerance of the distance holds on steep and coarse polyhedra, as measured by closest points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/random.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "support/star_polyhedra.h"
#include "support/true_distance.h"

namespace rholm {
namespace {

struct Draw {
  Mesh mesh;
  Tolerance tolerance;
};

// Bodies have 4 to 100 faces. Half of the centres are at 80 to 95 % of the way to where a face
// would be seen edge-on.
Draw draw(std::uint64_t seed) {
  const auto random = [&](std::uint64_t i) { return random_uniform(9000 + seed, i); };
  const double faces = std::exp(std::log(4.0) + random(0) * std::log(25.0));
  const auto extra = static_cast<std::size_t>(std::clamp((faces - 4) / 2, 0.0, 48.0));
  const double offset = random(1) < 0.5 ? 0.7 * random(2) : 0.8 + 0.15 * random(2);
  Draw d;
  d.mesh = test::star_polyhedron(extra, random(3) < 0.5 ? 0 : 0.2 * random(4), offset, seed);
  d.tolerance = {.error = 0.002 * std::exp(random(5) * std::log(25.0)),
                 .unit = ToleranceUnit::kDiagonal,
                 .norm = random(6) < 0.5 ? ErrorNorm::kRms : ErrorNorm::kMax,
                 .measure = ErrorMeasure::kDistance,
                 .max_degree = 64};
  return d;
}

bool is_star(const Mesh& mesh) {
  for (const Triangle& t : mesh.faces) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 normal = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    if (!(dot(normal, a) > 1e-3 * norm(normal))) return false;
  }
  return true;
}

TEST(distance_tolerance, is_kept_by_closest_points_on_random_polyhedra) {
  const char* wanted = std::getenv("RHOLM_POLYHEDRA");
  const int count = wanted != nullptr ? static_cast<int>(std::strtol(wanted, nullptr, 10)) : 500;
  int met = 0, unreached = 0, above = 0;
  double worst_rms = 0, worst_max = 0;
  for (std::uint64_t seed = 1; met + unreached < count; ++seed) {
    const Draw d = draw(seed);
    if (!is_star(d.mesh)) continue;
    const StarChart chart =
        make_star_chart(d.mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
    const ToleranceTransform found = expand(chart, d.tolerance, {}, {.threads = 1, .progress = {}});
    if (!found.met) {
      ++unreached;
      EXPECT_EQ(found.transform.expansion.coefficients.degree(), d.tolerance.max_degree);
      continue;
    }
    ++met;
    const Coefficients& c = found.transform.expansion.coefficients;
    const auto error = [&](const test::TrueDistance& truth) {
      return d.tolerance.norm == ErrorNorm::kRms ? truth.rms() : truth.max();
    };
    const double trusted = d.tolerance.norm == ErrorNorm::kMax ? found.allowed : INFINITY;
    test::TrueDistance truth = test::true_distance(d.mesh, c, 6000, trusted);
    // Near the bound, the error of few points is too uncertain.
    if (error(truth) > 0.99 * found.allowed) {
      truth = test::true_distance(d.mesh, c, 60'000, trusted);
    }
    if (d.tolerance.norm == ErrorNorm::kRms) {
      const double there = truth.there_rms / found.allowed, back = truth.back_rms / found.allowed;
      // The bound allows for both samplings: 4 standard errors in 500 runs.
      EXPECT_LE(there, 1.003 + 4 * truth.there_error) << seed;
      EXPECT_LE(back, 1.003 + 4 * truth.back_error) << seed;
      worst_rms = std::max({worst_rms, there, back});
      above += std::max(there, back) > 1;
    } else {
      const double ratio = truth.max() / found.allowed;
      if (ratio > 1) {
        std::printf("seed %d: there %.6f, back %.6f\n", static_cast<int>(seed),
                    truth.there_max / found.allowed, truth.back_max / found.allowed);
      }
      EXPECT_LE(ratio, 1.001) << seed;
      worst_max = std::max(worst_max, ratio);
      above += ratio > 1;
    }
  }
  std::printf("%d met, %d unreached; %d above 1; worst rms %.4f, worst max %.4f\n", met, unreached,
              above, worst_rms, worst_max);
  EXPECT_GT(met, count / 3);
}

}  // namespace
}  // namespace rholm
