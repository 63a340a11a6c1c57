#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/region.h"

namespace rholm {
namespace {

[[noreturn]] void refuse(const std::string& text, const char* form) {
  throw Error(ErrorCode::kInvalidInput, fmt::format("'{}' is no region: {}", text, form));
}

// Parses a whole text as a number; returns nullopt for other text, or if not finite.
template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return {};
  }
  return value;
}

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<double> numbers_of(const std::string& text, const std::string& values,
                               std::size_t count, const char* form) {
  std::vector<double> numbers;
  for (const std::string& part : parts_of(values)) {
    const std::optional<double> number = number_of<double>(part);
    if (!number) refuse(text, form);
    numbers.push_back(*number);
  }
  if (numbers.size() != count) refuse(text, form);
  return numbers;
}

}  // namespace

Region parse_region(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string values = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "ball") {
    const char* const form = "a ball is ball:X,Y,Z,RADIUS, its radius above 0";
    const std::vector<double> v = numbers_of(text, values, 4, form);
    if (!(v[3] > 0)) refuse(text, form);
    return BallRegion{{v[0], v[1], v[2]}, v[3]};
  }
  if (kind == "box") {
    const std::vector<double> v = numbers_of(text, values, 6, "a box is box:X0,Y0,Z0,X1,Y1,Z1");
    return BoxRegion{{std::min(v[0], v[3]), std::min(v[1], v[4]), std::min(v[2], v[5])},
                     {std::max(v[0], v[3]), std::max(v[1], v[4]), std::max(v[2], v[5])}};
  }
  if (kind == "vertex") {
    const char* const form = "a disc on the surface is vertex:INDEX,RADIUS, its radius above 0";
    const std::vector<std::string> parts = parts_of(values);
    const std::optional<std::uint32_t> vertex = number_of<std::uint32_t>(parts[0]);
    const std::optional<double> radius =
        parts.size() == 2 ? number_of<double>(parts[1]) : std::optional<double>();
    if (!vertex || !radius || !(*radius > 0)) refuse(text, form);
    return DiscRegion{*vertex, *radius};
  }
  if (kind == "property" && !values.empty()) return PropertyRegion{values};
  if (kind == "color") {
    std::uint32_t rgb = 0;
    const char* const end = values.data() + values.size();
    const auto [stop, error] = std::from_chars(values.data(), end, rgb, 16);
    if (values.size() != 6 || error != std::errc() || stop != end) {
      refuse(text, "a color is color:RRGGBB, six hexadecimal digits");
    }
    return ColorRegion{rgb};
  }
  refuse(text,
         "it is ball:X,Y,Z,R, vertex:INDEX,RADIUS, box:X0,Y0,Z0,X1,Y1,Z1, "
         "property:NAME or color:RRGGBB");
}

}  // namespace rholm
