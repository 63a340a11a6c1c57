// The formats of coefficients, one .cpp each, behind the same two signatures. Layer: io, private.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/coefficients/known_numbers.h"
#include "rholm/coefficients.h"

namespace rholm {

// What a file says, its numbers as they stand; what it does not say is empty.
struct ParsedCoefficients {
  Coefficients external;
  std::optional<Normalization> normalization = {};
  std::optional<int> csphase = {};
  std::optional<RadialFunction> function = {};
  std::optional<Vec3> center = {};
  std::string unit = {};
  std::string method = {};
  KnownNumbers numbers = {};
  bool signed_sum = false;
  std::string product = {};                   // what it is of, if that is no shape
  std::vector<std::string> passed_over = {};  // what it says and what is not used
};

// `bytes` is the whole file, `name` serves messages. Numbers are finite; throws InvalidInput,
// Unsupported. Memory stays within a small multiple of the file's size, or 16 MiB.
ParsedCoefficients parse_shtools(std::string_view bytes, const std::string& name);
ParsedCoefficients parse_icgem(std::string_view bytes, const std::string& name);
ParsedCoefficients parse_json(std::string_view bytes, const std::string& name);
ParsedCoefficients parse_npy(std::string_view bytes, const std::string& name);

// The whole file. `expansion` has passed check_expansion(); `external` are its coefficients in
// `convention`.
std::string format_shtools(const Expansion& expansion, const Coefficients& external,
                           const Convention& convention);
std::string format_icgem(const Expansion& expansion, const Coefficients& external,
                         const Convention& convention);
std::string format_json(const Expansion& expansion, const Coefficients& external,
                        const Convention& convention);
std::string format_npy(const Coefficients& external);

}  // namespace rholm
