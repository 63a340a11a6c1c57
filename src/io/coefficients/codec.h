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

// The content of a file, with unchanged numbers; members that it does not state are empty.
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
  std::string product = {};                   // the subject of the expansion, if it is no shape
  std::vector<std::string> passed_over = {};  // statements in the file that are not used
};

// Parses a whole file, `bytes`; `name` serves messages. Numbers are finite. Throws InvalidInput,
// Unsupported. Memory stays within a small multiple of the file's size, or 16 MiB.
using CoefficientsParser = ParsedCoefficients(std::string_view bytes, const std::string& name);
CoefficientsParser parse_shtools, parse_icgem, parse_json, parse_npy;

// Return true if the content, without a byte order mark, has the format.
bool looks_like_icgem(std::string_view bytes);
bool looks_like_json(std::string_view bytes);
bool looks_like_npy(std::string_view bytes);
// Return true if such a file states that its numbers are coefficients, as files of rholm do.
bool is_own_shtools(std::string_view bytes);
bool is_own_json(std::string_view bytes);
// Number of bytes within which the header of a text is searched. Chosen: ICGEM files begin with
// free text, which has a few kilobytes in published files.
constexpr std::size_t kHeaderBytes = 65536;

// Returns the whole file. `expansion` has passed check_expansion(); `external` has its coefficients
// in `convention`.
using CoefficientsFormatter = std::string(const Expansion& expansion, const Coefficients& external,
                                          const Convention& convention);
CoefficientsFormatter format_shtools, format_icgem, format_json, format_npy;

}  // namespace rholm
