// Options and results field by field, each declared once. Layer: base.
//
// A struct of options has its list of fields beside it,
//
//   template <typename Visitor>
//   void visit_fields(FieldsOf<Options>, const Visitor& field) {
//     field(&Options::step, {.name = "step", .help = "edge of the grid's cubes", .least = 0});
//     ...
//
// Everything that handles the struct uses this list. Examples are checks of values, options of the
// program with help and completion, and messages between ranks. Others are the record of a folder
// to resume from, arguments and documentation in Python, and the reference page.
#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace rholm {

// Unit of a number.
enum class FieldUnit {
  kNone,    // no unit, or a fraction of something
  kLength,  // unit of the shape; the program takes a fraction of the bounding box's diagonal
  kBytes    // bytes of memory
};

// Description of a field, besides its type and its default.
struct FieldInfo {
  const char* name;  // "min_component"; the program has --min-component
  // One sentence that begins with a small letter and has no full stop.
  const char* help;
  const char* value = "";  // placeholder in help, "SHARE"; none for switches and choices
  // Least value of a number.
  double least = -std::numeric_limits<double>::infinity();
  // Largest value of a number.
  double most = std::numeric_limits<double>::infinity();
  bool above = false;                 // the least value itself is excluded
  bool may_be_infinite = false;       // infinity is allowed and means no limit
  bool may_be_zero = false;           // zero is allowed and means a choice by the data
  FieldUnit unit = FieldUnit::kNone;  // unit of a number
  bool changes_result = true;         // false: work with another value may be resumed
  bool in_program = true;             // false: the program has another way to give it
  bool in_python = true;              // false: Python functions have another way to give it
};

// Names the struct whose list of fields is wanted.
template <typename Options>
struct FieldsOf {};

// Calls visitor(member, info) for each field, in the order of the list. `member` is a pointer to
// the member.
template <typename Options, typename Visitor>
void for_each_field(const Visitor& visitor) {
  visit_fields(FieldsOf<Options>{}, visitor);
}

// Kinds of values of fields: an optional value,
template <typename V>
inline constexpr bool kIsOptional = false;
template <typename V>
inline constexpr bool kIsOptional<std::optional<V>> = true;
// a struct with fields of its own,
template <typename V>
concept HasFields = requires {
  visit_fields(FieldsOf<V>{}, [](auto, const FieldInfo&) {});
};
// and a number (not bool).
template <typename V>
concept Number = std::is_arithmetic_v<V> && !std::is_same_v<V, bool>;

// Names of the values of an enum, in the order of the values, starting at 0.
struct EnumNames {
  const char* what;                    // kind of choice, for messages: "hole policy"
  std::span<const char* const> names;  // "fill", "keep"
};

// An enum that users write by name; names_of(Enum) beside it returns the names.
template <typename Enum>
concept NamedEnum = std::is_enum_v<Enum> && requires(Enum value) {
  { names_of(value) } -> std::same_as<EnumNames>;
};

// Returns the name of a value.
template <NamedEnum Enum>
const char* to_string(Enum value) {
  return names_of(value).names[static_cast<std::size_t>(value)];
}

// Returns the index of a name in the list. Throws InvalidInput: "no such hole policy: 'shut'; there
// are fill, keep".
std::size_t find_name(const EnumNames& names, const std::string& name);

// Returns the value of a name. Throws InvalidInput with the list of valid names.
template <NamedEnum Enum>
Enum parse_name(const std::string& name) {
  return static_cast<Enum>(find_name(names_of(Enum{}), name));
}

}  // namespace rholm
