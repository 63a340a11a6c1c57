#include "edit/texture/repeated_map.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace rholm {
namespace {

using std::numbers::pi;
using Heights = std::function<double(double, double)>;

DetailMap map_of(const Heights& heights) {
  DetailMap map = empty_map(1.1, 0.01);
  const double middle = (map.n - 1) / 2.0;
  for (int j = 0; j < map.n; ++j) {
    for (int i = 0; i < map.n; ++i) {
      const auto at = static_cast<std::size_t>(j * map.n + i);
      map.values[at] = heights((i - middle) * map.step, (j - middle) * map.step);
      map.weights[at] = 1;
    }
  }
  return map;
}

// Ten waves of lengths 0.15 ... 0.35; the mean square of their sum is 1 / 2.
Heights random_texture(std::uint64_t seed) {
  return [seed](double p, double q) {
    double sum = 0;
    for (std::uint64_t k = 0; k < 10; ++k) {
      const double angle = 2 * pi * random_uniform(seed, 3 * k);
      const double wave = 0.15 + 0.2 * random_uniform(seed, 3 * k + 1);
      sum += std::cos(
          2 * pi *
          ((p * std::cos(angle) + q * std::sin(angle)) / wave + random_uniform(seed, 3 * k + 2)));
    }
    return sum / std::sqrt(10.0);
  };
}

// Calls visit(p, q) on an area that contains several cells of any lattice.
template <class Visit>
void over_the_plane(const Visit& visit) {
  for (double q = -2; q < 2; q += 0.037) {
    for (double p = -2; p < 2; p += 0.037) visit(p, q);
  }
}

// A periodic texture has perfect seams, except for the resolution of the search for shifts. This is
// a thousandth of the radius per tile; two tiles away, it is 6 % for waves of 0.2.
TEST(RepeatedMap, what_repeats_by_itself_goes_on_as_if_it_had_no_end) {
  const Heights stripes = [](double p, double q) {
    return std::cos(2 * pi * (0.8 * p + 0.6 * q) / 0.23 + 0.4);
  };
  const Heights bumps = [](double p, double q) {
    return std::cos(2 * pi * p / 0.29 + 1) + std::cos(2 * pi * (0.4 * p + 0.9 * q) / 0.25);
  };
  for (const Heights& heights : {stripes, bumps}) {
    const RepeatedMap repeated = repeat(map_of(heights));
    double error = 0, wanted = 0;
    over_the_plane([&](double p, double q) {
      error += std::pow(repeated({p, q}) - heights(p, q), 2);
      wanted += std::pow(heights(p, q), 2);
    });
    EXPECT_LT(std::sqrt(error / wanted), 0.06);
  }
}

// The mean of two different heights would have 0.71 of the rms; fades cover a sixth of the plane.
TEST(RepeatedMap, random_texture_stays_as_high) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Heights heights = random_texture(seed);
    const RepeatedMap repeated = repeat(map_of(heights));
    double after = 0, before = 0, n_after = 0, n_before = 0;
    over_the_plane([&](double p, double q) {
      after += std::pow(repeated({p, q}), 2), ++n_after;
      if (std::hypot(p, q) < 1) before += std::pow(heights(p, q), 2), ++n_before;
    });
    EXPECT_NEAR(std::sqrt(after / n_after), std::sqrt(before / n_before),
                0.1 * std::sqrt(before / n_before))
        << seed;
  }
}

// Seams of a cell of 1.8 are 3 long and fade over a tenth: at most a sixth of all heights are a mix
// of copies. If whole overlaps faded, half of all heights would be a mix.
TEST(RepeatedMap, nearly_everywhere_there_is_one_copy_and_no_double) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Heights heights = random_texture(seed);
    const RepeatedMap repeated = repeat(map_of(heights));
    const auto [a, b] = repeated.lattice;
    double mixed = 0, all = 0;
    over_the_plane([&](double p, double q) {
      double least = 10;
      for (int j = -3; j <= 3; ++j) {
        for (int i = -3; i <= 3; ++i) {
          const double x = p - i * a.p - j * b.p, y = q - i * a.q - j * b.q;
          if (std::hypot(x, y) > 1) continue;
          least = std::min(least, std::abs(repeated({p, q}) - heights(x, y)));
        }
      }
      mixed += least > 0.05 ? 1 : 0;
      ++all;
    });
    EXPECT_LT(mixed / all, 1 / 6.) << seed;
  }
}

// Isolated bumps (1 - r^2 / w^2)^3 are steepest at r^2 = w^2 / 5, with the slope 1.717 / w. A seam
// through a bump would be a step of 1 over a tenth. This is a slope of 20 at the steepest part of
// the fade, in addition to the bump's slope. The gaps between bumps of a copy are 0.15 wide.
TEST(RepeatedMap, seams_go_around_what_stands_alone) {
  constexpr double kWidth = 0.1;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Heights bumps = [&](double p, double q) {
      const double i = std::round(p / 0.45), j = std::round(q / 0.45);
      const auto k = static_cast<std::uint64_t>(100 * (i + 5) + j + 5);
      const double x = p - 0.45 * i - 0.1 * (random_uniform(seed, 2 * k) - 0.5);
      const double y = q - 0.45 * j - 0.1 * (random_uniform(seed, 2 * k + 1) - 0.5);
      const double rest = std::max(0.0, 1 - (x * x + y * y) / (kWidth * kWidth));
      return rest * rest * rest;
    };
    const RepeatedMap repeated = repeat(map_of(bumps));
    double steepest = 0;
    constexpr double kStep = 1e-3;
    over_the_plane([&](double p, double q) {
      const double here = repeated({p, q});
      steepest = std::max(
          steepest,
          std::hypot(repeated({p + kStep, q}) - here, repeated({p, q + kStep}) - here) / kStep);
    });
    EXPECT_LT(steepest, 1.1 * 1.717 / kWidth) << seed;
  }
}

// Heights are at most sqrt(10). A fade over at least a tenth, whose steepest slope is twice its
// mean, adds 2 * 2 sqrt(10) / 0.1. The texture's own slope is at most sqrt(10) 2 pi / 0.15.
TEST(RepeatedMap, heights_and_slopes_are_continuous_across_seams_and_cells) {
  const RepeatedMap repeated = repeat(map_of(random_texture(3)));
  const double steepest = std::sqrt(10.0) * (4 / 0.1 + 2 * pi / 0.15);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 200000; ++k) {
    const double p = -1.5 + 1.5e-5 * k, q = 0.3 - 0.4 * p;
    const double before = repeated({p - kStep, q}), at = repeated({p, q});
    const double after = repeated({p + kStep, q});
    ASSERT_LT(std::abs(after - at), kStep * steepest);
    // A crease would give a difference of the order of the slope.
    ASSERT_LT(std::abs(after - 2 * at + before), 1e-3 * kStep * steepest);
  }
}

TEST(RepeatedMap, repeats_by_its_lattice) {
  const RepeatedMap repeated = repeat(map_of(random_texture(2)));
  const auto [a, b] = repeated.lattice;
  over_the_plane([&](double p, double q) {
    EXPECT_NEAR(repeated({p, q}), repeated({p + 3 * a.p - b.p, q + 3 * a.q - b.q}), 1e-9);
  });
}

TEST(RepeatedMap, nothing_is_repeated_as_nothing) {
  const RepeatedMap repeated = repeat(map_of([](double, double) { return 0; }));
  over_the_plane([&](double p, double q) { EXPECT_EQ(repeated({p, q}), 0); });
}

}  // namespace
}  // namespace rholm
