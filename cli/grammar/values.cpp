#include "cli/grammar/values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "cli/grammar/command.h"
#include "rholm/coefficients.h"
#include "rholm/error.h"
#include "rholm/primitives.h"

namespace rholm::cli {
namespace {

// Parses the whole of `text` as a number.
template <typename Number>
bool read_number(const std::string& text, Number& number) {
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, number);
  return error == std::errc() && rest == end && rest != begin;
}

}  // namespace

bool read_whole(const std::string& text, int& number) { return read_number(text, number); }
bool read_whole(const std::string& text, std::uint64_t& number) {
  return read_number(text, number);
}

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
      throw UsageError(
          fmt::format("{} is '{}'; it must be degrees within 0 ... {}, for example 4,16,64", option,
                      text, kMaxDegree));
    }
    degrees.push_back(degree);
  }
  return degrees;
}

std::vector<int> parse_band(const std::string& option, const std::string& text) {
  std::vector<int> ends = parse_degrees(option, text);
  if (ends.size() == 2 && ends[0] <= ends[1]) return ends;
  throw UsageError(fmt::format(
      "{} is '{}'; it must be two degrees, the lower one first, for example 10,40", option, text));
}

void check_by(const std::string& option, const std::string& text,
              const std::function<void()>& look) {
  try {
    look();
  } catch (const Error& error) {
    throw UsageError(fmt::format("{} is '{}': {}", option, text, error.what()));
  }
}

std::array<int, 2> parse_grid(const std::string& option, const std::string& text,
                              std::array<int, 2> min) {
  const std::vector<std::string> parts = split(text, 'x');
  std::array<int, 2> grid = {};
  if (parts.size() == 2 && read_number(parts[0], grid[0]) && read_number(parts[1], grid[1]) &&
      grid[0] >= min[0] && grid[1] >= min[1] &&
      static_cast<long long>(grid[0]) * grid[1] <= kMaxGridVertices) {
    return grid;
  }
  throw UsageError(
      fmt::format("{} is '{}'; it must be two numbers from {}x{} up, with a product of at most {}, "
                  "for example 90x180",
                  option, text, min[0], min[1], kMaxGridVertices));
}

std::array<int, 2> parse_size(const std::string& option, const std::string& text, int min,
                              int max) {
  const std::vector<std::string> parts = split(text, 'x');
  std::array<int, 2> size = {};
  if (parts.size() == 2 && read_number(parts[0], size[0]) && read_number(parts[1], size[1]) &&
      std::min(size[0], size[1]) >= min && std::max(size[0], size[1]) <= max) {
    return size;
  }
  throw UsageError(
      fmt::format("{} is '{}'; it must be two numbers within {} ... {}, for example 640x480",
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

std::vector<double> parse_positive(const std::string& option, const std::string& text,
                                   std::size_t count) {
  std::vector<double> numbers = parse_numbers(option, text, count);
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return number > 0; })) {
    return numbers;
  }
  throw UsageError(fmt::format("{} is '{}'; its {} numbers must be above 0", option, text, count));
}

Vec3 parse_direction(const std::string& option, const std::string& text) {
  const Vec3 direction = parse_vector(option, text);
  const double largest =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (largest > 0) return direction / largest;
  throw UsageError(fmt::format("{} is '{}'; a direction must not be 0,0,0", option, text));
}

Vec3 parse_vector(const std::string& option, const std::string& text) {
  const std::vector<double> numbers = parse_numbers(option, text, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace rholm::cli
