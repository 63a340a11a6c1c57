#include "rholm/monte_carlo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "harmonic/legendre/legendre_pairs.h"
#include "paper/monte_carlo/moments.h"
#include "paper/monte_carlo/samplers.h"
#include "paper/monte_carlo/spherical_triangle.h"
#include "rholm/error.h"
#include "support/oracle.h"
#include "support/random_data.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using test::chart_about;
using test::oracle_coefficients;
using test::relative_error;

constexpr std::array kPlaces = {SamplePlaces::kEdges, SamplePlaces::kTriangles};
const Context kOneThread = {.threads = 1, .progress = {}};

StarChart octahedron(std::uint64_t seed = 1) {
  return chart_about(test::random_octahedron(seed), {0, 0, 0});
}

struct Trial {
  const char* name;
  StarChart chart;
};

// Poles lie on corners, inside faces, on edges and next to them; a face is seen edge-on.
std::vector<Trial> trials() {
  return {
      {"octahedron", octahedron()},
      {"box, poles inside faces", chart_about(box({2, 2, 2}), {0.1, 0.05, 0})},
      {"box, poles on diagonals", chart_about(box({2, 2, 2}), {0, 0, 0})},
      {"box, poles next to diagonals", chart_about(box({2, 2, 2}), {1e-6, -2e-6, 0})},
      {"box, near a face", chart_about(box({2, 2, 2}), {0.3, 0.9, -0.4})},
      {"turned bumpy sphere", chart_about(test::rotated(bumpy_sphere(1, 0.3)), {0.1, -0.2, 0.15})}};
}

Coefficients exact(const StarChart& chart, int degree) {
  return oracle_coefficients(chart.mesh, degree, RadialFunction::kRadius, 80);
}

// Calls visit(i) for every coefficient that exists: not for m > l, nor for S_l0.
template <typename Visit>
void for_each_coefficient(const Coefficients& f, const Visit& visit) {
  const std::size_t orders = f.degree() + std::size_t{1}, plane = orders * orders;
  for (std::size_t l = 0; l < orders; ++l) {
    for (std::size_t m = 0; m <= l; ++m) {
      visit(l * orders + m);
      if (m > 0) visit(plane + l * orders + m);
    }
  }
}

TEST(monte_carlo_edge, the_field_integrates_to_the_coefficients_wherever_it_starts) {
  const int degree = 8;
  for (const Trial& trial : trials()) {
    const StarGeometry geometry = star_geometry(trial.chart);
    const Coefficients expected = exact(trial.chart, degree);
    for (const FieldStart start : {FieldStart::kNormal, FieldStart::kFace}) {
      // Midpoints of n equal intervals: where the field jumps, the error is of first order.
      const int n = 4000;
      Sampler sampler = edge_sampler(geometry, 1, start);
      const FieldEdges field = field_edges(geometry);
      sampler.draw = [&](std::size_t place, std::size_t sample, SampleScratch& scratch) {
        return field_at(field, field.edges[place], (static_cast<double>(sample) + 0.5) / n, start,
                        scratch.terms, scratch.field);
      };
      Moments moments(degree);
      StageTimes times;
      add_samples(sampler.draw, sampler.places, n, moments, times, {}, {});
      Coefficients found = mean_of(moments);
      for (double& value : found.values()) value /= geometry.scale;
      EXPECT_LT(relative_error(found, expected), 5e-4) << trial.name;
      EXPECT_NEAR(found.c(0, 0) / expected.c(0, 0), 1, 5e-4) << trial.name;
    }
  }
}

TEST(monte_carlo_triangle, points_are_uniform_on_large_and_on_tiny_triangles) {
  // The mean of u over a spherical triangle is half the sum of angle times edge normal, divided by
  // the solid angle.
  for (const double size : {1.0, 1e-3, 1e-6}) {
    const std::array<Vec3, 3> p = {Vec3{1, -0.7 * size, 0.3 * size}, Vec3{1, 1.1 * size, 0},
                                   Vec3{1, 0.2 * size, 0.9 * size}};
    const double omega = solid_angle(p);
    const SphericalTriangle triangle = spherical_triangle(p, omega);
    const Vec3 middle = normalized(p[0] + p[1] + p[2]);
    const int n = 300;
    Vec3 sum;  // sum of u - middle, which keeps the digits of tiny triangles
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const Vec3 u = uniform_direction(triangle, (i + 0.5) / n, (k + 0.5) / n);
        for (int side = 0; side < 3; ++side) {
          EXPECT_GT(dot(u, cross(p[side], p[(side + 1) % 3])), -1e-9 * size * size);
        }
        sum += u - middle;
      }
    }
    // The expected mean is integrated over the flat triangle, dOmega = d dS / |x|^3, with other
    // nodes.
    const GaussRule rule = gauss_legendre(20);
    Vec3 expected;
    double total = 0;
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t k = 0; k < 20; ++k) {
        const double s = (1 + rule.nodes[i]) / 2, v = (1 + rule.nodes[k]) / 2;
        const Vec3 x = p[0] + s * ((1 - v) * p[1] + v * p[2] - p[0]);
        const double r = norm(x), weight = s * rule.weights[i] * rule.weights[k] / (r * r * r);
        expected += weight * (x / r - middle);
        total += weight;
      }
    }
    // The error of midpoints falls with n^-2, and 1 / n^2 = 1.1e-5.
    EXPECT_LT(norm(sum / (n * n) - expected / total), 1e-4 * size) << size;
  }
}

