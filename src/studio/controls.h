// Fields of options in requests, in lines of a
// recipe, and as controls of the page. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "base/check_fields.h"
#include "rholm/error.h"
#include "rholm/fields.h"
#include "studio/items/fields.h"
#include "studio/items/message.h"

namespace rholm::studio {

template <typename V>
inline constexpr bool kIsAsked =
    NamedEnum<V> || std::is_arithmetic_v<V> || std::is_same_v<V, std::optional<double>>;

// Returns true if requests and the page have this field by its name: a field of the program
// that changes the result and has no unit. Lengths and places are given in other ways.
template <typename V>
bool is_asked(const FieldInfo& info) {
  return kIsAsked<V> && info.in_program && info.changes_result && info.unit == FieldUnit::kNone;
}

// Returns the value of a request's field. Throws Refusal 400 for
// a wrong type, an unknown choice, or a number out of bounds.
template <typename V>
V value_in(const Json& request, const FieldInfo& info) {
  V value = {};
  try {
    if constexpr (std::is_same_v<V, bool>) {
      value = flag_of(request, info.name);
    } else if constexpr (NamedEnum<V>) {
      value = parse_name<V>(string_of(request, info.name));
    } else {
      const double number = std::is_integral_v<V> ? whole_number_of(request, info.name)
                                                  : number_of(request, info.name);
      check_number(info, number);
      value = static_cast<V>(number);
    }
  } catch (const Error& error) {
    throw bad_request(error.what());
  }
  return value;
}

// Takes the fields that a request has by their names; null
// leaves the default. Throws the errors of value_in().
template <HasFields Options>
void take_fields(const Json& request, Options& options) {
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    using V = std::remove_cvref_t<decltype(options.*member)>;
    if constexpr (kIsAsked<V>) {
      if (is_asked<V>(info) && has_field(request, info.name)) {
        options.*member = value_in<V>(request, info);
      }
    }
  });
}

// Calls visit(info, value) for each of these fields that differs from its default.
template <HasFields Options, typename Visit>
void for_each_change(const Options& options, const Visit& visit) {
  const Options standard;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    using V = std::remove_cvref_t<decltype(options.*member)>;
    if constexpr (kIsAsked<V>) {
      if (!is_asked<V>(info) || options.*member == standard.*member) return;
      if constexpr (kIsOptional<V>) {
        visit(info, *(options.*member));
      } else {
        visit(info, options.*member);
      }
    }
  });
}

// Writes the changed fields to a step of the recipe.
template <HasFields Options>
void record_fields(const Options& options, Json& step) {
  for_each_change(options, [&](const FieldInfo& info, const auto& value) {
    if constexpr (NamedEnum<std::remove_cvref_t<decltype(value)>>) {
      step[info.name] = to_string(value);
    } else {
      step[info.name] = value;
    }
  });
}

// Options of a command, and arguments of a Python function.
struct Arguments {
  std::string shell = {}, python = {};  // " --scale 2 --refine", ", scale=2, refine=True"

  void flag(const std::string& name);
  void number(const std::string& name, double value);
  void choice(const std::string& name, const std::string& value);
  // Adds all fields that differ from their defaults.
  template <HasFields Options>
  void fields(const Options& options) {
    for_each_change(options, [&](const FieldInfo& info, const auto& value) {
      using V = std::remove_cvref_t<decltype(value)>;
      if constexpr (std::is_same_v<V, bool>) {
        flag(info.name);
      } else if constexpr (NamedEnum<V>) {
        choice(info.name, to_string(value));
      } else {
        number(info.name, static_cast<double>(value));
      }
    });
  }
};

// Returns the controls for options of steps on the page, as described in docs/studio.md.
Response controls_answer();

}  // namespace rholm::studio
