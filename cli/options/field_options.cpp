#include "cli/options/field_options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rholm::cli {

std::string option_name(const FieldInfo& info) {
  std::string name = info.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string default_text(double value) { return value == 0 ? "" : fmt::format("{}", value); }

Option option_of(const FieldInfo& info, const std::string& by_default) {
  const bool is_length = info.unit == FieldUnit::kLength;
  Option option{.name = option_name(info), .value = info.value, .help = info.help};
  option.group = Group::kAdvanced;
  if (is_length) option.help += "; a fraction of the bounding box's diagonal";
  if (!by_default.empty()) option.help += fmt::format("; {} by default", by_default);
  if (std::isfinite(info.least)) (info.above ? option.above : option.min) = info.least;
  if (std::isfinite(info.most)) option.max = info.most;
  if (is_length) option.max = 1;
  return option;
}

}  // namespace rholm::cli
