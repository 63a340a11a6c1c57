#include "io/coefficients/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/plain_text.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// A file may leave out zeros, but one short line must not cost gigabytes. Up to this degree any
// pairs may be missing (16 MiB of coefficients). Above it, at least one pair in kSparsity must have
// a line. Chosen so that memory stays below 64 times the file's size: a line has at least 8 bytes,
// a pair takes 32 bytes in the square array.
constexpr int kFreeDegree = 1023;
constexpr std::size_t kSparsity = 16;

std::string format_shortest(double value) {
  char buffer[kMaxNumberLength];
  return {buffer, format_number(buffer, value)};
}

Vec3 parse_center_value(std::string_view value, const TextLine& line) {
  std::vector<std::string_view> fields;
  split_fields(value, fields);
  if (fields.size() != 3) {
    refuse_line(line, "center is " + in_quotes(value) + ": it must be three numbers x y z");
  }
  return {parse_finite(fields[0], "center", line), parse_finite(fields[1], "center", line),
          parse_finite(fields[2], "center", line)};
}

void set_text_once(std::string& slot, std::string_view value, std::string_view key,
                   const TextLine& line) {
  if (!slot.empty()) refuse_line(line, "the key " + in_quotes(key) + " is given twice: delete one");
  slot = value;
}

// Returns false if the key does not name a known number.
bool take_known_number(std::string_view key, std::string_view value, const TextLine& line,
                       ParsedCoefficients& parsed) {
  for (const KnownNumber& number : kKnownNumbers) {
    if (key != number.name) continue;
    set_once(parsed.numbers.*number.value, parse_finite(value, number.name, line), key, line);
    return true;
  }
  return false;
}

}  // namespace

TextLine take_line(TextCursor& text, const std::string& name) {
  TextLine line{.text = text, .name = &name};
  skip_to_line_end(text);
  line.content = {line.text.at, static_cast<std::size_t>(text.at - line.text.at)};
  line.complete = !text.at_end();
  if (!text.at_end() && *text.at == '\r') ++text.at;
  if (!text.at_end() && *text.at == '\n') ++text.at;
  return line;
}

void refuse_line(const TextLine& line, const std::string& what) {
  fail_at_line(*line.name, line.text, what);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  constexpr std::string_view kSeparators = " \t,";
  fields.clear();
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(kSeparators), line.size()));
    if (line.empty()) return;
    const std::size_t length = std::min(line.find_first_of(kSeparators), line.size());
    fields.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

std::optional<double> number_of(std::string_view text) {
  std::string with_e;
  if (text.find_first_of("dD") != std::string_view::npos) {
    with_e = text;
    std::replace_if(
        with_e.begin(), with_e.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    text = with_e;
  }
  TextCursor number{text};
  double value = 0;
  if (!take_number(number, value) || !number.at_end()) return std::nullopt;
  return value;
}

double parse_finite(std::string_view text, const char* what, const TextLine& line) {
  const std::optional<double> value = number_of(text);
  if (!value) {
    refuse_line(line, fmt::format("{} is {}: it must be a number in the range of double precision",
                                  what, in_quotes(text)));
  }
  if (!std::isfinite(*value)) {
    refuse_line(line, fmt::format("{} is {}: it must be finite", what, in_quotes(text)));
  }
  return *value;
}

int parse_count(std::string_view text, const char* what, int limit, const TextLine& line) {
  TextCursor number{text};
  int value = 0;
  if (!take_integer(number, value) || !number.at_end() || value < 0 || value > limit) {
    refuse_line(line, fmt::format("{} is {}: it must be a whole number from 0 to {}", what,
                                  in_quotes(text), limit));
  }
  return value;
}

void CoefficientTable::add(std::span<const std::string_view> fields, const TextLine& line) {
  const int l = parse_count(fields[0], "degree l", kMaxDegree, line);
  if (fields.size() < 3 || (fields.size() == 3 && fields[1] != "0")) {
    refuse_line(line,
                fmt::format("{} values: it must be degree l, order m, C and S", fields.size()));
  }
  const int m = parse_count(fields[1], "order m", kMaxDegree, line);
  if (m > l) refuse_line(line, fmt::format("order m = {} exceeds degree l = {}", m, l));
  const double c = parse_finite(fields[2], "C", line);
  const double s = fields.size() > 3 ? parse_finite(fields[3], "S", line) : 0;
  if (m == 0 && s != 0) {
    refuse_line(line, fmt::format("S is {} for m = 0, where it multiplies sin 0: it must be zero",
                                  in_quotes(fields[3])));
  }
  for (std::size_t i = 4; i < fields.size(); ++i) parse_finite(fields[i], "deviation", line);
  entries_.push_back({static_cast<std::uint16_t>(l), static_cast<std::uint16_t>(m), c, s});
  max_degree_ = std::max(max_degree_, l);
}

Coefficients CoefficientTable::assemble(std::optional<int> stated_degree,
                                        const std::string& name) const {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::kInvalidInput, name + ": " + what);
  };
  if (entries_.empty()) refuse("no line with coefficients `l m C S`");
  const int degree = stated_degree.value_or(max_degree_);
  if (max_degree_ > degree) {
    refuse(fmt::format("it says degree {} but has coefficients of degree {}", degree, max_degree_));
  }
  if (degree > kFreeDegree && n_pairs(degree) / kSparsity > entries_.size()) {
    refuse(
        fmt::format("degree {} with {} lines of coefficients: above degree {} at least one in {} "
                    "of the {} pairs (l, m) must be given, be it as zeros",
                    degree, entries_.size(), kFreeDegree, kSparsity, n_pairs(degree)));
  }
  Coefficients result(degree);
  std::vector<bool> seen(n_pairs(degree));
  CancelPoll poll;
  for (const Entry& entry : entries_) {
    poll();
    const std::size_t pair = n_pairs(entry.l - 1) + entry.m;
    if (seen[pair]) refuse(fmt::format("l = {}, m = {} is given twice", entry.l, entry.m));
    seen[pair] = true;
    result.c(entry.l, entry.m) = entry.c;
    result.s(entry.l, entry.m) = entry.s;
  }
  return result;
}

