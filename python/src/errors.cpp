// Converts errors of the library to Python exceptions, which rholm/_errors.py defines.
#include <nanobind/nanobind.h>

#include <exception>
#include <string>

#include "bindings.h"
#include "rholm/error_info.h"

namespace rholm::python {
namespace {

namespace nb = nanobind;

// Raises the Python exception for an error. The caller holds the interpreter's lock.
void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const nb::object types = nb::module_::import_("rholm._errors").attr("BY_CODE");
    const nb::object type = types[to_string(error.code())];
    PyErr_SetObject(type.ptr(), nb::str(error.what()).ptr());
  }
}

}  // namespace

void bind_errors(nb::module_& m) {
  nb::register_exception_translator(&translate, nullptr);
  nb::list kinds;  // code, class, base, meaning
  for (const ErrorInfo& info : error_infos()) {
    kinds.append(nb::make_tuple(info.name, info.python_class, info.python_base, info.meaning));
  }
  m.attr("ERRORS") = nb::tuple(kinds);
}

}  // namespace rholm::python
