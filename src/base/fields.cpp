#include "rholm/fields.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/check_fields.h"
#include "base/plain_text.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Returns "above 0", "0 or more", "0 ... 1", "finite" and the like.
std::string bounds_of(const FieldInfo& info) {
  const bool has_least = info.least > -std::numeric_limits<double>::infinity();
  const bool has_most = info.most < std::numeric_limits<double>::infinity();
  if (!has_least && !has_most) return "finite";
  if (!has_most) {
    return info.above ? fmt::format("above {}", info.least) : fmt::format("{} or more", info.least);
  }
  if (!has_least) return fmt::format("at most {}", info.most);
  return info.above ? fmt::format("above {}, at most {}", info.least, info.most)
                    : fmt::format("{} ... {}", info.least, info.most);
}

// Returns bounds_of(), followed by ", or 0" where the field may be zero.
std::string limits_of(const FieldInfo& info) {
  return bounds_of(info) + (info.may_be_zero ? ", or 0" : "");
}

}  // namespace

std::size_t find_name(const EnumNames& names, const std::string& name) {
  const auto found = std::ranges::find(names.names, name);
  if (found != names.names.end()) {
    return static_cast<std::size_t>(found - names.names.begin());
  }
  throw Error(ErrorCode::kInvalidInput, fmt::format("no such {}: {}; there are {}", names.what,
                                                    in_quotes(name), fmt::join(names.names, ", ")));
}

void check_number(const FieldInfo& info, double value) {
  const bool inside = value >= info.least && value <= info.most &&
                      !(info.above && value == info.least) &&
                      (std::isfinite(value) || info.may_be_infinite);
  if (inside || (info.may_be_zero && value == 0)) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("{} is {}: it must be {}", info.name, value, limits_of(info)));
}

}  // namespace rholm
