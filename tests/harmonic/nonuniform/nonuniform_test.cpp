#include "harmonic/nonuniform/nonuniform.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "harmonic/fft/fft.h"
#include "harmonic/legendre/direct_sums.h"
#include "harmonic/legendre/legendre_kernels.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/error.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

ValuesAndGradients evaluate_by(const NonuniformPlan& plan, const Coefficients& coefficients,
                               std::span<const Vec3> directions, bool with_gradient,
                               const Context& context) {
  const auto read = [&](const auto& function) {
    return read_at(function, directions, with_gradient, context);
  };
  return plan.single ? read(GridFunction<float>(plan, coefficients, context))
                     : read(GridFunction<double>(plan, coefficients, context));
}

using test::inner;
using test::norm_of;
using test::random_coefficients;
using test::random_in;
using test::random_values;

constexpr double kPi = std::numbers::pi;
const Context kOneThread = {.threads = 1, .progress = {}};

// Returns random directions with the poles, the axes, and directions one rounding or less away from
// them: the ends of longitudes and of colatitudes.
std::vector<Vec3> hard_directions(std::size_t n) {
  std::vector<Vec3> directions = test::random_directions(n, 1);
  const std::vector<Vec3> special = {
      {1, -1e-17, 0}, {1, -1e-9, 0},   {1, 1e-300, 0}, {-1, 0, 0},      {0, 1, 0},
      {1e-17, 0, 1},  {0, -1e-17, -1}, {0, 1e-16, 1},  {-1, -1e-17, 0}, {1e-8, -1e-8, -1}};
  std::copy(special.begin(), special.end(), directions.end() - special.size());
  for (Vec3& u : directions) u = normalized(u);
  return directions;
}

std::vector<Vec3> random_vectors(std::size_t n, std::uint64_t seed) {
  std::vector<Vec3> vectors;
  vectors.reserve(n);
  for (std::size_t j = 0; j < n; ++j) {
    vectors.push_back({random_in(-1, 1, seed, 3 * j), random_in(-1, 1, seed, 3 * j + 1),
                       random_in(-1, 1, seed, 3 * j + 2)});
  }
  return vectors;
}

std::vector<std::array<double, 6>> random_matrices(std::size_t n, std::uint64_t seed) {
  std::vector<std::array<double, 6>> matrices(n);
  for (std::size_t j = 0; j < n; ++j) {
    for (int i = 0; i < 6; ++i) matrices[j][i] = random_in(-1, 1, seed, 6 * j + i);
  }
  return matrices;
}

double distance(const Coefficients& a, const Coefficients& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    square += std::pow(a.values()[i] - b.values()[i], 2);
  }
  return std::sqrt(square);
}

// Sources with the direct sums of their weights, gradients and Hessians separately, and direct sums
// of random coefficients.
struct Problem {
  Problem(int L, std::size_t n)
      : degree(L),
        directions(hard_directions(n)),
        weights(random_values(n, 2)),
        gradients(random_vectors(n, 3)),
        hessians(random_matrices(n, 4)),
        function(random_coefficients(L, 5)),
        values(direct_evaluate_with_gradient(function, directions, kOneThread)) {
    for (int derivatives = 0; derivatives < 3; ++derivatives) {
      sums.emplace_back(L);
      direct_add_adjoint(sources(derivatives), sums.back(), kOneThread);
    }
  }

  // Returns sources of one kind only.
  ScatteredSources sources(int derivatives) const {
    ScatteredSources s{.directions = directions};
    if (derivatives == 0) s.weights = weights;
    if (derivatives == 1) s.gradients = gradients;
    if (derivatives == 2) s.hessians = hessians;
    return s;
  }