std::vector<std::pair<std::string, std::string>> describe(const Expansion& expansion) {
  const Vec3& center = expansion.center;
  std::vector<std::pair<std::string, std::string>> pairs = {
      {"function", to_string(expansion.function)},
      {"center", format_shortest(center.x) + " " + format_shortest(center.y) + " " +
                     format_shortest(center.z)}};
  if (!expansion.unit.empty()) pairs.emplace_back("unit", expansion.unit);
  if (!expansion.method.empty()) pairs.emplace_back("method", expansion.method);
  const KnownNumbers numbers = known_numbers(expansion);
  for (const KnownNumber& number : kKnownNumbers) {
    const std::optional<double>& value = numbers.*number.value;
    if (value) pairs.emplace_back(number.name, format_shortest(*value));
  }
  if (expansion.signed_sum) pairs.emplace_back("signed_sum", "1");
  return pairs;
}

bool take_description(std::string_view key, std::string_view value, const TextLine& line,
                      ParsedCoefficients& parsed) {
  if (key == "csphase") {
    if (value != "1" && value != "+1" && value != "-1") {
      refuse_line(line, "csphase is " + in_quotes(value) + ": it must be 1 or -1");
    }
    set_once(parsed.csphase, value == "-1" ? -1 : 1, key, line);
  } else if (key == "function") {
    if (value != "radius" && value != "gauge" && value != "other") {
      refuse_line(line, "function is " + in_quotes(value) + ": it must be radius, gauge or other");
    }
    set_once(parsed.function, parse_name<RadialFunction>(std::string(value)), key, line);
  } else if (key == "center") {
    set_once(parsed.center, parse_center_value(value, line), key, line);
  } else if (key == "unit") {
    set_text_once(parsed.unit, value, key, line);
  } else if (key == "method") {
    set_text_once(parsed.method, value, key, line);
  } else if (key == "signed_sum") {
    if (value != "0" && value != "1") {
      refuse_line(line, "signed_sum is " + in_quotes(value) + ": it must be 0 or 1");
    }
    parsed.signed_sum = value == "1";
  } else {
    return take_known_number(key, value, line, parsed);
  }
  return true;
}

void append_pair(std::string& text, int l, int m, const Coefficients& external) {
  char line[4 * kMaxNumberLength];
  char* end = format_number(line, l);
  *end++ = ' ';
  end = format_number(end, m);
  *end++ = ' ';
  end = format_number(end, external.c(l, m));
  *end++ = ' ';
  end = format_number(end, external.s(l, m));
  *end++ = '\n';
  text.append(line, end);
}

void check_line_count(std::optional<int> stated, const CoefficientTable& table,
                      bool last_line_complete, const std::string& name) {
  if (!stated) return;
  if (table.size() != static_cast<std::size_t>(*stated)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{}: it says {} lines of coefficients but has {}: it is cut off, or "
                            "edited (then correct that number)",
                            name, *stated, table.size()));
  }
  if (!last_line_complete) {
    throw Error(ErrorCode::kInvalidInput,
                name + ": the last line has no line end: it may be cut off within its number");
  }
}

}  // namespace rholm
