#include "io/coefficients/coefficients_formats.h"

namespace rholm {
namespace {

std::vector<CoefficientsFormatLine> coefficients_format_lines() {
  return {
      {.info = {.format = std::nullopt,
                .file = {.name = "h5",
                         .title = "HDF5 model",
                         .extensions = {{"h5"}, {"hdf5"}},
                         .binary = true,
                         .read = true,
                         .written = true,
                         .help = "HDF5: all that is known of a model, or an atlas of caps"},
                .meaning = true,
                .errors = true}},
      {.info = {.format = CoefficientsFormat::kShtools,
                .file = {.name = "shtools",
                         .title = "SHTOOLS",
                         .extensions = {{"sh"}, {.name = "txt", .shared = true}, {"shtools"}},
                         .text = true,
                         .help = "A line `l m C S` per pair, with the rest in comments"},
                .meaning = true},
       .is_surely = is_own_shtools,
       .parse = parse_shtools,
       .write = format_shtools},
      {.info = {.format = CoefficientsFormat::kIcgem,
                .file = {.name = "icgem",
                         .title = "ICGEM",
                         .extensions = {{"gfc"}, {"icgem"}},
                         .text = true,
                         .help = "The text of gravity models: a header and lines `gfc l m C S`"},
                .meaning = true},
       .told_by = ToldBy::kLines,
       .looks_like = looks_like_icgem,
       .is_surely = looks_like_icgem,
       .parse = parse_icgem,
       .write = format_icgem},
      {.info = {.format = CoefficientsFormat::kJson,
                .file = {.name = "json",
                         .title = "JSON",
                         .extensions = {{"json"}},
                         .text = true,
                         .help = "An object with the coefficients and what they mean"},
                .meaning = true},
       .told_by = ToldBy::kFirstWord,
       .looks_like = looks_like_json,
       .is_surely = is_own_json,
       .parse = parse_json,
       .write = format_json},
      {.info = {.format = CoefficientsFormat::kNpy,
                .file = {.name = "npy",
                         .title = "NumPy",
                         .extensions = {{"npy"}},
                         .binary = true,
                         .help = "An array (2, L+1, L+1) of numbers and nothing else"}},
       .told_by = ToldBy::kSignature,
       .looks_like = looks_like_npy,
       .is_surely = looks_like_npy,
       .parse = parse_npy,
       .write = format_npy}};
}

}  // namespace

const std::vector<CoefficientsFormatLine>& coefficients_format_table() {
  static const std::vector<CoefficientsFormatLine> table = [] {
    std::vector<CoefficientsFormatLine> lines = coefficients_format_lines();
#ifdef RHOLM_EXTRA_COEFFICIENTS_FORMATS  // tests/cli/made_up_formats.cpp adds a line here
    lines.push_back(
#include RHOLM_EXTRA_COEFFICIENTS_FORMATS
    );
#endif
    for (CoefficientsFormatLine& line : lines) {
      line.info.file.read |= line.parse != nullptr;
      line.info.file.written |= line.write != nullptr;
    }
    return lines;
  }();
  return table;
}

}  // namespace rholm
