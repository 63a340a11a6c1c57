// Options of the program from the fields of a struct of the library. Layer: cli.
#pragma once

#include <concepts>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/grammar/command.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/simplify_option.h"
#include "rholm/fields.h"
#include "rholm/simplify.h"
#include "rholm/vec3.h"

namespace rholm::cli {

// Returns "min-component" for "min_component".
std::string option_name(const FieldInfo& info);
// Returns name, help and bounds, without a target. `by_default` ends the help.
Option option_of(const FieldInfo& info, const std::string& by_default);
// Returns the default for help: nothing for 0, which the help of the field explains.
std::string default_text(double value);

template <typename V>
Option field_option(const FieldInfo& info, V& value) {
  if constexpr (std::is_same_v<V, bool>) {
    Option option = option_of(info, "");
    option.target = &value;
    return option;
  } else if constexpr (NamedEnum<V>) {
    Option option = option_of(info, to_string(value));
    const auto names = names_of(value).names;
    option.choices.assign(names.begin(), names.end());
    option.target = [&value](const std::string&, const std::string& text) {
      value = parse_name<V>(text);
    };
    return option;
  } else if constexpr (std::is_same_v<V, std::optional<double>>) {
    Option option = option_of(info, "");
    option.value = "auto|" + option.value;
    option.target = [&value, limits = option](const std::string&, const std::string& text) {
      value.reset();
      if (text != "auto") value = number_within(limits, text);
    };
    return option;
  } else if constexpr (std::is_same_v<V, std::optional<std::size_t>>) {
    Option option = option_of(info, "");
    option.target = [&value, limits = option](const std::string&, const std::string& text) {
      value = whole_within(limits, text);
    };
    return option;
  } else if constexpr (std::is_same_v<V, std::optional<Vec3>> || std::is_same_v<V, Vec3>) {
    Option option = option_of(info, "");
    option.target = [&value](const std::string& name, const std::string& text) {
      value = parse_vector(name, text);
    };
    return option;
  } else if constexpr (std::is_same_v<V, std::optional<SimplifyOptions>>) {
    Option option = option_of(info, "");
    option.target = [&value](const std::string& name, const std::string& text) {
      value = parse_simplify(name, text);
    };
    return option;
  } else if constexpr (std::is_same_v<V, std::string>) {
    Option option = option_of(info, value);
    option.target = &value;
    return option;
  } else if constexpr (std::is_arithmetic_v<V>) {
    Option option = option_of(info, default_text(static_cast<double>(value)));
    option.target = &value;
    return option;
  } else {
    throw std::logic_error(std::string("no option of the program: ") + info.name);
  }
}

// Returns an option for each field that the program has; `values` must outlive them.
template <HasFields Options>
std::vector<Option> field_options(Options& values) {
  std::vector<Option> options;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (info.in_program) options.push_back(field_option(info, values.*member));
  });
  return options;
}

// Values, and the fields that the command line gave; a switch that is on was given.
template <HasFields Options>
struct Given {
  Options values = {};
  std::set<std::string> names = {};  // without switches

  bool has(const std::string& field) const { return names.contains(field); }
};

// Makes one option, which records whether it is given.
template <HasFields Options, typename V>
Option given_option(const FieldInfo& info, V& value, Given<Options>& given) {
  Option option = field_option(info, value);
  if (!option.is_switch()) {
    option.check = [&given, name = std::string(info.name)](const std::string&, const std::string&) {
      given.names.insert(name);
    };
  }
  return option;
}

// Makes an option for each field and records which are given; `given` must outlive them.
template <HasFields Options>
std::vector<Option> field_options(Given<Options>& given) {
  std::vector<Option> options;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (info.in_program) options.push_back(given_option(info, given.values.*member, given));
  });
  return options;
}

// Returns " --norm max --max-degree 80": given names and numbers, as they can be typed again.
template <HasFields Options>
std::string given_text(const Given<Options>& given) {
  std::string text;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (!given.has(info.name)) return;
    using V = std::remove_cvref_t<decltype(given.values.*member)>;
    if constexpr (NamedEnum<V>) {
      text += " --" + option_name(info) + " " + to_string(given.values.*member);
    } else if constexpr (Number<V>) {
      text += fmt::format(" --{} {}", option_name(info), given.values.*member);
    }
  });
  return text;
}

// Makes the option of one field, for commands that take only some options of a struct. `about`
// precedes its help.
template <HasFields Options>
Option field_option_of(Options& values, const std::string& name, const std::string& about = "") {
  std::optional<Option> found;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (info.name == name) found = field_option(info, values.*member);
  });
  if (!found) throw std::logic_error("no field: " + name);
  found->help = about + found->help;
  return *found;
}
template <HasFields Options>
Option field_option_of(Given<Options>& given, const std::string& name,
                       const std::string& about = "") {
  std::optional<Option> found;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (info.name == name) found = given_option(info, given.values.*member, given);
  });
  if (!found) throw std::logic_error("no field: " + name);
  found->help = about + found->help;
  return *found;
}

// Converts lengths given as fractions of the diagonal to the unit of the shape.
template <HasFields Options>
void scale_lengths(Options& values, double diagonal) {
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    using V = std::remove_reference_t<decltype(values.*member)>;
    if constexpr (HasFields<V>) scale_lengths(values.*member, diagonal);
    if (!info.in_program || info.unit != FieldUnit::kLength) return;
    if constexpr (std::is_same_v<V, double>) values.*member *= diagonal;
    if constexpr (std::is_same_v<V, std::optional<double>>) {
      if (values.*member) *(values.*member) *= diagonal;
    }
  });
}
// Returns true if a length was given.
template <HasFields Options>
bool has_lengths(const Options& values) {
  bool has = false;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (!info.in_program || info.unit != FieldUnit::kLength) return;
    using V = std::remove_cvref_t<decltype(values.*member)>;
    if constexpr (std::equality_comparable<V>) has = has || values.*member != Options{}.*member;
  });
  return has;
}

}  // namespace rholm::cli
