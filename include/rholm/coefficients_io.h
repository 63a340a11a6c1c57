// Coefficients from and to text, JSON and NumPy files. Layer: io. (The model file, HDF5, is in
// model.h.)
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"

namespace rholm {

// How coefficients are laid out in a file.
enum class CoefficientsFormat {
  kShtools,  // text, a line `l m C S` per pair; comment lines "# key: value" say the rest
  kIcgem,    // text with ICGEM-like header and lines `gfc l m C S`
  kJson,     // {"format": "rholm-coefficients", ...}
  kNpy       // NumPy array [2][L+1][L+1] of float64, C order, little endian; nothing else
};
const char* to_string(CoefficientsFormat format);  // "shtools", "icgem", "json", "npy"
CoefficientsFormat parse_coefficients_format(const std::string& name);  // throws Unsupported
// By extension: .sh .txt .shtools; .gfc .icgem; .json; .npy. None if unknown.
std::optional<CoefficientsFormat> coefficients_format_of(const std::filesystem::path& path);

// What a file that does not say it (bare text, .npy) is taken to mean; what it does say wins unless
// `override_file` is set.
struct CoefficientsReadOptions {
  Convention convention = {};  // of files that say none
  bool override_file = false;  // of all files, whatever they say
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CoefficientsReadOptions>, const Visitor& field) {
  using O = CoefficientsReadOptions;
  field(&O::convention,
        {.name = "convention", .help = "of files that say none", .in_program = false});
  field(&O::override_file, {.name = "override_file",
                            .help = "the convention is that of all files, whatever they say",
                            .in_program = false});
}

// What was read, and what of it the file said.
struct CoefficientsFile {
  Expansion expansion;                                       // in the library's own convention
  CoefficientsFormat format = CoefficientsFormat::kShtools;  // as its content showed
  Convention convention;                                     // in which the numbers stood
  std::vector<std::string> assumed;  // what the file did not say: "normalization 4pi", ...
  // What the file says it is of, if that is no shape: "gravity_field"; the function is then kOther.
  std::string product;
  std::vector<std::string> passed_over;  // what it says and what is not used: "radius '6378136.3'"
};

// "-" is standard input; the content decides the format. Throws Io, InvalidInput (malformed,
// truncated, m > l, not finite, a degree above kMaxDegree), Unsupported.
CoefficientsFile read_coefficients(const std::filesystem::path& path,
                                   const CoefficientsReadOptions& options = {},
                                   const Context& context = {});
// The same for bytes in memory; `name` serves messages and the extension.
CoefficientsFile parse_coefficients(std::span<const char> bytes, const std::string& name,
                                    const CoefficientsReadOptions& options = {});

// True if the bytes begin like one of the formats above (not for bare text, which is only told
// from points by its lines).
bool looks_like_coefficients(std::span<const char> bytes);

// How coefficients are written.
struct CoefficientsWriteOptions {
  std::optional<CoefficientsFormat> format = {};  // by default from the extension
  Convention convention = {};                     // of the numbers; the file says it if it can
};
// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CoefficientsWriteOptions>, const Visitor& field) {
  using O = CoefficientsWriteOptions;
  field(&O::format,
        {.name = "format", .help = "format of the output, instead of the one its extension names"});
  field(&O::convention, {.name = "convention",
                         .help = "of the numbers; the file says it if it can",
                         .in_program = false});
}

// Numbers are written with the shortest digits that read back the same. "-" is standard output.
void write_coefficients(const Expansion& expansion, const std::filesystem::path& path,
                        const CoefficientsWriteOptions& options = {});

// What names a unit of lengths in every format: one line of UTF-8 text of at most 256 bytes,
// without blanks at its ends. Throws InvalidInput for anything else.
void check_unit(const std::string& unit);

}  // namespace rholm
