// ICGEM-like text: a header of lines `key value` up to `end_of_head`, then lines `gfc l m C S`.
// The format is made for gravity fields; a shape has no gravity constant and no reference radius,
// so none is written, and those of a file are passed over. What is no shape has the function
// `other`. Keys that begin with `rholm_` say what the standard ones cannot.
#include <fmt/format.h>

#include <optional>

#include "io/coefficients/codec.h"
#include "io/coefficients/text_table.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::string_view kOwnPrefix = "rholm_";
constexpr std::string_view kProduct = "shape";
constexpr std::string_view kOtherProduct = "other";

// ICGEM's word for the 4-pi normalization, and ours for what it has no word for.
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

struct Header {
  ParsedCoefficients parsed;
  std::optional<int> degree;
  std::optional<int> lines;
  std::optional<std::string> product;
  bool has_gravity_constant = false;
};

void pass_over(std::string_view key, std::string_view value, Header& header) {
  header.parsed.passed_over.push_back(fmt::format("{} {}", key, in_quotes(value)));
}

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
    header.has_gravity_constant = true;
    pass_over(key, value, header);
  } else if (key == "radius") {
    pass_over(key, value, header);
  } else if (key.starts_with(kOwnPrefix)) {
    take_own_key(key.substr(kOwnPrefix.size()), value, line, header);
  }
}

// What a file says to be no shape, or of a gravity constant, are not radii, unless it says so.
void settle_function(Header& header) {
  const std::string product =
      header.product.value_or(header.has_gravity_constant ? "gravity_field" : "shape");
  if (header.parsed.function || product == kProduct) return;
  header.parsed.function = RadialFunction::kOther;
  if (product == kOtherProduct) return;
  const std::string shown = in_quotes(product);  // bounded, and without control characters
  header.parsed.product = shown.substr(1, shown.size() - 2);
}

// Before `begin_of_head`, if a file has it, stands free text.
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
      return header;
    }
    take_key(line, header);
  }
  throw Error(ErrorCode::kInvalidInput,
              name + ": the header has no line end_of_head: the file is cut off or not ICGEM");
}

}  // namespace

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
  std::string text = fmt::format(
      "product_type {}\nmodelname rholm\nmax_degree {}\nerrors no\nnorm {}\n"
      "rholm_format 1\nrholm_lines {}\nrholm_csphase {}\n",
      expansion.function == RadialFunction::kOther ? kOtherProduct : kProduct, degree,
      norm_name(convention.normalization), n_pairs(degree), convention.csphase);
  for (const auto& [key, value] : describe(expansion)) {
    text += fmt::format("{}{} {}\n", kOwnPrefix, key, value);
  }
  text += "key l m C S\nend_of_head\n";
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      text += "gfc ";
      append_pair(text, l, m, external);
    }
  }
  return text;
}

}  // namespace rholm
