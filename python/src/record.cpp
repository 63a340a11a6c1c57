#include "record.h"

#include <nanobind/stl/pair.h>

#include <cmath>
#include <utility>

#include "rholm/error.h"

namespace rholm::python {
namespace {

// Returns the names of the properties of a class, in the order of their definition.
std::vector<std::string> fields_of(nb::handle type) {
  std::vector<std::string> names;
  for (const nb::handle item : type.attr("__dict__").attr("items")()) {
    const auto [name, value] = nb::cast<std::pair<std::string, nb::object>>(item);
    if (name.front() != '_' && nb::hasattr(value, "fget")) names.push_back(name);
  }
  return names;
}

// Largest numbers of characters. Chosen: two lines of 80 on a terminal.
constexpr std::size_t kLongestText = 160, kLongestValue = 48;

// Returns a short text of a value: numbers with six digits, records by name, long values by type.
std::string short_text(const nb::object& value) {
  if (nb::hasattr(value, "to_dict")) {
    return nb::cast<std::string>(value.type().attr("__name__")) + "(...)";
  }
  std::string text = nb::isinstance<nb::float_>(value)
                         ? nb::cast<std::string>(value.attr("__format__")(".6g"))
                         : nb::cast<std::string>(nb::repr(value));
  if (text.size() <= kLongestValue && text.find('\n') == std::string::npos) return text;
  return "<" + nb::cast<std::string>(value.type().attr("__name__")) + " of " +
         std::to_string(nb::len(value)) + ">";
}

}  // namespace

nb::dict dict_of(const StageTimes& times) {
  nb::dict result;
  for (const auto& [stage, time] : times) {
    result[stage.c_str()] = nb::make_tuple(time.wall, time.cpu);
  }
  return result;
}

StageTimes times_of(const nb::dict& times) {
  StageTimes result;
  for (const auto [stage, time] : times) {
    const auto [wall, cpu] = nb::cast<std::pair<double, double>>(time);
    result[nb::cast<std::string>(stage)] = {wall, cpu};
  }
  return result;
}

nb::dict field_dict(const FieldInfo& info, const nb::object& by_default, const std::string& kind,
                    const std::vector<std::string>& choices) {
  nb::dict field;
  field["name"] = info.name;
  field["help"] = info.help;
  field["kind"] = kind;
  field["choices"] = nb::tuple(nb::cast(choices));
  field["default"] =
      choices.empty() ? by_default : nb::cast(choices[nb::cast<std::size_t>(by_default)]);
  field["keyword"] = info.in_python;
  const bool bounded = std::isfinite(info.least) && std::isfinite(info.most);
  field["bounds"] = bounded ? nb::make_tuple(info.least, info.most) : nb::tuple();
  field["may_be_zero"] = info.may_be_zero;
  field["unit"] = info.unit == FieldUnit::kLength  ? "length"
                  : info.unit == FieldUnit::kBytes ? "bytes"
                                                   : "";
  return field;
}

std::string sentence_of(const FieldInfo& info) {
  std::string text = info.help;
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text + ".";
}

nb::str record_text(nb::handle record) {
  std::string text = nb::cast<std::string>(record.type().attr("__name__")) + "(";
  bool first = true;
  for (const std::string& name : fields_of(record.type())) {
    const std::string next =
        (first ? "" : ", ") + name + "=" + short_text(record.attr(name.c_str()));
    if (text.size() + next.size() > kLongestText) {
      text += ", ...";
      break;
    }
    text += next;
    first = false;
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
    if (value.is_none()) continue;
    try {
      nb::setattr(record, name, value);
    } catch (const nb::python_error& error) {
      if (!error.matches(PyExc_TypeError)) throw;  // the library's own message
      const std::string text =
          nb::cast<std::string>(name) + " is " + nb::cast<std::string>(nb::repr(value));
      if (nb::isinstance<nb::int_>(value)) {
        throw Error(ErrorCode::kInvalidInput, text + ", which is out of range");
      }
      throw nb::type_error((text + ", which is of the wrong type").c_str());
    }
  }
}

}  // namespace rholm::python
