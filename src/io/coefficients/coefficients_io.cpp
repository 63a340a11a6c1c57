#include "rholm/coefficients_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/plain_text.h"
#include "io/coefficients/coefficients_formats.h"
#include "io/coefficients/expansion_check.h"
#include "io/file/bytes.h"
#include "io/file/number_text.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Finds the format of the bytes. Plain text that no format claims gets the kNothing format.
const CoefficientsFormatLine& detect(std::string_view bytes) {
  const std::vector<CoefficientsFormatLine>& table = coefficients_format_table();
  for (const ToldBy by : {ToldBy::kSignature, ToldBy::kFirstWord, ToldBy::kLines}) {
    for (const CoefficientsFormatLine& line : table) {
      if (line.told_by == by && line.looks_like != nullptr && line.looks_like(bytes)) return line;
    }
  }
  return *std::find_if(table.begin(), table.end(), [](const CoefficientsFormatLine& line) {
    return line.told_by == ToldBy::kNothing && line.parse != nullptr;
  });
}

// Returns the names of all formats but the model file.
std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (format.format) names.push_back(format.file.name);
  }
  return names;
}

// Returns the convention of the numbers: from the file if it states one, otherwise from the
// options. Lists in `assumed` what comes from the options, unless the caller overrides the file.
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

const CoefficientsFormatLine& line_of(CoefficientsFormat format) {
  const std::vector<CoefficientsFormatLine>& table = coefficients_format_table();
  const auto found =
      std::find_if(table.begin(), table.end(),
                   [&](const CoefficientsFormatLine& line) { return line.info.format == format; });
  if (found != table.end()) return *found;
  throw Error(ErrorCode::kUnsupported,
              fmt::format("no format of coefficients has the number {}", static_cast<int>(format)));
}

const std::vector<CoefficientsFormatInfo>& coefficients_formats() {
  static const std::vector<CoefficientsFormatInfo> formats = [] {
    std::vector<CoefficientsFormatInfo> all;
    for (const CoefficientsFormatLine& line : coefficients_format_table()) {
      all.push_back(line.info);
    }
    return all;
  }();
  return formats;
}

const CoefficientsFormatInfo& coefficients_format_info(CoefficientsFormat format) {
  return line_of(format).info;
}

std::vector<std::string> held_by(const CoefficientsFormatInfo& format) {
  return words_of({{"meaning", format.meaning}, {"errors", format.errors}});
}

const char* to_string(CoefficientsFormat format) { return line_of(format).info.file.name.c_str(); }

CoefficientsFormat parse_coefficients_format(const std::string& name) {
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (format.format && name == format.file.name) return *format.format;
  }
  throw Error(ErrorCode::kUnsupported, "unknown format of coefficients " + in_quotes(name) + ": " +
                                           listed(format_names(), "and") + " are known");
}

std::optional<CoefficientsFormat> coefficients_format_of(const std::filesystem::path& path) {
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (format.format && extension_of(format.file, path) != nullptr) return format.format;
  }
  return std::nullopt;
}

bool is_model_name(const std::filesystem::path& path) {
  return std::ranges::any_of(coefficients_formats(), [&](const CoefficientsFormatInfo& format) {
    return !format.format && extension_of(format.file, path) != nullptr;
  });
}

bool looks_like_coefficients(std::span<const char> bytes) {
  std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const CoefficientsFormatLine& line = detect(text);
  return line.is_surely != nullptr && line.is_surely(text);
}

CoefficientsFile parse_coefficients(std::span<const char> bytes, const std::string& name,
                                    const CoefficientsReadOptions& options) {
  std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.empty()) throw Error(ErrorCode::kInvalidInput, name + ": the file is empty");

  CoefficientsFile file;
  const CoefficientsFormatLine& format = detect(text);
  file.format = *format.info.format;
  ParsedCoefficients parsed = format.parse(text, name);
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
    std::vector<std::string> ends;
    for (const CoefficientsFormatInfo& known : coefficients_formats()) {
      ends.push_back("." + known.file.extensions.front().name +
                     (known.format ? "" : " (a model file)"));
    }
    throw Error(ErrorCode::kUnsupported,
                name + ": its name says no format of coefficients: end it in " +
                    listed(ends, "or") + ", or give the format");
  }
  check_expansion(expansion, name);
  const Coefficients external = to_convention(expansion.coefficients, options.convention);
  check_coefficients(external, name);  // a factor above 1 may make the largest numbers overflow
  write_file(path, line_of(*format).write(expansion, external, options.convention));
}

}  // namespace rholm
