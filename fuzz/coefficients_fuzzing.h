// Conditions that hold for any bytes given to a reader of coefficients.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "io/coefficients/coefficients_formats.h"
#include "io/coefficients/expansion_check.h"
#include "rholm/coefficients_io.h"
#include "rholm/error.h"

namespace rholm::fuzzing {

inline void require(bool condition) {
  if (!condition) std::abort();
}

inline bool same(const Coefficients& a, const Coefficients& b) {
  if (a.degree() != b.degree()) return false;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    if (a.values()[i] != b.values()[i]) return false;
  }
  return true;
}

inline bool same(const Expansion& a, const Expansion& b) {
  return same(a.coefficients, b.coefficients) && a.function == b.function && a.center == b.center &&
         a.unit == b.unit && a.method == b.method && a.norm_squared == b.norm_squared &&
         a.tail_strength == b.tail_strength && a.gravity == b.gravity && a.precision == b.precision;
}

// Checks that a valid expansion survives every format.
inline void check_expansion_survives(const Expansion& expansion) {
  check_expansion(expansion, "fuzz");
  constexpr int kEnough = 64;  // larger degrees only cost time
  if (expansion.coefficients.degree() > kEnough) return;
  const Convention orthonormal{Normalization::kOrthonormal, 1};
  for (const CoefficientsFormatLine& format : coefficients_format_table()) {
    if (format.write == nullptr) continue;
    const std::string bytes = format.write(expansion, expansion.coefficients, orthonormal);
    const Expansion again =
        parse_coefficients(bytes, "again", {.convention = orthonormal}).expansion;
    require(format.info.meaning ? same(again, expansion)
                                : same(again.coefficients, expansion.coefficients));
  }
}

// Checks that the reader throws an Error or returns a valid expansion.
inline void check_coefficients_reader(const std::uint8_t* data, std::size_t size) {
  const std::span<const char> bytes(reinterpret_cast<const char*>(data), size);
  looks_like_coefficients(bytes);
  CoefficientsFile file;
  try {
    file = parse_coefficients(bytes, "fuzz");
  } catch (const Error&) {
    return;
  }
  check_expansion_survives(file.expansion);
}

}  // namespace rholm::fuzzing