  // Returns the error of the adjoint in the norm of SumOptions::precision.
  double adjoint_error(const NonuniformPlan& plan, int derivatives) const {
    Coefficients sum(degree);
    nonuniform_add_adjoint(plan, sources(derivatives), derivatives, sum, kOneThread);
    double square = 0;
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const auto& h = hessians[j];
      if (derivatives == 0) square += weights[j] * weights[j];
      if (derivatives == 1) square += dot(gradients[j], gradients[j]);
      if (derivatives == 2) {
        square +=
            h[0] * h[0] + h[3] * h[3] + h[5] * h[5] + 2 * (h[1] * h[1] + h[2] * h[2] + h[4] * h[4]);
      }
    }
    const double generic = (degree + 1.0) * std::sqrt(square / (4 * kPi));
    return distance(sum, sums[derivatives]) / (generic * std::pow(degree, derivatives));
  }

  // Returns the error of values, or of gradients.
  double forward_error(const NonuniformPlan& plan, bool of_gradient) const {
    const ValuesAndGradients found =
        evaluate_by(plan, function, directions, of_gradient, kOneThread);
    double square = 0;
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const Vec3 g = of_gradient ? found.gradients[j] - values.gradients[j] : Vec3{};
      square += of_gradient ? dot(g, g) : std::pow(found.values[j] - values.values[j], 2);
    }
    const double generic =
        norm_of(function.values()) * std::sqrt(static_cast<double>(directions.size()) / (4 * kPi));
    return std::sqrt(square) / (generic * (of_gradient ? degree : 1));
  }

  int degree;
  std::vector<Vec3> directions;
  std::vector<double> weights;
  std::vector<Vec3> gradients;
  std::vector<std::array<double, 6>> hessians;
  Coefficients function;
  ValuesAndGradients values;
  std::vector<Coefficients> sums;
};

// Makes a plan with a given window, whatever its error.
NonuniformPlan plan_of(int degree, int width, double sigma, int derivatives, bool single = false) {
  const double wanted = std::max(32.0, std::ceil(2 * sigma * degree));
  const std::size_t points = smooth_length(static_cast<std::size_t>(wanted), 4);
  NonuniformPlan plan;
  plan.fourier = sphere_fourier(degree, grid_layout(width, points, points));
  plan.single = single;
  plan.polar_sine = static_cast<double>(derivatives) / std::max(degree, 1);
  return plan;
}

// For every window that the library chooses, the error is below the requested precision, but not by
// a large factor. There are 30 000 sources, so that grids are chosen.
TEST(nonuniform, true_error_follows_the_wish) {
  constexpr int kKinds = 5;
  std::array<double, kKinds> log_slack{};
  int count = 0;
  for (const int L : {3, 16, 64, 180}) {
    const Problem problem(L, L == 180 ? 200 : 600);
    for (double wish = 1e-3; wish > 0.5e-12; wish /= 10) {
      std::array<double, kKinds> error{};
      for (int derivatives = 0; derivatives < 3; ++derivatives) {
        const NonuniformPlan plan = plan_nonuniform(
            {.degree = L, .allowed = wish, .sources = 30000, .derivatives = derivatives});
        EXPECT_EQ(plan.single, wish >= least_single_error(L, derivatives));
        error[derivatives] = problem.adjoint_error(plan, derivatives);
        if (derivatives < 2) error[3 + derivatives] = problem.forward_error(plan, derivatives == 1);
      }
      ++count;
      for (int kind = 0; kind < kKinds; ++kind) {
        EXPECT_LT(error[kind], wish) << "degree " << L << " kind " << kind;
        log_slack[kind] += std::log(wish / error[kind]);
      }
    }
  }
  for (const double slack : log_slack) EXPECT_LT(std::exp(slack / count), 30);
}

// The discrete operators are transposes to rounding, however coarse the window is.
TEST(nonuniform, forward_and_adjoint_are_transposes_for_every_width) {
  for (const int L : {1, 20, 65}) {
    const Problem problem(L, 300);
    const auto n = problem.directions.size();
    for (int width = kMinSpreadWidth; width <= kMaxSpreadWidth; ++width) {
      for (const bool gradients : {false, true}) {
        const NonuniformPlan plan = plan_of(L, width, 1.3, gradients);
        const ValuesAndGradients found =
            evaluate_by(plan, problem.function, problem.directions, gradients, kOneThread);
        Coefficients sum(L);
        const ScatteredSources sources{
            .directions = problem.directions,
            .weights = problem.weights,
            .gradients = gradients ? problem.gradients : std::span<const Vec3>{}};
        nonuniform_add_adjoint(plan, sources, gradients, sum, kOneThread);
        double product = inner(found.values, problem.weights), scale = norm_of(found.values);
        for (std::size_t j = 0; gradients && j < n; ++j) {
          product += dot(found.gradients[j], problem.gradients[j]);
          scale += norm(found.gradients[j]);
        }
        EXPECT_NEAR(product, inner(problem.function.values(), sum.values()),
                    1e-13 * scale * norm_of(problem.weights))
            << L << " " << width << " " << gradients;
      }
    }
  }
}

