// Structs of the library as Python classes: results can be read, copied, pickled and compared;
// options can be set. Layer: python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "casters.h"
#include "rholm/context.h"
#include "rholm/fields.h"

namespace rholm::python {

// Convert times from and to {"stage": (wall, cpu)}.
nb::dict dict_of(const StageTimes& times);
StageTimes times_of(const nb::dict& times);
// Returns "Name(field=value, ...)" with the properties of an object, cut off after some characters.
// Nested records and long values are abbreviated.
nb::str record_text(nb::handle record);
// Returns {"field": value, ...}; nested records are dicts, too.
nb::dict record_dict(nb::handle record);
// Sets fields from keywords; None keeps the default. Throws TypeError for an unknown name.
void set_fields(nb::handle record, const nb::kwargs& fields);

// Returns the help of a field as a sentence for a docstring.
std::string sentence_of(const FieldInfo& info);

// Converts a member to a plain Python value without arrays, which can be compared and pickled.
template <class V>
nb::object state_of(const V& value) {
  if constexpr (std::is_same_v<V, StageTimes>) {
    return dict_of(value);
  } else if constexpr (kIsOptional<V>) {
    return value ? state_of(*value) : nb::object(nb::none());
  } else if constexpr (std::is_enum_v<V>) {
    return nb::int_(static_cast<int>(value));
  } else if constexpr (std::is_same_v<V, Vec3>) {
    return nb::make_tuple(value.x, value.y, value.z);
  } else if constexpr (std::is_same_v<V, std::vector<Vec3>> ||
                       std::is_same_v<V, std::array<Vec3, 3>>) {
    nb::list rows;
    for (const Vec3& row : value) rows.append(state_of(row));
    return rows;
  } else {
    return nb::cast(value);
  }
}
template <class V>
V value_of(nb::handle state) {
  if constexpr (std::is_same_v<V, StageTimes>) {
    return times_of(nb::cast<nb::dict>(state));
  } else if constexpr (std::is_enum_v<V>) {
    return static_cast<V>(nb::cast<int>(state));
  } else {
    return nb::cast<V>(state);
  }
}

// The members of a struct by name, for pickling.
template <class T>
class Members {
 public:
  // `at` returns a reference to the member of a T&.
  template <class F>
  void add(const char* name, F at) {
    using V = std::remove_reference_t<decltype(at(std::declval<T&>()))>;
    members_.push_back({name, [at](T& t) { return state_of<V>(at(t)); },
                        [at](T& t, nb::handle state) { at(t) = value_of<V>(state); }});
  }
  nb::dict get(T& t) const {
    nb::dict state;
    for (const Member& member : members_) state[member.name] = member.get(t);
    return state;
  }
  void set(T& t, const nb::dict& state) const {
    for (const Member& member : members_) member.set(t, state[member.name]);
  }

 private:
  struct Member {
    const char* name;
    std::function<nb::object(T&)> get;
    std::function<void(T&, nb::handle)> set;
  };
  std::vector<Member> members_;
};

// Adds copies, pickles and equality from get(T&), a Python value, and make(state), a T.
template <class T, class Get, class Make>
void bind_state(nb::class_<T>& type, const Get& get, const Make& make) {
  type.def("__getstate__", [get](T& t) { return get(t); });
  type.def("__setstate__", [make](T& t, const nb::object& state) { new (&t) T(make(state)); });
}

// A result struct whose fields can be read.
template <class T>
class Record {
 public:
  Record(nb::module_& m, const char* name, const char* doc) : class_(m, name, doc) {
    class_.def("__repr__", [](nb::handle self) { return record_text(self); });
    const std::shared_ptr<Members<T>> members = members_;
    bind_state(
        class_, [members](T& t) { return members->get(t); },
        [members](const nb::object& state) {
          T t{};
          members->set(t, nb::cast<nb::dict>(state));
          return t;
        });
    class_.def(
        "__eq__",
        [members](T& self, nb::handle other) -> nb::object {
          T* as_same = nullptr;
          if (other.is_none() || !nb::try_cast(other, as_same))
            return nb::borrow(Py_NotImplemented);
          return nb::bool_(members->get(self).equal(members->get(*as_same)));
        },
        nb::arg().none(), nb::sig("def __eq__(self, arg: object, /) -> bool"));
    class_.def("__hash__",
               [](const T&) -> std::size_t { throw nb::type_error("a record has no hash"); });
    class_.def(
        "to_dict", [](nb::handle self) { return record_dict(self); },
        "All fields by name; records within it are dicts, too.");
  }