TEST(monte_carlo, the_mean_over_seeds_is_the_coefficient) {
  const int degree = 4, seeds = 400;
  for (const Trial& trial : trials()) {
    const Coefficients expected = exact(trial.chart, degree);
    for (const SamplePlaces places : kPlaces) {
      std::vector<double> sum(expected.values().size()), square(sum.size());
      for (int seed = 1; seed <= seeds; ++seed) {
        const MonteCarlo run = monte_carlo(trial.chart,
                                           {.degree = degree,
                                            .places = places,
                                            .seed = static_cast<std::uint64_t>(seed),
                                            .samples = 4},
                                           kOneThread);
        for (std::size_t i = 0; i < sum.size(); ++i) {
          const double error = run.expansion.coefficients.values()[i] - expected.values()[i];
          sum[i] += error;
          square[i] += error * error;
        }
      }
      // 25 coefficients, six shapes and two kinds of places: by chance one of 500 tests exceeds 4.5
      // sigma.
      for_each_coefficient(expected, [&](std::size_t i) {
        EXPECT_LT(std::abs(sum[i]), 4.5 * std::sqrt(square[i]) + 1e-12)
            << trial.name << ' ' << to_string(places) << ' ' << i;
      });
    }
  }
}

// Returns the root mean square of error_of(run) over seeds.
template <typename Function>
double over_seeds(const StarChart& chart, MonteCarloOptions options, int seeds,
                  const Function& error_of) {
  double sum = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed);
    const double error = error_of(monte_carlo(chart, options, kOneThread));
    sum += error * error;
  }
  return std::sqrt(sum / seeds);
}

TEST(monte_carlo, the_error_falls_with_the_root_of_the_samples_nightly) {
  const int degree = 6;
  const StarChart chart = octahedron();
  const Coefficients expected = exact(chart, degree);
  for (const SamplePlaces places : kPlaces) {
    // Fits a line by least squares through 2, 8, 32, 128 and 512 samples.
    double slope = 0, steps = 0;
    for (int step = -2; step <= 2; ++step) {
      const double error = over_seeds(
          chart,
          {.degree = degree, .places = places, .samples = std::size_t{32} << (2 * step + 4) >> 4},
          step < 1 ? 800 : 300, [&](const MonteCarlo& run) {
            return relative_error(run.expansion.coefficients, expected);
          });
      slope += step * std::log(error);
      steps += step * step * std::log(4.0);
    }
    EXPECT_NEAR(slope / steps, -0.5, 0.03) << to_string(places);
  }
}

TEST(monte_carlo, three_deviations_hold_the_error_as_often_as_they_should) {
  const int degree = 6, seeds = 1000;
  for (const std::uint64_t shape : {1, 2}) {
    const StarChart chart = octahedron(shape);
    const Coefficients expected = exact(chart, degree);
    for (const SamplePlaces places : kPlaces) {
      for (const std::size_t samples : {2, 4, 32}) {
        std::vector<int> held(expected.values().size(), 0);
        for (int seed = 1; seed <= seeds; ++seed) {
          const MonteCarlo run = monte_carlo(chart,
                                             {.degree = degree,
                                              .places = places,
                                              .seed = static_cast<std::uint64_t>(seed),
                                              .samples = samples},
                                             kOneThread);
          for (std::size_t i = 0; i < held.size(); ++i) {
            const double error = run.expansion.coefficients.values()[i] - expected.values()[i];
            held[i] += std::abs(error) <= 3 * run.deviation.values()[i];
          }
        }
        double all = 0, coefficients = 0;
        int least = seeds;
        for_each_coefficient(expected, [&](std::size_t i) {
          all += held[i];
          coefficients += 1;
          least = std::min(least, held[i]);
        });
        const double share = all / (coefficients * seeds);
        EXPECT_GT(share, 0.99) << to_string(places) << ' ' << samples;
        EXPECT_LT(share, 0.999) << to_string(places) << ' ' << samples;
        // Each coefficient by itself: of 1000 trials, 0.9973 hold, with a deviation of 1.6 trials.
        EXPECT_GE(least, 985) << to_string(places) << ' ' << samples;
      }
    }
  }
}

