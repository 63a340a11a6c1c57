// Converts rows to columns, and back.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/file/bytes.h"
#include "io/hdf5/hdf5_objects.h"
#include "model/batch/table_parts.h"
#include "rholm/batch.h"
#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view take_digits(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  const std::string_view digits = text.substr(0, n);
  text.remove_prefix(n);
  return digits;
}

// The kinds of cells in a column.
struct Kind {
  bool booleans = false, wholes = false, reals = false, texts = false, lists = false;
  std::size_t width = 0;  // length of the longest list
  std::size_t rows = 0;   // number of rows with a value
};

struct NameOrder {
  bool operator()(std::string_view a, std::string_view b) const { return column_before(a, b); }
};
using Kinds = std::map<std::string, Kind, NameOrder>;

void look_at(const Cell& cell, Kind& kind) {
  if (!has_value(cell)) return;
  ++kind.rows;
  kind.booleans |= std::holds_alternative<bool>(cell);
  kind.wholes |= std::holds_alternative<std::int64_t>(cell);
  kind.reals |= std::holds_alternative<double>(cell);
  kind.texts |= std::holds_alternative<std::string>(cell);
  if (const auto* list = std::get_if<std::vector<double>>(&cell)) {
    kind.lists = true;
    kind.width = std::max(kind.width, trimmed(*list).size());
  }
}

// Columns of mixed kinds become texts; a number among lists is a list of one.
BatchColumn empty_column(const std::string& name, const Kind& kind, std::size_t rows) {
  BatchColumn column{.name = name, .width = 0, .values = {}};
  const bool numbers = kind.wholes || kind.reals || kind.lists;
  if (kind.texts || (kind.booleans && numbers) || kind.rows == 0) {
    column.values = std::vector<std::string>(rows);
  } else if (kind.booleans) {
    column.values = std::vector<std::int8_t>(rows, -1);
  } else if (kind.lists) {
    column.width = std::max<std::size_t>(kind.width, 1);
    column.values = std::vector<double>(rows * column.width, kNone);
  } else if (kind.reals || kind.rows < rows) {
    column.values = std::vector<double>(rows, kNone);
  } else {
    column.values = std::vector<std::int64_t>(rows);
  }
  return column;
}

double number_of(const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::get<double>(cell);
}

void put(const Cell& cell, BatchColumn& column, std::size_t row) {
  if (!has_value(cell)) return;
  if (auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
    (*texts)[row] = cell_text(cell);
  } else if (auto* booleans = std::get_if<std::vector<std::int8_t>>(&column.values)) {
    (*booleans)[row] = std::get<bool>(cell) ? 1 : 0;
  } else if (auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
    (*wholes)[row] = std::get<std::int64_t>(cell);
  } else if (auto& numbers = std::get<std::vector<double>>(column.values); column.width == 0) {
    numbers[row] = number_of(cell);
  } else if (const auto* list = std::get_if<std::vector<double>>(&cell)) {
    std::ranges::copy(trimmed(*list),
                      numbers.begin() + static_cast<std::ptrdiff_t>(row * column.width));
  } else {
    numbers[row * column.width] = number_of(cell);
  }
}

Cell cell_of(const BatchColumn& column, std::size_t row) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
    return (*texts)[row];
  }
  if (const auto* booleans = std::get_if<std::vector<std::int8_t>>(&column.values)) {
    return (*booleans)[row] < 0 ? Cell() : Cell((*booleans)[row] == 1);
  }
  if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
    return (*wholes)[row];
  }
  const auto& numbers = std::get<std::vector<double>>(column.values);
  if (column.width == 0) return numbers[row];
  const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(row * column.width);
  return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(column.width));
}

}  // namespace

bool column_before(std::string_view a, std::string_view b) {
  std::string_view x = a, y = b;
  while (!x.empty() && !y.empty()) {
    if (is_digit(x.front()) && is_digit(y.front())) {
      std::string_view m = take_digits(x), n = take_digits(y);
      m.remove_prefix(std::min(m.find_first_not_of('0'), m.size()));
      n.remove_prefix(std::min(n.find_first_not_of('0'), n.size()));
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else if (x.front() != y.front()) {
      return static_cast<unsigned char>(x.front()) < static_cast<unsigned char>(y.front());
    } else {
      x.remove_prefix(1), y.remove_prefix(1);
    }
  }
  if (x.empty() != y.empty()) return x.empty();
  return a < b;  // they differ only by leading zeros
}

std::span<const double> trimmed(const std::vector<double>& list) {
  std::size_t n = list.size();
  while (n > 0 && std::isnan(list[n - 1])) --n;
  return {list.data(), n};
}

bool has_value(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return !std::isnan(*number);
  if (const auto* text = std::get_if<std::string>(&cell)) return !text->empty();
  if (const auto* list = std::get_if<std::vector<double>>(&cell)) return !trimmed(*list).empty();
  return !std::holds_alternative<std::monostate>(cell);
}

const BatchColumn* BatchTable::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const BatchColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

BatchRow BatchTable::row(std::size_t i) const {
  BatchRow cells;
  for (const BatchColumn& column : columns) {
    Cell cell = cell_of(column, i);
    if (has_value(cell)) cells.emplace_back(column.name, std::move(cell));
  }
  return cells;
}

BatchTable gather_batch(std::span<const std::string> leading, std::size_t rows,
                        const std::function<BatchRow(std::size_t)>& row) {
  Kinds kinds;
  for (std::size_t i = 0; i < rows; ++i) {
    for (const auto& [name, cell] : row(i)) look_at(cell, kinds[name]);
  }
  BatchTable table{.rows = rows, .leading = leading.size(), .columns = {}, .about = {}};
  std::map<std::string, std::size_t, std::less<>> places;
  const auto add = [&](const std::string& name) {
    places.emplace(name, table.columns.size());
    table.columns.push_back(empty_column(name, kinds[name], rows));
  };
  for (const std::string& name : leading) add(name);
  for (const auto& [name, kind] : kinds) {
    if (kind.rows > 0 && !places.contains(name)) add(name);
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (const auto& [name, cell] : row(i)) {
      if (const auto place = places.find(name); place != places.end()) {
        put(cell, table.columns[place->second], i);
      }
    }
  }
  return table;
}

void write_batch(const BatchTable& table, const std::filesystem::path& path, bool with_coefficients,
                 bool raw_cells) {
  if (path.extension() == ".h5") return write_table_hdf5(table, path);
  if (path != "-" && path.extension() != ".csv") {
    throw Error(ErrorCode::kInvalidInput,
                path.string() + ": a table is written as .h5 (HDF5) or .csv");
  }
  write_file(path, table_csv(table, with_coefficients, raw_cells));
}

BatchTable read_batch(const std::filesystem::path& path) {
  const Bytes file = read_bytes(path);
  const std::string_view bytes(file.view().data(), file.view().size());
  return hdf5::has_signature(bytes) ? parse_table_hdf5(file.view(), path.string())
                                    : parse_table_csv(file.view(), path.string());
}

}  // namespace rholm
