// Helpers for the tests of the formats of coefficients.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "base/random.h"
#include "rholm/coefficients_io.h"
#include "rholm/error.h"

namespace rholm::coefficients_testing {

// Every field differs from its default. Coefficients have many magnitudes and are all different.
inline Expansion random_expansion(int degree) {
  Expansion expansion;
  expansion.coefficients = Coefficients(degree);
  std::uint64_t counter = 0;
  const auto next = [&] {
    const double exponent = 40 * random_uniform(7, counter++) - 20;
    return (random_uniform(7, counter++) - 0.5) * std::pow(10, exponent);
  };
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      expansion.coefficients.c(l, m) = next();
      if (m > 0) expansion.coefficients.s(l, m) = next();
    }
  }
  expansion.function = RadialFunction::kGauge;
  expansion.center = {1 / 3.0, -2e-300, 3e300};
  expansion.unit = "k\xc3\xa4se: \"kilo\" \\ # , x";  // characters that could confuse a parser
  expansion.method = "edge";
  expansion.norm_squared = 1 / 7.0;
  expansion.tail_strength = 5e-324;
  expansion.signed_sum = true;
  expansion.precision = 1e-5 / 3;
  return expansion;
}

inline void expect_same_numbers(const Coefficients& a, const Coefficients& b) {
  ASSERT_EQ(a.degree(), b.degree());
  for (int l = 0; l <= a.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      EXPECT_EQ(a.c(l, m), b.c(l, m)) << "C " << l << " " << m;
      EXPECT_EQ(a.s(l, m), b.s(l, m)) << "S " << l << " " << m;
    }
  }
}

inline void expect_same_description(const Expansion& a, const Expansion& b) {
  EXPECT_EQ(a.function, b.function);
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.norm_squared, b.norm_squared);
  EXPECT_EQ(a.tail_strength, b.tail_strength);
  EXPECT_EQ(a.signed_sum, b.signed_sum);
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.precision, b.precision);
}

// Returns the code of the error that `call` throws; its message must contain `words`.
inline ErrorCode error_code(const std::function<void()>& call, const std::string& words = "") {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
        << "'" << error.what() << "' has no '" << words << "'";
    return error.code();
  }
  ADD_FAILURE() << "no error, expected one with '" << words << "'";
  return ErrorCode::kCancelled;
}

inline CoefficientsFile parse(const std::string& bytes,
                              const CoefficientsReadOptions& options = {}) {
  return parse_coefficients(bytes, "test", options);
}

// Checks that the file is refused as InvalidInput with `words` in the message.
inline void expect_refused(const std::string& bytes, const std::string& words) {
  EXPECT_EQ(error_code([&] { parse(bytes); }, words), ErrorCode::kInvalidInput) << bytes;
}
inline void expect_unsupported(const std::string& bytes, const std::string& words) {
  EXPECT_EQ(error_code([&] { parse(bytes); }, words), ErrorCode::kUnsupported) << bytes;
}

// Checks that the file is refused when cut after any byte, or empty.
inline void expect_every_cut_is_refused(const std::string& bytes) {
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(parse(bytes.substr(0, size)), Error) << "cut after " << size << " bytes";
  }
}

}  // namespace rholm::coefficients_testing
