// Coefficients as data: conventions, spectra, filters, units, files.
#include "rholm/coefficients.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "formats.h"
#include "record.h"
#include "rholm/atlas_model.h"
#include "rholm/coefficients_io.h"
#include "rholm/error.h"
#include "rholm/filter.h"
#include "rholm/length_unit.h"
#include "rholm/model.h"

namespace rholm::python {
namespace {

using Planes = nb::ndarray<const double, nb::shape<2, -1, -1>, nb::c_contig, nb::device::cpu>;

Convention convention_of(const std::string& normalization, int csphase) {
  return {parse_name<Normalization>(normalization), csphase};
}

NumpyDoubles values_of(nb::handle self) {
  auto& c = nb::cast<Coefficients&>(self);
  const auto side = static_cast<std::size_t>(c.degree()) + 1;
  return array_within<double>(self, c.values().data(), {2, side, side});
}

// Sets array entries that hold no coefficient to 0. Throws InvalidInput if they are larger than
// rounding in sums of coefficients, for example from principal components. The limit is some
// hundred rounding units, chosen.
void clear_other_places(Coefficients& c) {
  double largest = 0;
  for (const double value : c.values()) largest = std::max(largest, std::abs(value));
  const double rounding = 256 * std::numeric_limits<double>::epsilon() * largest;
  const auto clear = [&](double& value, int plane, int l, int k, const char* why) {
    if (std::abs(value) > rounding) {
      throw Error(ErrorCode::kInvalidInput, "coefficients: the entry [" + std::to_string(plane) +
                                                ", " + std::to_string(l) + ", " +
                                                std::to_string(k) + "] " + why + ": it must be 0");
    }
    value = 0;
  };
  for (int l = 0; l <= c.degree(); ++l) {
    clear(c.s(l, 0), 1, l, 0, "is of sin(0)");
    for (int k = l + 1; k <= c.degree(); ++k) {
      clear(c.c(l, k), 0, l, k, "has an order m above its degree l");
      clear(c.s(l, k), 1, l, k, "has an order m above its degree l");
    }
  }
}

void bind_numbers(nb::module_& m) {
  nb::class_<Coefficients> type(m, "Coefficients",
                                "C_lm and S_lm in the library's own convention: orthonormal, "
                                "without Condon-Shortley phase.");
  bind_state(
      type,
      [](const Coefficients& c) {
        const auto values = c.values();
        return array_of(std::vector<double>(values.begin(), values.end())).cast();
      },
      [](const nb::object& state) {
        const auto values = nb::cast<Doubles>(state);
        int degree = 0;
        while (2 * (degree + 1.0) * (degree + 1.0) < static_cast<double>(values.size())) ++degree;
        Coefficients c(degree);
        if (c.values().size() != values.size()) {
          throw Error(ErrorCode::kInvalidInput, "the pickled coefficients are cut off");
        }
        std::copy_n(values.data(), values.size(), c.values().data());
        return c;
      });
  type.def(
          "__eq__",
          [](const Coefficients& a, const Coefficients& b) {
            return std::ranges::equal(a.values(), b.values());
          },
          nb::is_operator(), nb::sig("def __eq__(self, arg: object, /) -> bool"))
      .def(nb::init<int>())
      .def_prop_ro("degree", &Coefficients::degree)
      .def_prop_ro("values", &values_of)
      .def("resized", &Coefficients::resized);
  m.def("to_convention", [](const Coefficients& c, const std::string& normalization, int csphase) {
    return to_convention(c, convention_of(normalization, csphase));
  });
  m.def("from_convention", [](const Planes& values, const std::string& normalization, int csphase) {
    if (values.shape(1) != values.shape(2) || values.shape(1) == 0) {
      throw Error(ErrorCode::kInvalidInput, "coefficients are an array (2, L+1, L+1), not (2, " +
                                                std::to_string(values.shape(1)) + ", " +
                                                std::to_string(values.shape(2)) + ")");
    }
    if (values.shape(1) > static_cast<std::size_t>(kMaxDegree) + 1) {
      throw Error(ErrorCode::kInvalidInput, "degree " + std::to_string(values.shape(1) - 1) +
                                                " is above " + std::to_string(kMaxDegree));
    }
    Coefficients c(static_cast<int>(values.shape(1)) - 1);
    std::copy_n(values.data(), values.size(), c.values().data());
    clear_other_places(c);
    return from_convention(c, convention_of(normalization, csphase));
  });
  m.def("power_spectrum", [](const Coefficients& c) { return array_of(power_spectrum(c)); });
}

void bind_expansion(nb::module_& m) {
  Record<TruncationErrors>(m, "TruncationErrors",
                           "How far a surface is from the shape it was made of, in the unit of "
                           "lengths; None where it is not known.")
      .fields();
  Record<GravityField>(m, "GravityField",
                       "What the coefficients of a gravity field are relative to.")
      .fields();
  nb::class_<Expansion> type(m, "Expansion", "A surface as coefficients.");
  bind_state(
      type,
      [](const Expansion& e) {
        return nb::make_tuple(e.coefficients, static_cast<int>(e.function), state_of(e.center),
                              e.unit, e.method, e.norm_squared, e.tail_strength, e.errors,
                              e.signed_sum, e.gravity, e.precision);
      },
      [](const nb::object& state) {
        const auto parts = nb::cast<nb::tuple>(state);
        Expansion e;
        e.coefficients = nb::cast<Coefficients>(parts[0]);
        e.function = static_cast<RadialFunction>(nb::cast<int>(parts[1]));
        e.center = nb::cast<Vec3>(parts[2]);
        e.unit = nb::cast<std::string>(parts[3]);
        e.method = nb::cast<std::string>(parts[4]);
        e.norm_squared = nb::cast<std::optional<double>>(parts[5]);
        e.tail_strength = nb::cast<std::optional<double>>(parts[6]);
        e.errors = nb::cast<std::optional<TruncationErrors>>(parts[7]);
        e.signed_sum = parts.size() > 8 && nb::cast<bool>(parts[8]);
        if (parts.size() > 9) e.gravity = nb::cast<std::optional<GravityField>>(parts[9]);
        if (parts.size() > 10) e.precision = nb::cast<std::optional<double>>(parts[10]);
        return e;
      });
  type.def(
          "__eq__",
          [](nb::handle a, nb::handle b) {
            return a.attr("__getstate__")().equal(b.attr("__getstate__")());
          },
          nb::is_operator())
      .def(
          "__init__",
          [](Expansion* self, const Coefficients& coefficients, const std::string& function,
             const Vec3& center, const std::string& unit, const std::string& method,
             std::optional<double> norm_squared, std::optional<double> tail_strength,
             const std::optional<TruncationErrors>& errors, bool signed_sum) {
            if (!is_finite(center)) {
              throw Error(ErrorCode::kInvalidInput, "the centre is not finite");
            }
            if (!unit.empty()) check_unit(unit);
            new (self) Expansion{coefficients,  parse_name<RadialFunction>(function),
                                 center,        unit,
                                 method,        norm_squared,
                                 tail_strength, errors,
                                 signed_sum};
          },
          nb::arg("coefficients"), nb::arg("function") = "radius",
          nb::arg("center") = nb::make_tuple(0.0, 0.0, 0.0), nb::arg("unit") = "",
          nb::arg("method") = "", nb::arg("norm_squared") = nb::none(),
          nb::arg("tail_strength") = nb::none(), nb::arg("errors") = nb::none(),
          nb::arg("signed_sum") = false)
      .def_prop_ro("coefficients", [](const Expansion& e) { return e.coefficients; })
      .def_prop_ro("function", [](const Expansion& e) { return to_string(e.function); })
      .def_prop_ro(
          "center", [](const Expansion& e) { return read_only(e.center); },
          nb::rv_policy::automatic)
      .def_ro("unit", &Expansion::unit)
      .def("with_unit",
           [](Expansion e, const std::string& unit) {
             if (!unit.empty()) check_unit(unit);
             e.unit = unit;
             return e;
           })
      .def("with_gravity",
           [](Expansion e, double gravity_constant, double reference_radius) {
             e.gravity = {gravity_constant, reference_radius};
             check_gravity(e, "with_gravity");
             return e;
           })
      .def_ro("gravity", &Expansion::gravity)
      .def_ro("method", &Expansion::method)
      .def_ro("precision", &Expansion::precision)
      .def_ro("norm_squared", &Expansion::norm_squared)
      .def_ro("tail_strength", &Expansion::tail_strength)
      .def_ro("errors", &Expansion::errors)
      .def_ro("signed_sum", &Expansion::signed_sum);
  m.def("require_surface", &require_surface);
  m.def("require_star_shaped", &require_star_shaped);
  m.def("check_unit", &check_unit);
  m.def("metres_of", &metres_of);
  m.def("scaled", &scaled);
  m.def("truncated", &truncated);
}

WindowOptions window_of(const std::string& window, int order, std::optional<double> time) {
  return {.window = parse_window(window), .order = order, .time = time};
}

// Returns the rows of the table of windows as Python values.
nb::list window_rows() {
  nb::list rows;
  for (const WindowInfo& info : windows()) {
    nb::list parameters;
    for (const WindowParameter& one : info.parameters) {
      nb::dict parameter;
      parameter["name"] = one.name;
      parameter["symbol"] = one.symbol;
      parameter["help"] = one.help;
      parameter["whole"] = one.whole();
      parameter["min"] = one.min;
      parameter["max"] = one.max;
      parameter["default"] = one.value({});
      parameter["replaces_cutoff"] = one.replaces_cutoff;
      parameters.append(parameter);
    }
    nb::dict row;
    row["name"] = info.name;
    row["formula"] = info.formula;
    row["help"] = info.help;
    row["overshoot"] = info.overshoot;
    row["parameters"] = parameters;
    rows.append(row);
  }
  return rows;
}

void bind_filters(nb::module_& m) {
  m.def("windows", &window_rows);
  m.def(
      "low_pass",
      [](int cutoff, int degree, const std::string& window, int order, std::optional<double> time) {
        return array_of(low_pass(cutoff, degree, window_of(window, order, time)));
      },
      nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  m.def(
      "high_pass",
      [](int cutoff, int degree, const std::string& window, int order, std::optional<double> time) {
        return array_of(high_pass(cutoff, degree, window_of(window, order, time)));
      },
      nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  m.def(
      "band_pass",
      [](int from, int to, int degree, const std::string& window, int order,
         std::optional<double> time) {
        return array_of(band_pass(from, to, degree, window_of(window, order, time)));
      },
      nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  m.def("sharpened", [](const Doubles& gains, double amount) {
    return array_of(sharpened(span_of(gains), amount));
  });
  m.def("filter",
        [](const Coefficients& c, const Doubles& gains) { return filter(c, span_of(gains)); });
  m.def("filter", [](const Expansion& e, const Doubles& gains, const std::string& name) {
    return filter(e, span_of(gains), name);
  });
  Record<Overshoot>(m, "Overshoot",
                    "How far a filtered step leaves 0 ... 1, in parts of its height.")
      .fields();
  m.def("overshoot", [](const Doubles& gains) { return overshoot(span_of(gains)); });
  m.def("overshoot", [](const std::string& window, int degree) {
    return overshoot(parse_window(window), degree);
  });
}

nb::tuple tuple_of(CoefficientsFile&& file) {
  return nb::make_tuple(std::move(file.expansion), to_string(file.format),
                        to_string(file.convention.normalization), file.convention.csphase,
                        file.assumed, file.product, file.passed_over);
}

void bind_files(nb::module_& m) {
  const auto read_options = [](const std::string& normalization, int csphase, bool override_file) {
    return CoefficientsReadOptions{convention_of(normalization, csphase), override_file};
  };
  m.def("read_coefficients", [=](const std::string& path, const std::string& normalization,
                                 int csphase, bool override_file, const Caller& caller) {
    const auto options = read_options(normalization, csphase, override_file);
    return tuple_of(caller.run(
        [&](const Context& context) { return read_coefficients(path, options, context); }));
  });
  m.def("read_any_coefficients", [=](const std::string& path, const std::string& normalization,
                                     int csphase, bool override_file, const Caller& caller) {
    const auto options = read_options(normalization, csphase, override_file);
    return tuple_of(caller.run(
        [&](const Context& context) { return read_any_coefficients(path, options, context); }));
  });
  m.def("parse_coefficients",
        [=](const nb::bytes& bytes, const std::string& name, const std::string& normalization,
            int csphase, bool override_file, const Caller& caller) {
          const auto options = read_options(normalization, csphase, override_file);
          const std::span<const char> all(bytes.c_str(), bytes.size());
          return tuple_of(
              caller.run([&](const Context&) { return parse_coefficients(all, name, options); }));
        });
  m.def("coefficients_format_of", [](const std::string& path) -> std::optional<std::string> {
    const auto format = coefficients_format_of(path);
    if (!format) return std::nullopt;
    return to_string(*format);
  });
  m.def("coefficients_formats", [] {
    nb::list formats;
    for (const CoefficientsFormatInfo& format : coefficients_formats()) {
      formats.append(format_row(format.file, held_by(format)));
    }
    return formats;
  });
  m.def("is_model_name", [](const std::string& path) { return is_model_name(path); });
  m.def("looks_like_coefficients", [](const nb::bytes& bytes) {
    return looks_like_coefficients({bytes.c_str(), bytes.size()});
  });
  m.def(
      "write_coefficients",
      [](const Expansion& e, const std::string& path, const std::optional<std::string>& format,
         const std::string& normalization, int csphase, const Caller& caller) {
        CoefficientsWriteOptions options{.convention = convention_of(normalization, csphase)};
        if (format) options.format = parse_coefficients_format(*format);
        caller.run([&](const Context&) { write_coefficients(e, path, options); });
      },
      nb::arg(), nb::arg(), nb::arg().none(), nb::arg(), nb::arg(), nb::arg());
  m.def("write_model", [](const Expansion& e, const std::string& path, const Caller& caller) {
    caller.run([&](const Context&) { write_model(e, path); });
  });
  m.def("read_model", [](const std::string& path, const Caller& caller) {
    return caller.run([&](const Context&) { return read_model(path); });
  });
  m.def("is_model_file", [](const std::string& path) { return is_model_file(path); });
}

}  // namespace

void bind_coefficients(nb::module_& m) {
  bind_numbers(m);
  bind_expansion(m);
  bind_filters(m);
  bind_files(m);
}

}  // namespace rholm::python