  template <class V>
  Record& field(const char* name, V T::*member, const char* doc) {
    hidden(name, [member](T& t) -> V& { return t.*member; });
    if constexpr (std::is_same_v<V, StageTimes>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return dict_of(t.*member); }, doc);
    } else if constexpr (std::is_same_v<V, std::vector<double>> ||
                         std::is_same_v<V, std::vector<Vec3>>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return read_only(V(t.*member)); }, doc,
          nb::rv_policy::automatic);  // the array owns its memory
    } else if constexpr (std::is_enum_v<V>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return to_string(t.*member); }, doc);
    } else if constexpr (std::is_same_v<V, Vec3>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return read_only(t.*member); }, doc,
          nb::rv_policy::automatic);
    } else {
      class_.def_ro(name, member, doc);
    }
    return *this;
  }
  // Adds all fields of the struct's list.
  Record& fields() {
    for_each_field<T>([&](auto member, const FieldInfo& info) {
      field(info.name, member, sentence_of(info).c_str());
    });
    return *this;
  }
  // Adds a member that Python cannot read, for copies and pickles only.
  template <class F>
  Record& hidden(const char* name, F at) {
    members_->add(name, at);
    return *this;
  }
  template <class F>
  Record& property(const char* name, F f, const char* doc) {
    class_.def_prop_ro(name, f, doc, nb::rv_policy::automatic);
    return *this;
  }

  nb::class_<T>& type() { return class_; }

 private:
  std::shared_ptr<Members<T>> members_ = std::make_shared<Members<T>>();
  nb::class_<T> class_;
};

// Returns the kind of a field for documents: "bool", "number", "whole number", "point", "text",
// "path", "texts", "choice", "options"; with "optional " before it if the value may be missing.
template <class V>
std::string kind_of() {
  if constexpr (kIsOptional<V>) {
    return "optional " + kind_of<typename V::value_type>();
  } else if constexpr (std::is_same_v<V, bool>) {
    return "bool";
  } else if constexpr (NamedEnum<V>) {
    return "choice";
  } else if constexpr (HasFields<V>) {
    return "options";
  } else if constexpr (std::is_integral_v<V>) {
    return "whole number";
  } else if constexpr (std::is_floating_point_v<V>) {
    return "number";
  } else if constexpr (std::is_same_v<V, Vec3>) {
    return "point";
  } else if constexpr (std::is_same_v<V, std::filesystem::path>) {
    return "path";
  } else if constexpr (std::is_same_v<V, std::vector<std::string>>) {
    return "texts";
  } else {
    static_assert(std::is_same_v<V, std::string>);
    return "text";
  }
}
template <class V>
std::vector<std::string> choices_of() {
  if constexpr (NamedEnum<V>) {
    const auto names = names_of(V{}).names;
    return {names.begin(), names.end()};
  } else {
    return {};
  }
}
// Returns the description of a field as a dict.
nb::dict field_dict(const FieldInfo& info, const nb::object& by_default, const std::string& kind,
                    const std::vector<std::string>& choices);

// A struct of options, made from keywords: Options(degree=3).
template <class T>
class Options {
 public:
  Options(nb::module_& m, const char* name, const char* doc) : class_(m, name, doc) {
    class_.def(
        "__init__",
        [](nb::pointer_and_handle<T> self, const nb::kwargs& fields) {
          new (self.p) T();
          nb::inst_mark_ready(self.h);
          set_fields(self.h, fields);
        },
        nb::sig("def __init__(self, **fields: typing.Any) -> None"));
    class_.def("__repr__", [](nb::handle self) { return record_text(self); });
  }

  template <class V>
  Options& field(const char* name, V T::*member) {
    class_.def_prop_rw(
        name, [member](const T& t) -> const V& { return t.*member; },
        [member](T& t, const V& value) { t.*member = value; }, nb::for_setter(nb::arg().none()));
    return *this;
  }
  // Adds all fields of the struct's list. The class attribute FIELDS describes them.
  Options& fields() {
    nb::list described;
    for_each_field<T>([&](auto member, const FieldInfo& info) {
      using V = std::remove_reference_t<decltype(std::declval<T&>().*member)>;
      if constexpr (NamedEnum<V>) {
        class_.def_prop_rw(
            info.name, [member](const T& t) { return to_string(t.*member); },
            [member](T& t, const std::string& text) { t.*member = parse_name<V>(text); });
      } else {
        field(info.name, member);
      }
      described.append(field_dict(info, state_of(T{}.*member), kind_of<V>(), choices_of<V>()));
    });
    class_.attr("FIELDS") = nb::tuple(described);
    return *this;
  }
  // Adds a field with a closed list of names. `print` returns the name of a value.
  template <class V>
  Options& choice(const char* name, V T::*member, V (*parse)(const std::string&),
                  const char* (*print)(V)) {
    class_.def_prop_rw(
        name, [member, print](const T& t) { return print(t.*member); },
        [member, parse](T& t, const std::string& text) { t.*member = parse(text); });
    return *this;
  }

  nb::class_<T>& type() { return class_; }

 private:
  nb::class_<T> class_;
};

}  // namespace rholm::python
