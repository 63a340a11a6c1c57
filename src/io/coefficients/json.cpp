// Coefficients as plain JSON, read as a stream of events. No tree is built, so that deep nesting or
// a foreign file costs no more memory than the numbers that are kept. Only this file uses
// nlohmann/json for coefficients.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/cancel.h"
#include "base/plain_text.h"
#include "io/coefficients/codec.h"
#include "io/coefficients/text_table.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr const char* kFormat = "rholm-coefficients";
constexpr int kVersion = 1;
constexpr std::size_t kMaxDepth = 64;  // chosen: far beyond any use of unknown keys

// The rows l = 0 ... of "C" or "S", where row l has m = 0 ... l.
struct Rows {
  bool given = false;
  std::size_t count = 0;
  std::vector<double> values;
};

class Handler : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Handler(const std::string& name) : name_(name) {}

  bool null() override { return simple_value("null"); }
  bool boolean(bool) override { return simple_value("true or false"); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool binary(binary_t&) override { return simple_value("binary"); }
  bool string(string_t& value) override;
  bool key(string_t& value) override;
  bool start_object(std::size_t) override;
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception&) override {
    refuse(fmt::format("not valid JSON at byte {} (or a number out of range)", position));
  }

  ParsedCoefficients finish();

 private:
  enum class Place { kTop, kCenter, kCoefficients, kRows, kRow, kUnknown };

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorCode::kInvalidInput, name_ + ": " + what);
  }
  [[noreturn]] void refuse_kind(const std::string& kind) const {
    refuse(kind + " is not what belongs at the key " + in_quotes(key_));
  }
  bool is_at(Place place) const { return !places_.empty() && places_.back() == place; }
  // Returns where the number of the current key is stored, or null if it is not a known number.
  std::optional<double>* known_number();
  bool is_known_key();
  bool enter(Place place);
  bool leave();
  bool number(double value);
  void top_number(double value);
  bool simple_value(const char* kind);

  const std::string& name_;
  CancelPoll poll_;
  ParsedCoefficients parsed_;
  std::vector<Place> places_;
  std::set<std::string> keys_;  // keys seen at the top level
  std::string key_;
  bool has_format_ = false;
  std::vector<double> center_;
  int degree_ = -1;
  Rows c_;
  Rows s_;
  Rows* rows_ = nullptr;  // the rows being read
  std::size_t row_start_ = 0;
};

std::optional<double>* Handler::known_number() {
  for (const KnownNumber& number : kKnownNumbers) {
    if (key_ == number.name) return &(parsed_.numbers.*number.value);
  }
  return nullptr;
}

bool Handler::is_known_key() {
  static const std::set<std::string_view> kKnown = {
      "format", "version", "degree", "normalization", "csphase",     "function",
      "center", "unit",    "method", "signed_sum",    "coefficients"};
  return kKnown.contains(key_) || known_number() != nullptr;
}

bool Handler::enter(Place place) {
  if (places_.size() >= kMaxDepth) {
    refuse(fmt::format("nested deeper than {} levels", kMaxDepth));
  }
  places_.push_back(place);
  return true;
}

bool Handler::leave() {
  places_.pop_back();
  return true;
}

bool Handler::start_object(std::size_t) {
  if (places_.empty()) return enter(Place::kTop);
  if (is_at(Place::kUnknown)) return enter(Place::kUnknown);
  if (is_at(Place::kTop) && key_ == "coefficients") return enter(Place::kCoefficients);
  if (is_at(Place::kTop) && !is_known_key()) return enter(Place::kUnknown);
  refuse_kind("an object");
}

bool Handler::start_array(std::size_t) {
  if (places_.empty()) refuse("it is an array, not an object with the key 'coefficients'");
  if (is_at(Place::kUnknown)) return enter(Place::kUnknown);
  if (is_at(Place::kTop) && key_ == "center") return enter(Place::kCenter);
  if (is_at(Place::kTop) && !is_known_key()) return enter(Place::kUnknown);
  if (is_at(Place::kCoefficients)) return enter(Place::kRows);
  if (is_at(Place::kRows)) {
    row_start_ = rows_->values.size();
    return enter(Place::kRow);
  }
  refuse_kind("an array");
}

bool Handler::end_array() {
  if (is_at(Place::kCenter) && center_.size() != 3) {
    refuse(fmt::format("center has {} numbers instead of 3", center_.size()));
  }
  if (is_at(Place::kRow)) {
    const std::size_t length = rows_->values.size() - row_start_;
    if (length != rows_->count + 1) {
      refuse(fmt::format("row l = {} of '{}' has {} numbers: it must have one for m = 0 to {}",
                         rows_->count, key_, length, rows_->count));
    }
    if (++rows_->count > kMaxDegree + std::size_t{1}) {
      refuse(fmt::format("'{}' has more rows than degree {} needs, the limit", key_, kMaxDegree));
    }
  }
  return leave();
}

bool Handler::key(string_t& value) {
  if (is_at(Place::kUnknown)) return true;
  key_ = value;
  if (is_at(Place::kTop)) {
    if (!keys_.insert(value).second) refuse("the key " + in_quotes(value) + " is given twice");
    return true;
  }
  if (value != "C" && value != "S") {
    refuse("coefficients have the key " + in_quotes(value) + " instead of 'C' or 'S'");
  }
  rows_ = value == "C" ? &c_ : &s_;
  if (rows_->given) refuse("'" + value + "' is given twice");
  rows_->given = true;
  return true;
}

bool Handler::number(double value) {
  poll_();
  if (is_at(Place::kRow)) {
    rows_->values.push_back(value);
  } else if (is_at(Place::kCenter)) {
    if (center_.size() == 3) refuse("center has more than 3 numbers");
    center_.push_back(value);
  } else if (is_at(Place::kTop)) {
    top_number(value);
  } else if (!is_at(Place::kUnknown)) {
    refuse_kind("a number");
  }
  return true;
}