TEST(monte_carlo, the_relative_deviation_is_the_size_of_the_error_nightly) {
  const int degree = 4;
  const StarChart chart = octahedron();
  const Coefficients expected = exact(chart, degree);
  for (const SamplePlaces places : kPlaces) {
    const MonteCarloOptions options = {.degree = degree, .places = places, .samples = 1024};
    const double error = over_seeds(chart, options, 100, [&](const MonteCarlo& run) {
      return relative_error(run.expansion.coefficients, expected);
    });
    const double said = over_seeds(chart, options, 100,
                                   [](const MonteCarlo& run) { return *run.relative_deviation; });
    // 24 correlated coefficients of 100 seeds: rms of about 1000 values, 1 / sqrt(2000) = 2 %.
    EXPECT_NEAR(said / error, 1, 0.07) << to_string(places);
  }
}

// Returns the error of a degree, over its 2l + 1 coefficients.
double error_of_degree(const Coefficients& found, const Coefficients& expected, int l) {
  double sum = 0;
  for (int m = 0; m <= l; ++m) {
    sum += std::pow(found.c(l, m) - expected.c(l, m), 2) +
           std::pow(found.s(l, m) - expected.s(l, m), 2);
  }
  return std::sqrt(sum);
}

TEST(monte_carlo, the_deviation_of_a_degree_is_that_of_all_its_coefficients_nightly) {
  const int degree = 5;
  const StarChart chart = octahedron();
  const Coefficients expected = exact(chart, degree);
  for (const SamplePlaces places : kPlaces) {
    const MonteCarloOptions options = {.degree = degree, .places = places, .samples = 64};
    for (int l = 1; l <= degree; ++l) {
      const double error = over_seeds(chart, options, 200, [&](const MonteCarlo& run) {
        return error_of_degree(run.expansion.coefficients, expected, l);
      });
      const double said = over_seeds(chart, options, 200, [&](const MonteCarlo& run) {
        return run.degree_deviation[static_cast<std::size_t>(l)];
      });
      // 200 sums of at least 3 squares scatter by 1 / sqrt(1200) = 3 %. The error of one
      // coefficient would be 1 / sqrt(2l + 1) of the error of the degree.
      EXPECT_NEAR(said / error, 1, 0.12) << to_string(places) << ' ' << l;
    }
  }
}

// On 12 faces with 4 points each the true deviation of degree 4 is 1.9 and 3.2 (measured).
TEST(monte_carlo, a_relative_deviation_of_few_points_is_not_given) {
  const StarChart chart = chart_about(box({2, 1.6, 1.2}), {0.1, 0.05, 0});
  for (const SamplePlaces places : kPlaces) {
    int given = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const MonteCarlo run = monte_carlo(
          chart, {.degree = 4, .places = places, .seed = seed, .samples = 4}, kOneThread);
      EXPECT_LE(run.relative_deviation.value_or(0), 0.5);
      given += run.relative_deviation.has_value();
    }
    EXPECT_LE(given, 5) << to_string(places);
  }
}

// Above degree 1 a box has a larger rest than the scatter of many samples.
TEST(monte_carlo, the_truncation_error_is_none_or_within_its_doubt) {
  const StarChart chart = chart_about(box({2, 1.6, 1.2}), {});
  const Analysis expected =
      analyze(chart, {.degree = 1, .engine = Engine::kDirect, .precision = 1e-13});
  for (const SamplePlaces places : kPlaces) {
    int given = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      for (const std::size_t samples : {4, 4096}) {
        const MonteCarlo run = monte_carlo(
            chart, {.degree = 1, .places = places, .seed = seed, .samples = samples}, kOneThread);
        ASSERT_EQ(run.truncation_rms.has_value(), run.truncation_rms_doubt.has_value());
        if (!run.truncation_rms) continue;
        if (samples == 4096) ++given;
        EXPECT_NEAR(*run.truncation_rms, *expected.truncation_rms, *run.truncation_rms_doubt);
        EXPECT_LT(*run.truncation_rms_doubt, *run.truncation_rms / 7);
      }
    }
    // Points on edges scatter three times as much (measured).
    if (places == SamplePlaces::kTriangles) {
      EXPECT_GT(given, 15);
    }
  }
}

