#include "record.h"

#include <nanobind/stl/pair.h>

#include <utility>

namespace rholm::python {
namespace {

// Names of the properties of a class, in the order of their definition.
std::vector<std::string> fields_of(nb::handle type) {
  std::vector<std::string> names;
  for (const nb::handle item : type.attr("__dict__").attr("items")()) {
    const auto [name, value] = nb::cast<std::pair<std::string, nb::object>>(item);
    if (name.front() != '_' && nb::hasattr(value, "fget")) names.push_back(name);
  }
  return names;
}

}  // namespace

nb::dict dict_of(const StageTimes& times) {
  nb::dict result;
  for (const auto& [stage, time] : times) {
    result[stage.c_str()] = nb::make_tuple(time.wall, time.cpu);
  }
  return result;
}

nb::str record_text(nb::handle record) {
  std::string text = nb::cast<std::string>(record.type().attr("__name__")) + "(";
  bool first = true;
  for (const std::string& name : fields_of(record.type())) {
    if (!first) text += ", ";
    first = false;
    text += name + "=" + nb::cast<std::string>(nb::repr(record.attr(name.c_str())));
  }
  return nb::str((text + ")").c_str());
}

nb::dict record_dict(nb::handle record) {
  nb::dict result;
  for (const std::string& name : fields_of(record.type())) {
    const nb::object value = record.attr(name.c_str());
    const bool is_record = nb::hasattr(value, "to_dict");
    result[name.c_str()] = is_record ? nb::object(record_dict(value)) : value;
  }
  return result;
}

void set_fields(nb::handle record, const nb::kwargs& fields) {
  for (const auto& [name, value] : fields) {
    if (!nb::hasattr(record, name)) {
      throw nb::type_error(("no option '" + nb::cast<std::string>(name) + "'").c_str());
    }
    if (!value.is_none()) nb::setattr(record, name, value);
  }
}

}  // namespace rholm::python