// Weights, gradients and Hessians together give the sum of their separate results.
TEST(nonuniform, sources_of_all_kinds_add_up) {
  constexpr int L = 24;
  const Problem problem(L, 200);
  const NonuniformPlan plan = plan_of(L, 14, 2, 2);
  Coefficients together(L), apart(L);
  nonuniform_add_adjoint(plan,
                         {problem.directions, problem.weights, problem.gradients, problem.hessians},
                         2, together, kOneThread);
  for (const Coefficients& sum : problem.sums) {
    for (std::size_t i = 0; i < sum.values().size(); ++i) apart.values()[i] += sum.values()[i];
  }
  EXPECT_LT(distance(together, apart), 1e-9 * norm_of(apart.values()));
}

// The rounding error of single precision is as stated, for every padded width. Next to the poles
// differences have wider steps, which add a few per cent of error with narrow windows.
TEST(nonuniform, single_precision_keeps_its_rounding_error) {
  for (const int L : {16, 64, 180}) {
    const Problem problem(L, 400);
    for (const int width : {4, 7, 10}) {
      for (const int derivatives : {0, 1}) {
        const double rounded =
            problem.adjoint_error(plan_of(L, width, 2, derivatives, true), derivatives);
        const double exact = problem.adjoint_error(plan_of(L, width, 2, derivatives), derivatives);
        EXPECT_LT(rounded, std::hypot(1.05 * exact, 1.4 * single_rounding(L))) << L << " " << width;
      }
    }
  }
}

// Coefficients have the unit of the shape: 1e60 units exceed single precision.
TEST(nonuniform, single_precision_has_the_same_bits_for_every_size) {
  constexpr int L = 16;
  const Problem problem(L, 400);
  const NonuniformPlan plan = plan_of(L, 7, 2, 1, true);
  const auto add = [&](double size) {
    std::vector<double> weights = problem.weights;
    for (double& w : weights) w *= size;
    Coefficients sum(L);
    nonuniform_add_adjoint(plan, {.directions = problem.directions, .weights = weights}, 0, sum,
                           kOneThread);
    return sum;
  };
  const auto evaluated = [&](double size) {
    Coefficients function = problem.function;
    for (double& c : function.values()) c *= size;
    return evaluate_by(plan, function, problem.directions, true, kOneThread);
  };
  for (const double size : {0x1p-300, 0x1p200, 0x1p900}) {
    const Coefficients sum = add(size), expected = add(1);
    for (std::size_t i = 0; i < sum.values().size(); ++i) {
      EXPECT_EQ(sum.values()[i], size * expected.values()[i]) << size;
    }
    const ValuesAndGradients found = evaluated(size), plain = evaluated(1);
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      EXPECT_EQ(found.values[i], size * plain.values[i]) << size;
      EXPECT_EQ(found.gradients[i].x, size * plain.gradients[i].x) << size;
    }
  }
}

