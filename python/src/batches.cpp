// Populations: the journal of finished rows, tables and their files.
#include "rholm/batch.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"

namespace rholm::python {
namespace {

nb::dict dict_of(const BatchRow& cells) {
  nb::dict row;
  for (const auto& [name, cell] : cells) {
    std::visit(
        [&, &key = name](const auto& value) {
          using T = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<T, std::vector<double>>) {
            row[key.c_str()] = array_of(value);
          } else if constexpr (!std::is_same_v<T, std::monostate>) {
            row[key.c_str()] = value;
          }
        },
        cell);
  }
  return row;
}

// Converts cells that the Python code has made bool, int, float, str or a list of float; None is a
// missing value.
BatchRow row_of(const nb::dict& cells) {
  BatchRow row;
  for (const auto [key, value] : cells) {
    std::pair<std::string, Cell>& one = row.emplace_back(nb::cast<std::string>(key), Cell());
    if (nb::isinstance<nb::bool_>(value)) {
      one.second = nb::cast<bool>(value);
    } else if (nb::isinstance<nb::int_>(value)) {
      one.second = nb::cast<std::int64_t>(value);
    } else if (nb::isinstance<nb::float_>(value)) {
      one.second = nb::cast<double>(value);
    } else if (nb::isinstance<nb::str>(value)) {
      one.second = nb::cast<std::string>(value);
    } else if (!value.is_none()) {
      one.second = nb::cast<std::vector<double>>(value);
    }
  }
  return row;
}

// Returns the values of a column as NumPy array, or a list of texts. Booleans are int8: 1, 0, -1.
nb::object values_of(const BatchColumn& column, std::size_t rows) {
  return std::visit(
      [&](const auto& values) -> nb::object {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<T, std::string>) {
          return nb::cast(values);
        } else {
          auto copy = values;
          return column.width == 0 ? nb::cast(array_of<T>(std::move(copy), {rows}))
                                   : nb::cast(array_of<T>(std::move(copy), {rows, column.width}));
        }
      },
      column.values);
}

// Returns the pickled form of a column: its values with the number of their type.
nb::tuple state_of_column(const BatchColumn& column) {
  nb::object values = std::visit(
      [](const auto& all) -> nb::object {
        using T = typename std::decay_t<decltype(all)>::value_type;
        if constexpr (std::is_same_v<T, std::string>) {
          return nb::cast(all);
        } else {
          return nb::cast(array_of<T>(std::vector<T>(all), {all.size()}));
        }
      },
      column.values);
  return nb::make_tuple(column.name, column.width, column.values.index(), values);
}

template <class T>
std::vector<T> values_of_state(const nb::object& state) {
  if constexpr (std::is_same_v<T, std::string>) {
    return nb::cast<std::vector<std::string>>(state);
  } else {
    const auto values = nb::cast<nb::ndarray<const T, nb::ndim<1>, nb::c_contig>>(state);
    return {values.data(), values.data() + values.size()};
  }
}

BatchColumn column_of_state(const nb::tuple& state) {
  BatchColumn column{nb::cast<std::string>(state[0]), nb::cast<std::size_t>(state[1]), {}};
  const nb::object values = state[3];
  switch (nb::cast<std::size_t>(state[2])) {
    case 0:
      column.values = values_of_state<std::int8_t>(values);
      break;
    case 1:
      column.values = values_of_state<std::int64_t>(values);
      break;
    case 2:
      column.values = values_of_state<double>(values);
      break;
    default:
      column.values = values_of_state<std::string>(values);
  }
  return column;
}

nb::list columns_of(const BatchTable& table) {
  nb::list columns;
  for (const BatchColumn& column : table.columns) {
    columns.append(nb::make_tuple(column.name, values_of(column, table.rows)));
  }
  return columns;
}

}  // namespace

void bind_batches(nb::module_& m) {
  nb::class_<BatchTable> type(m, "BatchTable", "Rows as columns.");
  bind_state(
      type,
      [](const BatchTable& table) {
        nb::list columns;
        for (const BatchColumn& column : table.columns) columns.append(state_of_column(column));
        return nb::make_tuple(table.rows, table.leading, columns, table.about);
      },
      [](const nb::object& state) {
        const auto parts = nb::cast<nb::tuple>(state);
        BatchTable table;
        table.rows = nb::cast<std::size_t>(parts[0]);
        table.leading = nb::cast<std::size_t>(parts[1]);
        for (const nb::handle column : nb::cast<nb::list>(parts[2])) {
          table.columns.push_back(column_of_state(nb::cast<nb::tuple>(column)));
        }
        table.about = nb::cast<std::vector<std::pair<std::string, std::string>>>(parts[3]);
        return table;
      });
  type.def_prop_ro("rows", [](const BatchTable& table) { return table.rows; })
      .def_prop_ro("leading", [](const BatchTable& table) { return table.leading; })
      .def_prop_ro("columns", &columns_of)
      .def("write", [](const BatchTable& table, const std::string& path, bool with_coefficients,
                       bool raw_cells) {
        const nb::gil_scoped_release release;
        write_batch(table, path, with_coefficients, raw_cells);
      });
  nb::class_<BatchJournal>(m, "BatchJournal", "Rows that are done, in a file.")
      .def("__init__",
           [](BatchJournal* self, const std::string& path, const std::vector<std::string>& job,
              std::size_t rows) { new (self) BatchJournal(path, fingerprint(job), rows); })
      .def_prop_ro("done", &BatchJournal::done)
      .def("has", &BatchJournal::has)
      .def("append", [](BatchJournal& journal, std::size_t row,
                        const nb::dict& cells) { journal.append(row, row_of(cells)); })
      .def("read",
           [](const BatchJournal& journal, std::size_t row) { return dict_of(journal.read(row)); })
      .def("remove", &BatchJournal::remove);
  m.def("gather_batch", [](const std::vector<std::string>& leading, const nb::list& rows) {
    return gather_batch(leading, rows.size(),
                        [&](std::size_t i) { return row_of(nb::cast<nb::dict>(rows[i])); });
  });
  m.def("read_batch", [](const std::string& path) {
    const nb::gil_scoped_release release;
    return read_batch(path);
  });
}

}  // namespace rholm::python
