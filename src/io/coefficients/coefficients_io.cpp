#include "rholm/coefficients_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/coefficients/codec.h"
#include "io/coefficients/expansion_check.h"
#include "io/coefficients/text_table.h"
#include "io/file/bytes.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
// How far the header of a text is looked for. Chosen: ICGEM files begin with free text, of a few
// kilobytes in those published.
constexpr std::size_t kHeaderBytes = 65536;

// Some line at the beginning starts with a word that only ICGEM files have there.
bool has_icgem_line(std::string_view bytes) {
  bytes = bytes.substr(0, kHeaderBytes);
  while (!bytes.empty()) {
    const std::size_t length = std::min(bytes.find('\n'), bytes.size());
    const std::string_view line = trimmed(bytes.substr(0, length));
    for (const std::string_view word :
         {"begin_of_head", "end_of_head", "product_type", "max_degree", "gfc ", "gfc\t"}) {
      if (line.starts_with(word)) return true;
    }
    bytes.remove_prefix(std::min(length + 1, bytes.size()));
  }
  return false;
}

CoefficientsFormat detect_format(std::string_view bytes) {
  if (bytes.starts_with(kNpyMagic)) return CoefficientsFormat::kNpy;
  const std::string_view text = trimmed(bytes.substr(0, kHeaderBytes));
  if (text.starts_with('{') || text.starts_with('[')) return CoefficientsFormat::kJson;
  return has_icgem_line(bytes) ? CoefficientsFormat::kIcgem : CoefficientsFormat::kShtools;
}

ParsedCoefficients parse_as(CoefficientsFormat format, std::string_view bytes,
                            const std::string& name) {
  switch (format) {
    case CoefficientsFormat::kNpy:
      return parse_npy(bytes, name);
    case CoefficientsFormat::kJson:
      return parse_json(bytes, name);
    case CoefficientsFormat::kIcgem:
      return parse_icgem(bytes, name);
    case CoefficientsFormat::kShtools:
      break;
  }
  return parse_shtools(bytes, name);
}

// The convention of the numbers: what the file says, else the options; what is taken from the
// options without the caller having insisted is listed.
Convention settle_convention(const ParsedCoefficients& parsed,
                             const CoefficientsReadOptions& options,
                             std::vector<std::string>& assumed) {
  if (options.override_file) return options.convention;
  Convention convention = options.convention;
  if (parsed.normalization) {
    convention.normalization = *parsed.normalization;
  } else {
    assumed.push_back(fmt::format("normalization {}", to_string(convention.normalization)));
  }
  if (parsed.csphase) {
    convention.csphase = *parsed.csphase;
  } else {
    assumed.push_back(fmt::format("csphase {}", convention.csphase));
  }
  return convention;
}

}  // namespace

const char* to_string(CoefficientsFormat format) {
  switch (format) {
    case CoefficientsFormat::kShtools:
      return "shtools";
    case CoefficientsFormat::kIcgem:
      return "icgem";
    case CoefficientsFormat::kJson:
      return "json";
    case CoefficientsFormat::kNpy:
      return "npy";
  }
  return "unknown";
}

CoefficientsFormat parse_coefficients_format(const std::string& name) {
  for (const auto format : {CoefficientsFormat::kShtools, CoefficientsFormat::kIcgem,
                            CoefficientsFormat::kJson, CoefficientsFormat::kNpy}) {
    if (name == to_string(format)) return format;
  }
  throw Error(ErrorCode::kUnsupported, "unknown format of coefficients " + in_quotes(name) +
                                           ": shtools, icgem, json and npy are known");
}

std::optional<CoefficientsFormat> coefficients_format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension == ".sh" || extension == ".txt" || extension == ".shtools") {
    return CoefficientsFormat::kShtools;
  }
  if (extension == ".gfc" || extension == ".icgem") return CoefficientsFormat::kIcgem;
  if (extension == ".json") return CoefficientsFormat::kJson;
  if (extension == ".npy") return CoefficientsFormat::kNpy;
  return std::nullopt;
}

bool looks_like_coefficients(std::span<const char> bytes) {
  std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with(kNpyMagic)) return true;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  switch (detect_format(text)) {
    case CoefficientsFormat::kJson:
      return text.find("\"rholm-coefficients\"") != std::string_view::npos;
    case CoefficientsFormat::kShtools:
      return trimmed(text.substr(0, kHeaderBytes)).starts_with("# format: rholm-coefficients");
    case CoefficientsFormat::kIcgem:
    case CoefficientsFormat::kNpy:
      return true;
  }
  return false;
}

CoefficientsFile parse_coefficients(std::span<const char> bytes, const std::string& name,
                                    const CoefficientsReadOptions& options) {
  std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.empty()) throw Error(ErrorCode::kInvalidInput, name + ": the file is empty");

  CoefficientsFile file;
  file.format = detect_format(text);
  ParsedCoefficients parsed = parse_as(file.format, text, name);
  check_coefficients(parsed.external, name);
  file.convention = settle_convention(parsed, options, file.assumed);
  Expansion& expansion = file.expansion;
  expansion.coefficients = from_convention(parsed.external, file.convention);
  if (!parsed.function) file.assumed.emplace_back("function radius");
  expansion.function = parsed.function.value_or(RadialFunction::kRadius);
  if (!parsed.center) file.assumed.emplace_back("center 0 0 0");
  expansion.center = parsed.center.value_or(Vec3{});
  expansion.unit = std::move(parsed.unit);
  expansion.method = std::move(parsed.method);
  set_known_numbers(parsed.numbers, name, expansion);
  expansion.signed_sum = parsed.signed_sum;
  file.product = std::move(parsed.product);
  file.passed_over = std::move(parsed.passed_over);
  check_expansion(expansion, name);
  return file;
}

CoefficientsFile read_coefficients(const std::filesystem::path& path,
                                   const CoefficientsReadOptions& options, const Context& context) {
  const Bytes bytes = read_bytes(path, context);
  return parse_coefficients(bytes.view(), path == "-" ? "standard input" : path.string(), options);
}

void write_coefficients(const Expansion& expansion, const std::filesystem::path& path,
                        const CoefficientsWriteOptions& options) {
  const std::string name = path == "-" ? "standard output" : path.string();
  const std::optional<CoefficientsFormat> format =
      options.format ? options.format : coefficients_format_of(path);
  if (!format) {
    throw Error(ErrorCode::kUnsupported,
                name +
                    ": its name says no format of coefficients: end it in .h5 (a model file), .sh, "
                    ".gfc, .json or .npy, or give the format");
  }
  check_expansion(expansion, name);
  const Coefficients external = to_convention(expansion.coefficients, options.convention);
  check_coefficients(external, name);  // the largest numbers may overflow with a factor above 1
  std::string bytes;
  switch (*format) {
    case CoefficientsFormat::kShtools:
      bytes = format_shtools(expansion, external, options.convention);
      break;
    case CoefficientsFormat::kIcgem:
      bytes = format_icgem(expansion, external, options.convention);
      break;
    case CoefficientsFormat::kJson:
      bytes = format_json(expansion, external, options.convention);
      break;
    case CoefficientsFormat::kNpy:
      bytes = format_npy(external);
      break;
  }
  write_file(path, bytes);
}

}  // namespace rholm