// Checks single coefficients of high degree by Legendre rows: small orders, high orders, and
// between.
void check_high_degrees(int L) {
  constexpr std::size_t kSources = 40;
  const auto directions = hard_directions(kSources);
  const auto weights = random_values(kSources, 2);
  constexpr double kWish = 1e-9;
  const NonuniformPlan plan = plan_nonuniform({.degree = L, .allowed = kWish, .sources = 1000});
  Coefficients sum(L);
  nonuniform_add_adjoint(plan, {.directions = directions, .weights = weights}, 0, sum, {});
  const std::vector<double> mu = legendre_mu(L);
  // Root mean square of the error of one coefficient.
  const double error = kWish * norm_of(weights) / std::sqrt(4 * kPi);
  for (const int m : {0, 1, L / 6, L / 2, L - L / 42, L}) {
    const LegendreOrder order = legendre_order(m, L, mu[m]);
    std::vector<double> c(L + 1 - m, 0.0), s(L + 1 - m, 0.0);
    for (std::size_t j = 0; j < kSources; ++j) {
      const Vec3& u = directions[j];
      const auto row = legendre_row(order, u.z, std::hypot(u.x, u.y));
      const double phi = std::atan2(u.y, u.x);
      for (int l = m; l <= L; ++l) {
        c[l - m] += weights[j] * row[l - m] * std::cos(m * phi);
        s[l - m] += weights[j] * row[l - m] * std::sin(m * phi);
      }
    }
    // The bound is five standard deviations for each of some thousand values.
    for (int l = m; l <= L; l += 1 + (L - m) / 50) {
      EXPECT_NEAR(sum.c(l, m), c[l - m], 5 * error) << l << " " << m;
      EXPECT_NEAR(sum.s(l, m), s[l - m], 5 * error) << l << " " << m;
    }
  }
}

TEST(nonuniform, high_degrees_agree_with_legendre_rows) { check_high_degrees(2048); }

TEST(nonuniform, high_degrees_agree_with_legendre_rows_nightly) { check_high_degrees(4096); }

// f = x^T B x / |x|^2 has few coefficients, with B = z z^T, (x y^T + y x^T) / 2 and (x z^T + z x^T)
// / 2 in turn. Its Hessian at |x| = 1 is
//   2 B - 4 (B x x^T + x x^T B) - 2 q 1 + 8 q x x^T,  q = x^T B x.
TEST(direct_sums, hessians_of_quadratic_forms_have_their_closed_form) {
  const auto directions = hard_directions(40);
  const auto hessians = random_matrices(40, 6);
  Coefficients sum(2);
  direct_add_adjoint({.directions = directions, .hessians = hessians}, sum, kOneThread);
  std::array<Coefficients, 3> forms = {Coefficients(2), Coefficients(2), Coefficients(2)};
  forms[0].c(0, 0) = std::sqrt(4 * kPi) / 3;  // z^2 = 1/3 + 2/3 P_2
  forms[0].c(2, 0) = 2 * std::sqrt(4 * kPi / 5) / 3;
  forms[1].s(2, 2) = std::sqrt(4 * kPi / 15);  // x y
  forms[2].c(2, 1) = std::sqrt(4 * kPi / 15);  // x z
  const std::array<std::array<double, 6>, 3> b = {
      {{0, 0, 0, 0, 0, 1}, {0, 0.5, 0, 0, 0, 0}, {0, 0, 0.5, 0, 0, 0}}};
  for (int form = 0; form < 3; ++form) {
    double expected = 0;
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const auto times = [](const std::array<double, 6>& h, const Vec3& v) {
        return Vec3{h[0] * v.x + h[1] * v.y + h[2] * v.z, h[1] * v.x + h[3] * v.y + h[4] * v.z,
                    h[2] * v.x + h[4] * v.y + h[5] * v.z};
      };
      const auto& h = hessians[j];
      const Vec3& u = directions[j];
      const Vec3 bu = times(b[form], u), hu = times(h, u);
      const double q = dot(u, bu);
      double contracted = 0;  // h : B
      for (int i = 0; i < 6; ++i) {
        contracted += (i == 0 || i == 3 || i == 5 ? 1 : 2) * h[i] * b[form][i];
      }
      expected +=
          2 * contracted - 8 * dot(hu, bu) - 2 * q * (h[0] + h[3] + h[5]) + 8 * q * dot(hu, u);
    }
    EXPECT_NEAR(inner(forms[form].values(), sum.values()), expected, 1e-12) << form;
  }
}

