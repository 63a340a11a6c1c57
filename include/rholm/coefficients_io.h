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

// Layout of coefficients in a file.
enum class CoefficientsFormat {
  kShtools,  // text, a line `l m C S` per pair; comments "# key: value" hold the metadata
  kIcgem,    // text with ICGEM-like header and lines `gfc l m C S`
  kJson,     // {"format": "rholm-coefficients", ...}
  kNpy       // NumPy array [2][L+1][L+1] of float64, C order, little endian; no metadata
};
const char* to_string(CoefficientsFormat format);  // "shtools", "icgem", "json", "npy"
CoefficientsFormat parse_coefficients_format(const std::string& name);  // throws Unsupported
// Returns the format by extension: .sh .txt .shtools; .gfc .icgem; .json; .npy. Empty if unknown.
std::optional<CoefficientsFormat> coefficients_format_of(const std::filesystem::path& path);

// Convention of a file that does not state it (bare text, .npy). A convention stated in the file
// takes precedence unless `override_file` is set.
struct CoefficientsReadOptions {
  Convention convention = {};  // convention of files that state none
  bool override_file = false;  // true: use `convention` for all files
};

// Lists the fields of CoefficientsReadOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CoefficientsReadOptions>, const Visitor& field) {
  using O = CoefficientsReadOptions;
  field(&O::convention,
        {.name = "convention", .help = "of files that say none", .in_program = false});
  field(&O::override_file, {.name = "override_file",
                            .help = "the convention is that of all files, whatever they say",
                            .in_program = false});
}

// Coefficients read from a file, and the metadata found in it.
struct CoefficientsFile {
  Expansion expansion;                                       // in the library's convention
  CoefficientsFormat format = CoefficientsFormat::kShtools;  // found from the content
  Convention convention;                                     // convention of its numbers
  std::vector<std::string> assumed;  // not stated in the file: "normalization 4pi", ...
  // Product named in the file if it is no shape: "gravity_field"; the function is then kOther.
  std::string product;
  std::vector<std::string> passed_over;  // unused entries of the file: "radius '6378136.3'"
};

// Reads coefficients; the content decides the format; "-" is standard input. Throws Io,
// InvalidInput (malformed, truncated, m > l, not finite, a degree above kMaxDegree), Unsupported.
CoefficientsFile read_coefficients(const std::filesystem::path& path,
                                   const CoefficientsReadOptions& options = {},
                                   const Context& context = {});
// Parses bytes in memory; `name` is used for messages, and its extension for the format.
CoefficientsFile parse_coefficients(std::span<const char> bytes, const std::string& name,
                                    const CoefficientsReadOptions& options = {});

// Returns true if the bytes begin like one of the formats above. Bare text is not recognised: only
// its lines distinguish it from points.
bool looks_like_coefficients(std::span<const char> bytes);

// Options for writing coefficients.
struct CoefficientsWriteOptions {
  std::optional<CoefficientsFormat> format = {};  // empty: from the extension
  Convention convention = {};                     // convention of the numbers; stored if possible
};
// Lists the fields of CoefficientsWriteOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CoefficientsWriteOptions>, const Visitor& field) {
  using O = CoefficientsWriteOptions;
  field(&O::format,
        {.name = "format", .help = "format of the output, instead of the one its extension names"});
  field(&O::convention, {.name = "convention",
                         .help = "of the numbers; the file says it if it can",
                         .in_program = false});
}

// Writes coefficients with the shortest digits that read back the same. "-" is standard output.
void write_coefficients(const Expansion& expansion, const std::filesystem::path& path,
                        const CoefficientsWriteOptions& options = {});

// Throws InvalidInput unless the text can be the name of a length unit in every format: one line of
// UTF-8 text of at most 256 bytes, without blanks at its ends.
void check_unit(const std::string& unit);

}  // namespace rholm
