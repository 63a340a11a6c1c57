// Options and results field by field, each declared once. Layer: base.
//
// Beside a struct of options stands its list,
//
//   template <typename Visitor>
//   void visit_fields(FieldsOf<Options>, const Visitor& field) {
//     field(&Options::step, {.name = "step", .help = "edge of the grid's cubes", .least = 0});
//     ...
//
// of which everything is made that knows the struct: the checks of its values, the options of the
// program with their help and completion, messages between ranks, what a folder to resume from
// remembers, the arguments of Python with their documentation, and the page of reference.
#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace rholm {

// What a number measures.
enum class FieldUnit {
  kNone,    // nothing, or a part of something
  kLength,  // in the unit of the shape; the program takes a part of the bounding box's diagonal
  kBytes    // of memory
};

// What is known of a field beside its type and its default.
struct FieldInfo {
  const char* name;  // "min_component"; the program has --min-component
  // One sentence that begins with a small letter and has no full stop.
  const char* help;
  const char* value = "";  // what help writes for a value, "SHARE"; none for switches and choices
  // Least value of a number.
  double least = -std::numeric_limits<double>::infinity();
  // Largest value of a number.
  double most = std::numeric_limits<double>::infinity();
  bool above = false;                 // the least value itself is not allowed
  bool may_be_infinite = false;       // as what stands for no limit
  bool may_be_zero = false;           // as what stands for a choice by the data
  FieldUnit unit = FieldUnit::kNone;  // of a number
  bool changes_result = true;         // if not, work with another value may be taken up
  bool in_program = true;             // if not, the program has another way to say it
  bool in_python = true;              // if not, functions of Python have another way to say it
};

// Names the struct whose list is meant.
template <typename Options>
struct FieldsOf {};

// Calls visitor(member, info) for each field, in the order of the list. `member` is a pointer to
// the member.
template <typename Options, typename Visitor>
void for_each_field(const Visitor& visitor) {
  visit_fields(FieldsOf<Options>{}, visitor);
}

// Kinds of values that fields may have: one that may be missing,
template <typename V>
inline constexpr bool kIsOptional = false;
template <typename V>
inline constexpr bool kIsOptional<std::optional<V>> = true;
// a struct with fields of its own,
template <typename V>
concept HasFields = requires {
  visit_fields(FieldsOf<V>{}, [](auto, const FieldInfo&) {});
};
// and a number.
template <typename V>
concept Number = std::is_arithmetic_v<V> && !std::is_same_v<V, bool>;

// The names of an enum's values, in the order of the values from 0 on.
struct EnumNames {
  const char* what;                    // "hole policy", for messages
  std::span<const char* const> names;  // "fill", "keep"
};

// An enum that users write by its names: names_of(Enum), beside it, has these.
template <typename Enum>
concept NamedEnum = std::is_enum_v<Enum> && requires(Enum value) {
  { names_of(value) } -> std::same_as<EnumNames>;
};

// The name of a value.
template <NamedEnum Enum>
const char* to_string(Enum value) {
  return names_of(value).names[static_cast<std::size_t>(value)];
}

// The place of a name in the list. Throws InvalidInput: "no such hole policy: 'shut'; there are
// fill, keep".
std::size_t find_name(const EnumNames& names, const std::string& name);

// The value of a name. Throws InvalidInput, with the names that there are.
template <NamedEnum Enum>
Enum parse_name(const std::string& name) {
  return static_cast<Enum>(find_name(names_of(Enum{}), name));
}

}  // namespace rholm
