#include "transform/tolerance/degree_bracket.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace rholm {
namespace {

using ErrorOfDegree = std::function<double(int)>;

ErrorOfDegree power_law(double p) {
  return [p](int degree) { return std::pow(degree + 1.0, -p); };
}

// The degree found between a bad degree, if any, and a good one, and the number of tries.
struct Found {
  int degree = 0, tries = 0;
};
Found find(const ErrorOfDegree& error, double limit, int bad, int good) {
  DegreeBracket bracket{.bad = bad, .good = good, .good_value = error(good)};
  if (bad >= 0) bracket.bad_value = error(bad);
  Found found;
  while (!bracket.closed()) {
    const int guess = bracket.guess(limit);
    EXPECT_GT(guess, bracket.bad);
    EXPECT_LT(guess, bracket.good);
    bracket.add(guess, error(guess), limit);
    ++found.tries;
  }
  found.degree = bracket.good;
  return found;
}

// The smallest good degree is the first with L + 1 >= limit^(-1/p).
TEST(degree_bracket, finds_the_degree_of_a_power_law_to_a_fiftieth) {
  for (const double p : {0.5, 1., 3.}) {
    for (const double limit : {0.7, 1e-1, 1e-2, 2e-3}) {
      const int smallest = static_cast<int>(std::ceil(std::pow(limit, -1 / p) * (1 - 1e-12))) - 1;
      for (const int more : {0, 1, 7, 100, 1000}) {
        const Found found = find(power_law(p), limit, -1, smallest + more);
        EXPECT_GE(found.degree, smallest) << p << ", " << limit << ", " << more;
        EXPECT_LE(found.degree, smallest + std::max(0, smallest / 49)) << p << ", " << limit;
        EXPECT_LE(found.tries, 16) << p << ", " << limit << ", " << more;
      }
    }
  }
}

TEST(degree_bracket, needs_two_tries_between_degrees_of_one_power) {
  for (const double p : {0.5, 1., 3.}) {
    for (const int degree : {30, 100, 700, 3000}) {
      const double limit = power_law(p)(degree);
      const Found found = find(power_law(p), limit, degree / 2, static_cast<int>(1.3 * degree));
      EXPECT_LE(found.tries, 2) << degree;
      const int slack = degree / 49 + 1;
      EXPECT_NEAR(found.degree, degree, slack);
    }
  }
}

// The error is constant, then falls: the power law between both ends is wrong everywhere.
TEST(degree_bracket, halves_where_the_error_follows_no_power) {
  for (const int edge : {150, 200, 350}) {
    const auto error = [edge](int degree) { return degree < edge ? 2.0 : 0.1; };
    const Found found = find(error, 1, 100, 400);
    EXPECT_NEAR(found.degree, edge, 8);  // a fiftieth of 400
    EXPECT_GE(found.degree, edge);
    EXPECT_LE(found.tries, 12) << edge;
  }
}

}  // namespace
}  // namespace rholm