TEST(monte_carlo, samples_are_added_until_the_wanted_deviation_is_reached) {
  const StarChart chart = octahedron();
  for (const SamplePlaces places : kPlaces) {
    for (const double wanted : {0.8, 0.2, 0.04}) {
      const MonteCarlo run = monte_carlo(
          chart, {.degree = 4, .places = places, .deviation = wanted, .most_samples = 1 << 20});
      EXPECT_TRUE(run.reached);
      ASSERT_TRUE(run.relative_deviation);
      EXPECT_LE(*run.relative_deviation, wanted);
      // The result is not far below the wanted deviation: 0.6 of it means three times the work.
      // Deviations above 1/2 need more points before they are meaningful.
      EXPECT_GT(*run.relative_deviation, wanted < 0.5 ? 0.6 * wanted : 0);
      EXPECT_LE(run.rounds, 6);
    }
    const MonteCarlo stopped =
        monte_carlo(chart, {.degree = 4, .places = places, .deviation = 1e-6, .most_samples = 7});
    EXPECT_FALSE(stopped.reached);
    EXPECT_EQ(stopped.samples, 8u);
  }
}

TEST(monte_carlo, same_seed_same_bits_for_every_number_of_threads) {
  const StarChart chart = chart_about(bumpy_sphere(2, 0.3), {0.1, 0, 0});
  for (const SamplePlaces places : kPlaces) {
    const MonteCarloOptions options = {.degree = 20, .places = places, .samples = 6};
    const MonteCarlo one = monte_carlo(chart, options, kOneThread);
    for (const int threads : {2, 4}) {
      const MonteCarlo more = monte_carlo(chart, options, {.threads = threads, .progress = {}});
      EXPECT_TRUE(std::ranges::equal(one.expansion.coefficients.values(),
                                     more.expansion.coefficients.values()));
      EXPECT_TRUE(std::ranges::equal(one.deviation.values(), more.deviation.values()));
    }
    MonteCarloOptions other = options;
    other.seed = 2;
    EXPECT_FALSE(
        std::ranges::equal(one.expansion.coefficients.values(),
                           monte_carlo(chart, other, kOneThread).expansion.coefficients.values()));
  }
}

TEST(monte_carlo, lengths_scale_and_an_odd_number_of_samples_is_taken_as_the_next_even_one) {
  const Mesh mesh = test::random_octahedron(3);
  Mesh small = mesh;
  for (Vec3& v : small.vertices) v = 0x1p-40 * v;
  for (const SamplePlaces places : kPlaces) {
    const MonteCarlo a =
        monte_carlo(chart_about(mesh, {}), {.degree = 5, .places = places, .samples = 3});
    const MonteCarlo b =
        monte_carlo(chart_about(small, {}), {.degree = 5, .places = places, .samples = 4});
    EXPECT_EQ(a.samples, 4u);
    EXPECT_EQ(a.places, places == SamplePlaces::kEdges ? 12u : 8u);
    for (std::size_t i = 0; i < a.deviation.values().size(); ++i) {
      EXPECT_EQ(0x1p-40 * a.expansion.coefficients.values()[i],
                b.expansion.coefficients.values()[i]);
      EXPECT_EQ(0x1p-40 * a.deviation.values()[i], b.deviation.values()[i]);
    }
    EXPECT_EQ(a.relative_deviation, b.relative_deviation);
  }
}

// A wall in a plane through the centre (d_T = 0) and faces seen from behind give the same
// alternating sum as with the other methods.
TEST(monte_carlo, faces_seen_edge_on_or_from_behind_enter_the_alternating_sum) {
  const Mesh mesh = test::l_prism(1.0);
  const StarChart chart = make_star_chart(
      mesh, {.center = {.kind = CenterKind::kGiven, .point = {2, 0.5, 0.1}, .rays = 100},
             .allow_signed = true});
  ASSERT_FALSE(chart.report.star_shaped);
  const Coefficients expected =
      analyze(chart, {.degree = 6, .method = Method::kArea, .precision = 1e-8})
          .expansion.coefficients;
  for (const SamplePlaces places : kPlaces) {
    const MonteCarlo run = monte_carlo(chart, {.degree = 6, .places = places, .samples = 2000});
    EXPECT_FALSE(run.truncation_rms);
    for_each_coefficient(expected, [&](std::size_t i) {
      EXPECT_LE(std::abs(run.expansion.coefficients.values()[i] - expected.values()[i]),
                4.5 * run.deviation.values()[i])
          << to_string(places) << ' ' << i;
    });
  }
}

