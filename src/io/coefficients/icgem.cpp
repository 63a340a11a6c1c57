// ICGEM-like text: a header of lines `key value` up to `end_of_head`, then lines `gfc l m C S`. The
// format is made for gravity fields, which have a gravity constant and a reference radius
// (Expansion::gravity). A shape has neither, and both are ignored. The function of a file without a
// shape is `other`. Keys that begin with `rholm_` hold what standard keys cannot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/cancel.h"
#include "base/plain_text.h"
#include "io/coefficients/codec.h"
#include "io/coefficients/expansion_check.h"
#include "io/coefficients/text_table.h"
#include "io/file/bytes.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

constexpr std::string_view kOwnPrefix = "rholm_";
constexpr std::string_view kProduct = "shape";
constexpr std::string_view kOtherProduct = "other";
constexpr std::string_view kGravityProduct = "gravity_field";

// Returns ICGEM's word for the 4-pi normalization, and our words for other normalizations.
const char* norm_name(Normalization normalization) {
  return normalization == Normalization::kFourPi ? "fully_normalized" : to_string(normalization);
}

Normalization parse_norm(std::string_view value, const TextLine& line) {
  if (value == "fully_normalized") return Normalization::kFourPi;
  if (value == "orthonormal") return Normalization::kOrthonormal;
  if (value == "schmidt") return Normalization::kSchmidt;
  throw Error(ErrorCode::kUnsupported,
              fmt::format("{}: norm is {}: fully_normalized, orthonormal and schmidt are read",
                          *line.name, in_quotes(value)));
}

// Key and value of a header line, unchanged.
struct KeyAndValue {
  std::string_view key, value;
};

struct Header {
  ParsedCoefficients parsed;
  std::optional<int> degree;
  std::optional<int> lines;
  std::optional<std::string> product;
  std::optional<KeyAndValue> gravity_constant, radius;
};

void take_own_key(std::string_view key, std::string_view value, const TextLine& line,
                  Header& header) {
  if (key == "format" && value != "1") {
    throw Error(ErrorCode::kUnsupported, fmt::format("{}: rholm_format is {}, this version reads 1",
                                                     *line.name, in_quotes(value)));
  }
  if (key == "lines") {
    const auto most = static_cast<int>(n_pairs(kMaxDegree));
    set_once(header.lines, parse_count(value, "rholm_lines", most, line), key, line);
  } else {
    take_description(key, value, line, header.parsed);
  }
}

void take_key(const TextLine& line, Header& header) {
  TextCursor rest{line.content};
  skip_spaces(rest);
  const std::string_view key = take_word(rest);
  const std::string_view value = trimmed({rest.at, static_cast<std::size_t>(rest.end - rest.at)});
  if (key == "max_degree") {
    set_once(header.degree, parse_count(value, "max_degree", kMaxDegree, line), key, line);
  } else if (key == "norm") {
    set_once(header.parsed.normalization, parse_norm(value, line), key, line);
  } else if (key == "product_type") {
    set_once(header.product, std::string(value), key, line);
  } else if (key == "earth_gravity_constant" || key == "gravity_constant") {
    header.gravity_constant = {key, value};
  } else if (key == "radius") {
    header.radius = {key, value};
  } else if (key.starts_with(kOwnPrefix)) {
    take_own_key(key.substr(kOwnPrefix.size()), value, line, header);
  }
}

// Sets the function of a file for which another product or a gravity constant excludes radii.
void settle_function(Header& header) {
  const std::string product =
      header.product.value_or(std::string(header.gravity_constant ? kGravityProduct : kProduct));
  const RadialFunction said = header.parsed.function.value_or(RadialFunction::kOther);
  if (said != RadialFunction::kOther || product == kProduct) return;
  header.parsed.function = RadialFunction::kOther;
  if (product == kOtherProduct) return;
  const std::string shown = in_quotes(product);  // bounded, and without control characters
  header.parsed.product = shown.substr(1, shown.size() - 2);
}

// Returns a finite number above 0, or none; the text may be anything.
std::optional<double> positive(const std::optional<KeyAndValue>& said) {
  const std::optional<double> value = said ? number_of(said->value) : std::nullopt;
  return value && std::isfinite(*value) && *value > 0 ? value : std::nullopt;
}