void Handler::top_number(double value) {
  if (key_ == "version") {
    if (value != kVersion) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{}: version {}: this program reads {}", name_, value, kVersion));
    }
  } else if (key_ == "degree") {
    if (!(value >= 0 && value <= kMaxDegree && value == std::floor(value))) {
      refuse(
          fmt::format("degree is {}: it must be a whole number from 0 to {}", value, kMaxDegree));
    }
    degree_ = static_cast<int>(value);
  } else if (key_ == "csphase") {
    if (value != 1 && value != -1) refuse(fmt::format("csphase is {}: it must be 1 or -1", value));
    parsed_.csphase = static_cast<int>(value);
  } else if (std::optional<double>* number = known_number()) {
    *number = value;
  } else if (key_ == "signed_sum") {
    if (value != 0 && value != 1) refuse(fmt::format("signed_sum is {}: it must be 0 or 1", value));
    parsed_.signed_sum = value == 1;
  } else if (is_known_key()) {
    refuse_kind("a number");
  }
}

bool Handler::string(string_t& value) {
  if (is_at(Place::kUnknown)) return true;
  if (!is_at(Place::kTop)) refuse_kind("a string");
  if (key_ == "format") {
    if (value != kFormat) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{}: the format is {}, not '{}'", name_, in_quotes(value), kFormat));
    }
    has_format_ = true;
  } else if (key_ == "normalization") {
    parsed_.normalization = parse_name<Normalization>(value);
  } else if (key_ == "function") {
    parsed_.function = parse_name<RadialFunction>(value);
  } else if (key_ == "unit") {
    parsed_.unit = value;
  } else if (key_ == "method") {
    parsed_.method = value;
  } else if (is_known_key()) {
    refuse_kind("a string");
  }
  return true;
}

bool Handler::simple_value(const char* kind) {
  if (!is_at(Place::kUnknown) && !(is_at(Place::kTop) && !is_known_key())) refuse_kind(kind);
  return true;
}

ParsedCoefficients Handler::finish() {
  if (!has_format_) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{}: JSON without \"format\": \"{}\"", name_, kFormat));
  }
  if (c_.count == 0 || s_.count != c_.count) {
    refuse(fmt::format("coefficients have {} rows of 'C' and {} of 'S': both must have degree + 1",
                       c_.count, s_.count));
  }
  const int degree = static_cast<int>(c_.count) - 1;
  if (degree_ >= 0 && degree_ != degree) {
    refuse(fmt::format("it says degree {} but has rows up to {}", degree_, degree));
  }
  parsed_.external = Coefficients(degree);
  std::size_t pair = 0;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m, ++pair) {
      poll_();
      parsed_.external.c(l, m) = c_.values[pair];
      parsed_.external.s(l, m) = s_.values[pair];
    }
  }
  if (!center_.empty()) parsed_.center = Vec3{center_[0], center_[1], center_[2]};
  return std::move(parsed_);
}

// Appends the shortest digits, with "-0.0" for -0, because "-0" reads back as the integer 0.
void append_number(std::string& text, double value) {
  char buffer[kMaxNumberLength];
  const std::string_view digits(buffer, format_number(buffer, value) - buffer);
  text += digits == "-0" ? "-0.0" : digits;
}

void append_rows(std::string& text, const Coefficients& external, bool sine) {
  CancelPoll poll;
  for (int l = 0; l <= external.degree(); ++l) {
    text += l == 0 ? "[\n[" : ",\n[";
    for (int m = 0; m <= l; ++m) {
      poll();
      if (m > 0) text += ',';
      append_number(text, sine ? external.s(l, m) : external.c(l, m));
    }
    text += ']';
  }
  text += ']';
}

}  // namespace

bool looks_like_json(std::string_view bytes) {
  const std::string_view text = trimmed(bytes.substr(0, kHeaderBytes));
  return text.starts_with('{') || text.starts_with('[');
}

bool is_own_json(std::string_view bytes) {
  return bytes.find(fmt::format("\"{}\"", kFormat)) != std::string_view::npos;
}

ParsedCoefficients parse_json(std::string_view bytes, const std::string& name) {
  Handler handler(name);
  nlohmann::json::sax_parse(bytes.begin(), bytes.end(), &handler);
  return handler.finish();
}

std::string format_json(const Expansion& expansion, const Coefficients& external,
                        const Convention& convention) {
  const Vec3& center = expansion.center;
  std::string text = fmt::format(
      "{{\"format\":\"{}\",\"version\":{},\"degree\":{},\n"
      "\"normalization\":\"{}\",\"csphase\":{},\"function\":\"{}\",\n\"center\":[",
      kFormat, kVersion, external.degree(), to_string(convention.normalization), convention.csphase,
      to_string(expansion.function));
  append_number(text, center.x);
  text += ',';
  append_number(text, center.y);
  text += ',';
  append_number(text, center.z);
  text += "],\n\"unit\":" + nlohmann::json(expansion.unit).dump();
  text += ",\"method\":" + nlohmann::json(expansion.method).dump();
  const KnownNumbers numbers = known_numbers(expansion);
  for (const KnownNumber& number : kKnownNumbers) {
    const std::optional<double>& value = numbers.*number.value;
    if (!value) continue;
    text += fmt::format(",\n\"{}\":", number.name);
    append_number(text, *value);
  }
  if (expansion.signed_sum) text += ",\n\"signed_sum\":1";
  text += ",\n\"coefficients\":{\"C\":";
  append_rows(text, external, false);
  text += ",\n\"S\":";
  append_rows(text, external, true);
  return text + "}}\n";
}

}  // namespace rholm
