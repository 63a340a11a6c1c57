#include "cli/values.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "cli/parse.h"
#include "rholm/coefficients.h"

namespace rholm::cli {
namespace {

// The whole of `text` as a number.
template <typename Number>
bool read_number(const std::string& text, Number& number) {
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, number);
  return error == std::errc() && rest == end && rest != begin;
}

}  // namespace

std::optional<double> read_number(const std::string& text) {
  double number = 0;
  if (!read_number(text, number) || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<int> parse_degrees(const std::string& option, const std::string& text) {
  std::vector<int> degrees;
  for (const std::string& part : split(text, ',')) {
    int degree = 0;
    if (!read_number(part, degree) || degree < 0 || degree > kMaxDegree) {
      throw UsageError(fmt::format("{} is '{}'; it must be degrees within 0 ... {}, as in 4,16,64",
                                   option, text, kMaxDegree));
    }
    degrees.push_back(degree);
  }
  return degrees;
}

std::array<int, 2> parse_size(const std::string& option, const std::string& text, int min,
                              int max) {
  const std::vector<std::string> parts = split(text, 'x');
  std::array<int, 2> size = {};
  if (parts.size() == 2 && read_number(parts[0], size[0]) && read_number(parts[1], size[1]) &&
      std::min(size[0], size[1]) >= min && std::max(size[0], size[1]) <= max) {
    return size;
  }
  throw UsageError(fmt::format("{} is '{}'; it must be two numbers within {} ... {}, as in 640x480",
                               option, text, min, max));
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    double number = 0;
    if (!read_number(part, number) || !std::isfinite(number)) break;
    numbers.push_back(number);
  }
  if (numbers.size() != count || split(text, ',').size() != count) {
    throw UsageError(fmt::format("{} is '{}'; it must be {} finite numbers separated by commas",
                                 option, text, count));
  }
  return numbers;
}

Vec3 parse_vector(const std::string& option, const std::string& text) {
  const std::vector<double> numbers = parse_numbers(option, text, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace rholm::cli
