// Structs of the library as classes of Python: results that are read, options that are set.
// Layer: python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "casters.h"
#include "rholm/context.h"

namespace rholm::python {

// Times as {"stage": (wall, cpu)}.
nb::dict dict_of(const StageTimes& times);
// "Name(field=value, ...)" of all properties of an object.
nb::str record_text(nb::handle record);
// {"field": value, ...}, records in records too.
nb::dict record_dict(nb::handle record);
// Sets what the keywords say; None leaves the default. TypeError for a name that is no field.
void set_fields(nb::handle record, const nb::kwargs& fields);

// A result: its fields can be read.
template <class T>
class Record {
 public:
  Record(nb::module_& m, const char* name, const char* doc) : class_(m, name, doc) {
    class_.def("__repr__", [](nb::handle self) { return record_text(self); });
    class_.def(
        "to_dict", [](nb::handle self) { return record_dict(self); },
        "All fields by name; records within it are dicts, too.");
  }

  template <class V>
  Record& field(const char* name, V T::*member, const char* doc) {
    if constexpr (std::is_same_v<V, StageTimes>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return dict_of(t.*member); }, doc);
    } else if constexpr (std::is_same_v<V, std::vector<double>> ||
                         std::is_same_v<V, std::vector<Vec3>>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return array_of(V(t.*member)); }, doc,
          nb::rv_policy::automatic);  // it owns its memory
    } else if constexpr (std::is_enum_v<V>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return to_string(t.*member); }, doc);
    } else if constexpr (std::is_same_v<V, Vec3>) {
      class_.def_prop_ro(
          name, [member](const T& t) { return t.*member; }, doc);
    } else {
      class_.def_ro(name, member, doc);
    }
    return *this;
  }
  template <class F>
  Record& property(const char* name, F f, const char* doc) {
    class_.def_prop_ro(name, f, doc, nb::rv_policy::automatic);
    return *this;
  }

  nb::class_<T>& type() { return class_; }

 private:
  nb::class_<T> class_;
};

// Options: made of keywords, Options(degree=3).
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
  // One of a closed list of names. `print` gives them back.
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