// Keeps constant and radius of a gravity field if both are there; otherwise ignores them.
void settle_gravity(Header& header) {
  const std::optional<double> constant = positive(header.gravity_constant);
  const std::optional<double> radius = positive(header.radius);
  if (header.parsed.product == kGravityProduct && constant && radius) {
    header.parsed.numbers.gravity_constant = constant;
    header.parsed.numbers.reference_radius = radius;
    return;
  }
  for (const auto& said : {header.gravity_constant, header.radius}) {
    if (!said) continue;
    header.parsed.passed_over.push_back(fmt::format("{} {}", said->key, in_quotes(said->value)));
  }
}

// Skips the free text that precedes `begin_of_head`, if the file has this line.
void pass_free_text(TextCursor& text, const std::string& name) {
  TextCursor ahead = text;
  while (!ahead.at_end()) {
    const std::string_view content = trimmed(take_line(ahead, name).content);
    if (content.starts_with("end_of_head")) return;
    if (content.starts_with("begin_of_head")) text = ahead;
  }
}

Header parse_header(TextCursor& text, const std::string& name) {
  pass_free_text(text, name);
  Header header;
  while (!text.at_end()) {
    const TextLine line = take_line(text, name);
    if (trimmed(line.content).starts_with("end_of_head")) {
      settle_function(header);
      settle_gravity(header);
      return header;
    }
    take_key(line, header);
  }
  throw Error(ErrorCode::kInvalidInput,
              name + ": the header has no line end_of_head: the file is cut off or not ICGEM");
}

}  // namespace

// Looks for a line near the beginning that starts with a word which only ICGEM files have there.
bool looks_like_icgem(std::string_view bytes) {
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

ParsedCoefficients parse_icgem(std::string_view bytes, const std::string& name) {
  TextCursor text{bytes};
  Header header = parse_header(text, name);
  CoefficientTable table;
  const auto take = [&](const TextLine& line, std::span<const std::string_view> fields) {
    if (fields[0] == "gfct" || fields[0] == "trnd" || fields[0] == "acos" || fields[0] == "asin") {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{}: it has coefficients that vary in time ({}): only gfc is read",
                              name, fields[0]));
    }
    if (fields[0] != "gfc") {
      refuse_line(line, "it begins with " + in_quotes(fields[0]) + " instead of gfc");
    }
    if (fields.size() < 2) refuse_line(line, "gfc without numbers: it must be gfc l m C S");
    table.add(fields.subspan(1), line);
  };
  const bool last_line_complete = visit_lines(text, name, take);
  check_line_count(header.lines, table, last_line_complete, name);
  header.parsed.external = table.assemble(header.degree, name);
  return header.parsed;
}

std::string format_icgem(const Expansion& expansion, const Coefficients& external,
                         const Convention& convention) {
  const int degree = external.degree();
  const std::optional<GravityField>& gravity = expansion.gravity;
  const std::string_view product = gravity                                        ? kGravityProduct
                                   : expansion.function == RadialFunction::kOther ? kOtherProduct
                                                                                  : kProduct;
  std::string text = fmt::format("product_type {}\nmodelname rholm\n", product);
  if (gravity) {
    text += fmt::format("earth_gravity_constant {}\nradius {}\n", gravity->gravity_constant,
                        gravity->reference_radius);
  }
  text += fmt::format(
      "max_degree {}\nerrors no\nnorm {}\nrholm_format 1\nrholm_lines {}\nrholm_csphase {}\n",
      degree, norm_name(convention.normalization), n_pairs(degree), convention.csphase);
  for (const auto& [key, value] : describe(expansion)) {
    const bool stands_above = key == "gravity_constant" || key == "reference_radius";
    if (!stands_above) text += fmt::format("{}{} {}\n", kOwnPrefix, key, value);
  }
  text += "key l m C S\nend_of_head\n";
  CancelPoll poll;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      poll();
      text += "gfc ";
      append_pair(text, l, m, external);
    }
  }
  return text;
}

}  // namespace rholm
