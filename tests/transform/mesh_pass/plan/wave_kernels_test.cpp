#include "transform/mesh_pass/plan/wave_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

// Phases of up to 16384 are rounded by some 2^-53 of that.
TEST(wave_kernels, are_cosine_and_sine_of_the_phase) {
  test::for_each_target([](const char* target) {
    for (std::size_t n = 1; n <= 33; ++n) {
      const double length = n % 4 == 0 ? 0 : n % 4 == 1 ? 1 : n % 4 == 2 ? 480 : 16384;
      const std::vector<double> nothing(40, std::nan(""));
      std::vector<double> x(40, 1), y(40, 1), z(40, 1), cosine = nothing, sine = nothing;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 at = test::random_in(0.1, 10, 1, i) * test::random_direction(2, i);
        x[i] = at.x, y[i] = at.y, z[i] = at.z;
      }
      const Vec3 k = length * test::random_direction(3, 0);
      wave_values(k, n, x.data(), y.data(), z.data(), cosine.data(), sine.data());
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 at = {x[i], y[i], z[i]};
        const double phase = dot(k, at) / norm(at), rounding = 1e-15 * (4 + length);
        EXPECT_NEAR(cosine[i], std::cos(phase), rounding) << target;
        EXPECT_NEAR(sine[i], std::sin(phase), rounding) << target;
      }
    }
  });
}

}  // namespace
}  // namespace rholm