// Second differences with step h along random lines have the error h^2 L^4 / 12 of the amplitude,
// and rounding 4 eps / h^2.
TEST(direct_sums, hessians_agree_with_second_differences) {
  constexpr int L = 12;
  constexpr double kStep = 2e-4;
  const Coefficients f = random_coefficients(L, 7);
  for (std::size_t j = 0; j < 30; ++j) {
    const Vec3 u = test::random_direction(8, j), v = test::random_direction(9, j);
    const std::array<Vec3, 3> points = {normalized(u - kStep * v), u, normalized(u + kStep * v)};
    const auto at = direct_evaluate(f, points, kOneThread);
    const std::array<double, 6> h = {v.x * v.x, v.x * v.y, v.x * v.z,
                                     v.y * v.y, v.y * v.z, v.z * v.z};
    Coefficients sum(L);
    direct_add_adjoint({.directions = {&u, 1}, .hessians = {&h, 1}}, sum, kOneThread);
    EXPECT_NEAR(inner(f.values(), sum.values()), (at[0] - 2 * at[1] + at[2]) / (kStep * kStep),
                3e-3);
  }
}

// The public functions choose a grid here and keep the requested precision.
TEST(fast_engine, keeps_the_wish) {
  constexpr int L = 48;
  constexpr std::size_t kSources = 20000;
  const Problem problem(L, kSources);
  const SumOptions options{.engine = Engine::kFast, .precision = 1e-9};
  Coefficients sum(L);
  add_adjoint(problem.sources(0), sum, options);
  const double difference = distance(sum, problem.sums[0]);
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, 1e-9 * (L + 1) * norm_of(problem.weights) / std::sqrt(4 * kPi));
  const auto values = evaluate(problem.function, problem.directions, options);
  const auto both = evaluate_with_gradient(problem.function, problem.directions, options);
  const double largest = 1e-8 * norm_of(problem.function.values());
  for (std::size_t j = 0; j < kSources; ++j) {
    EXPECT_NEAR(values[j], problem.values.values[j], largest);
    EXPECT_LT(norm(both.gradients[j] - problem.values.gradients[j]), L * largest);
  }
}

TEST(fast_engine, gives_the_same_bits_for_any_number_of_threads) {
  constexpr int L = 70;
  const auto directions = hard_directions(60000);
  const auto weights = random_values(directions.size(), 2);
  const auto vectors = random_vectors(directions.size(), 3);
  const Coefficients f = random_coefficients(L, 5);
  for (const double precision : {1e-4, 1e-10}) {
    const SumOptions options{.engine = Engine::kFast, .precision = precision};
    const auto run = [&](int threads) {
      const Context context{.threads = threads, .progress = {}};
      Coefficients sum(L);
      add_adjoint({.directions = directions, .weights = weights, .gradients = vectors}, sum,
                  options, context);
      std::vector<double> numbers(sum.values().begin(), sum.values().end());
      const auto found = evaluate_with_gradient(f, directions, options, context);
      numbers.insert(numbers.end(), found.values.begin(), found.values.end());
      for (const Vec3& g : found.gradients) numbers.insert(numbers.end(), {g.x, g.y, g.z});
      return numbers;
    };
    const auto expected = run(1);
    EXPECT_EQ(run(2), expected);
    EXPECT_EQ(run(4), expected);
  }
}

TEST(fast_engine, keeps_the_promise_on_every_instruction_set) {
  test::for_each_target([](const char* target) {
    for (const int L : {5, 40}) {
      const Problem problem(L, 300);
      for (const double wish : {1e-4, 1e-7, 1e-11}) {
        for (int derivatives = 0; derivatives < 3; ++derivatives) {
          const NonuniformPlan plan = plan_nonuniform(
              {.degree = L, .allowed = wish, .sources = 30000, .derivatives = derivatives});
          EXPECT_LT(problem.adjoint_error(plan, derivatives), wish) << target;
          if (derivatives == 2) continue;
          EXPECT_LT(problem.forward_error(plan, derivatives == 1), wish) << target;
        }
      }
    }
  });
}

