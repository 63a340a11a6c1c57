#include "transform/degree_bracket.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rholm {
namespace {

// The degree found for an error c / (L + 1)^p, and how many were tried.
struct Found {
  int degree = 0, tries = 0;
};
Found find(double p, double limit, int most, bool at_vertices) {
  const auto error = [&](int degree) { return std::pow(degree + 1.0, -p); };
  DegreeBracket bracket{.bad = -1, .good = most, .bad_value = 0, .good_value = error(most)};
  bracket.at_vertices = at_vertices;
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
        for (const bool at_vertices : {false, true}) {
          const Found found = find(p, limit, smallest + more, at_vertices);
          EXPECT_GE(found.degree, smallest) << p << ", " << limit << ", " << more;
          EXPECT_LE(found.degree, smallest + std::max(0, smallest / 49)) << p << ", " << limit;
          EXPECT_LE(found.tries, 16) << p << ", " << limit << ", " << more;
        }
      }
    }
  }
}

TEST(degree_bracket, needs_two_tries_where_the_law_is_known) {
  for (const int degree : {30, 100, 700, 3000}) {
    for (const double factor : {1.05, 1.3, 2.}) {
      const Found found = find(1, 1. / (degree + 1), static_cast<int>(factor * degree), true);
      EXPECT_LE(found.tries, 2) << degree;
      EXPECT_NEAR(found.degree, degree, degree / 49 + 1);
    }
  }
}

}  // namespace
}  // namespace rholm
