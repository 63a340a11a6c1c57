// The formats of coefficients, one .cpp each, behind the same two signatures. Layer: io, private.
#pragma once

#include <cstddef>
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
using CoefficientsParser = ParsedCoefficients(std::string_view bytes, const std::string& name);
CoefficientsParser parse_shtools, parse_icgem, parse_json, parse_npy;

// Whether the bytes, without a byte order mark, are of that format, by their content alone.
bool looks_like_icgem(std::string_view bytes);
bool looks_like_json(std::string_view bytes);
bool looks_like_npy(std::string_view bytes);
// Whether such a file says that its numbers are coefficients, as those written here do.
bool is_own_shtools(std::string_view bytes);
bool is_own_json(std::string_view bytes);
// How far the header of a text is looked for. Chosen: ICGEM files begin with free text, of a few
// kilobytes in those published.
constexpr std::size_t kHeaderBytes = 65536;

// The whole file. `expansion` has passed check_expansion(); `external` are its coefficients in
// `convention`.
using CoefficientsFormatter = std::string(const Expansion& expansion, const Coefficients& external,
                                          const Convention& convention);
CoefficientsFormatter format_shtools, format_icgem, format_json, format_npy;

}  // namespace rholm