TEST(fast_engine, can_be_cancelled) {
  const Context context{.threads = 1, .progress = [](std::string_view, double) { return false; }};
  const auto directions = hard_directions(20000);
  const Coefficients f = random_coefficients(64, 5);
  const SumOptions options{.engine = Engine::kFast, .precision = 1e-6};
  Coefficients sum(64);
  EXPECT_THROW(evaluate(f, directions, options, context), Error);
  EXPECT_THROW(evaluate_with_gradient(f, directions, options, context), Error);
  EXPECT_THROW(add_adjoint({.directions = directions, .weights = random_values(20000, 2)}, sum,
                           options, context),
               Error);
}

TEST(nonuniform, tiny_problems_give_numbers) {
  for (const int L : {0, 1}) {
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}}) {
      for (const bool single : {false, true}) {
        const std::vector<Vec3> directions(n, Vec3{0, 0, -1});
        const std::vector<double> weights(n, 2.0);
        const std::vector<Vec3> gradients(n, Vec3{1, 2, 3});
        const NonuniformPlan plan = plan_of(L, 5, 2, 1, single);
        Coefficients sum(L);
        nonuniform_add_adjoint(plan, {directions, weights, gradients, {}}, 1, sum, kOneThread);
        // Differences next to a pole divide the window's 1e-7, and rounding, by their step.
        EXPECT_NEAR(sum.c(0, 0), n == 0 ? 0 : 2 / std::sqrt(4 * kPi), 2e-5);
        for (const double v : sum.values()) EXPECT_TRUE(std::isfinite(v));
        const auto found = evaluate_by(plan, sum, directions, true, kOneThread);
        ASSERT_EQ(found.values.size(), n);
        for (const double v : found.values) EXPECT_TRUE(std::isfinite(v));
        for (const Vec3& g : found.gradients) EXPECT_TRUE(std::isfinite(norm(g)));
      }
    }
  }
  EXPECT_TRUE(evaluate(Coefficients(5), std::vector<Vec3>{}).empty());
}

// Invalid directions affect the result only, not other memory.
TEST(nonuniform, directions_that_are_no_numbers_stay_within_the_grid) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> directions = {{kNaN, 0, 1},         {kInfinity, 1, 0}, {0, 0, 0},
                                        {0, kInfinity, kNaN}, {1e300, 1e300, 1}, {0, 0, 1}};
  const std::vector<double> weights(directions.size(), 1.0);
  for (const bool single : {false, true}) {
    for (const int width : {4, 8, 16}) {
      const NonuniformPlan plan = plan_of(20, width, 1.5, 0, single);
      Coefficients sum(20);
      nonuniform_add_adjoint(plan, {.directions = directions, .weights = weights}, 0, sum,
                             kOneThread);
      const auto found =
          evaluate_by(plan, random_coefficients(20, 5), directions, false, kOneThread);
      EXPECT_TRUE(std::isfinite(found.values.back()));
    }
  }
}

// Direct sums are used instead, because they cost less.
TEST(nonuniform, what_no_window_keeps_has_no_price) {
  const NonuniformPlan plan = plan_nonuniform(
      {.degree = 20, .allowed = 1e-14, .sources = 10, .derivatives = 2, .hessian_size = 1e6});
  EXPECT_EQ(plan.cost, std::numeric_limits<double>::infinity());
  EXPECT_EQ(plan.fourier.layout.width, kMaxSpreadWidth);
}

TEST(nonuniform, refuses_single_precision_where_it_is_forbidden) {
  EXPECT_FALSE(
      plan_nonuniform({.degree = 20, .allowed = 1e-3, .sources = 10, .forbid_single = true})
          .single);
}

// Gradients are counted before the grid is known: exactly for 1.86-fold oversampling, too little
// for finer grids.
TEST(counted_gradient_factor, makes_up_for_what_finer_grids_do_to_gradients) {
  EXPECT_EQ(counted_gradient_factor(1.5), 1);
  for (const double sigma : {2.0, 3.0, 4.0}) {
    EXPECT_NEAR(counted_gradient_factor(sigma) * gradient_as_weight(100),
                gradient_factor(sigma) * 100, 1e-9);
  }
}

}  // namespace
}  // namespace rholm