TEST(monte_carlo, cancels_and_reports_progress) {
  const StarChart chart = octahedron();
  double last = 0;
  monte_carlo(chart, {.degree = 4, .deviation = 0.05},
              {.threads = 2, .progress = [&](std::string_view stage, double part) {
                 EXPECT_EQ(stage, "sampling");
                 EXPECT_GE(part, 0);
                 EXPECT_LE(part, 1);
                 last = part;
                 return true;
               }});
  EXPECT_EQ(last, 1);
  int calls = 0;
  try {
    monte_carlo(chart, {.degree = 4, .samples = 1 << 20},
                {.threads = 1, .progress = [&](std::string_view, double) { return ++calls < 3; }});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(monte_carlo, refuses_options_out_of_range) {
  const StarChart chart = octahedron();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<MonteCarloOptions> bad = {{.degree = -1},
                                              {.degree = kMaxDegree + 1},
                                              {.samples = 0},
                                              {.samples = 1},
                                              {.samples = kMostSamples + 1},
                                              {.deviation = 0},
                                              {.deviation = -0.1},
                                              {.deviation = 1.5},
                                              {.deviation = nan},
                                              {.deviation = 1e-12},
                                              {.most_samples = 1},
                                              {.most_samples = kMostSamples + 1}};
  for (const MonteCarloOptions& options : bad) {
    try {
      monte_carlo(chart, options);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    }
  }
  EXPECT_EQ(parse_name<SamplePlaces>("edge"), SamplePlaces::kEdges);
  EXPECT_EQ(parse_name<SamplePlaces>("triangle"), SamplePlaces::kTriangles);
}

// Near the poles s^m underflows: 0.4^1000 = 1e-398.
TEST(legendre_pair_moments, are_those_of_the_rows_at_every_colatitude) {
  const std::size_t n = kLegendreLanes;
  for (const auto& [m, degree] : {std::pair{0, 9}, {1, 40}, {1000, 2600}}) {
    const LegendreOrder order = legendre_order(m, degree, legendre_mu(degree)[m]);
    const std::size_t rows = static_cast<std::size_t>(degree - m) + 1;
    std::array<std::vector<double>, 2> x, s, re, im;
    std::array<std::vector<double>, 6> found, expected;
    for (std::size_t i = 0; i < 6; ++i) {
      found[i].assign(rows, 0.0);
      expected[i].assign(rows, 0.0);
    }
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t j = 0; j < n; ++j) {
        s[side].push_back(j == 0 ? 0.4 : random_uniform(side, j));
        x[side].push_back(std::sqrt(1 - s[side][j] * s[side][j]) * (j % 2 == 0 ? 1 : -1));
        re[side].push_back(test::random_in(-1, 1, side + 2, j));
        im[side].push_back(test::random_in(-1, 1, side + 4, j));
      }
    }
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<double> pa = legendre_row(order, x[0][j], s[0][j]);
      const std::vector<double> pb = legendre_row(order, x[1][j], s[1][j]);
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t part = 0; part < 2; ++part) {
          const double a = pa[row] * (part == 0 ? re : im)[0][j];
          const double b = pb[row] * (part == 0 ? re : im)[1][j];
          expected[3 * part][row] += a + b;
          expected[3 * part + 1][row] += std::pow(a - b, 2);
          expected[3 * part + 2][row] += std::pow(a - b, 4);
        }
      }
    }
    const auto side = [&](std::size_t k) {
      return PairSide{x[k].data(), s[k].data(), re[k].data(), im[k].data()};
    };
    legendre_pair_moments(order, side(0), side(1), n,
                          {found[0].data(), found[1].data(), found[2].data()},
                          {found[3].data(), found[4].data(), found[5].data()});
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t row = 0; row < rows; ++row) {
        // The bound allows for 32 values of moderate size, and rounding of the recurrence.
        EXPECT_NEAR(found[i][row], expected[i][row], 1e-9 * (1 + std::abs(expected[i][row])));
      }
    }
  }
}

TEST(student_factor, is_the_quantile_of_known_distributions) {
  // P(|t| < x) = p: x = tan(pi p / 2) for nu = 1, p sqrt(2 / (1 - p^2)) for nu = 2.
  const double p = std::erf(3 / std::sqrt(2.0));
  EXPECT_NEAR(student_factor(1) * 3 / std::tan(std::numbers::pi / 2 * p), 1, 0.005);
  EXPECT_NEAR(student_factor(2) * 3 / (p * std::sqrt(2 / (1 - p * p))), 1, 0.005);
  EXPECT_NEAR(student_factor(1e9), 1, 1e-8);
}

}  // namespace
}  // namespace rholm
