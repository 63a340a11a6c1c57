// Tables as comma-separated values.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "model/batch/csv.h"
#include "model/batch/table_parts.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// A column of the file: a column of the table, or one number of each list.
struct Place {
  std::string name;
  const BatchColumn* column;
  std::size_t index;
};

std::vector<Place> places_of(const BatchTable& table, bool with_coefficients) {
  std::vector<Place> places;
  std::size_t leading = 0;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const BatchColumn& column = table.columns[c];
    if (column.name == kCoefficientsColumn && !with_coefficients) continue;
    if (column.width == 0) places.push_back({column.name, &column, 0});
    for (std::size_t k = 0; k < column.width; ++k) {
      places.push_back({fmt::format("{}.{}", column.name, k), &column, k});
    }
    if (c < table.leading) leading = places.size();
  }
  std::sort(places.begin() + static_cast<std::ptrdiff_t>(leading), places.end(),
            [](const Place& a, const Place& b) { return column_before(a.name, b.name); });
  return places;
}

std::string text_of(const Place& place, std::size_t row, bool raw_cells) {
  const auto& values = place.column->values;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&values)) {
    return csv_field((*texts)[row], raw_cells);
  }
  if (const auto* booleans = std::get_if<std::vector<std::int8_t>>(&values)) {
    return (*booleans)[row] < 0 ? "" : (*booleans)[row] == 1 ? "true" : "false";
  }
  if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&values)) {
    return fmt::format("{}", (*wholes)[row]);
  }
  const std::size_t width = std::max<std::size_t>(place.column->width, 1);
  return number_text(std::get<std::vector<double>>(values)[row * width + place.index]);
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return {};
  char text[kMaxNumberLength];
  return {text, format_number(text, value)};
}

std::string cell_text(const Cell& cell) {
  if (!has_value(cell)) return {};
  if (const auto* value = std::get_if<bool>(&cell)) return *value ? "true" : "false";
  if (const auto* value = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *value);
  if (const auto* value = std::get_if<double>(&cell)) return number_text(*value);
  if (const auto* value = std::get_if<std::string>(&cell)) return *value;
  std::string text;
  for (const double number : trimmed(std::get<std::vector<double>>(cell))) {
    text += (text.empty() ? "" : " ") + (std::isnan(number) ? "nan" : number_text(number));
  }
  return text;
}

std::string table_csv(const BatchTable& table, bool with_coefficients, bool raw_cells) {
  const std::vector<Place> places = places_of(table, with_coefficients);
  std::string text;
  const auto line = [&](const auto& field) {
    for (std::size_t i = 0; i < places.size(); ++i) text += (i > 0 ? "," : "") + field(places[i]);
    text += '\n';
  };
  line([&](const Place& place) { return csv_field(place.name, raw_cells); });
  for (std::size_t r = 0; r < table.rows; ++r) {
    line([&](const Place& place) { return text_of(place, r, raw_cells); });
  }
  return text;
}

BatchTable parse_table_csv(std::span<const char> text, const std::string& name) {
  const std::vector<CsvRecord> records =
      parse_csv(text, name, std::numeric_limits<std::size_t>::max());
  if (records.empty()) throw Error(ErrorCode::kInvalidInput, name + " is empty, and no table");
  BatchTable table{.rows = records.size() - 1, .leading = 0, .columns = {}, .about = {}};
  for (std::size_t c = 0; c < records.front().fields.size(); ++c) {
    const std::string& column = records.front().fields[c];
    if (table.find(column) != nullptr) {
      throw Error(ErrorCode::kInvalidInput,
                  fmt::format("{}: two columns are called {}", name, in_quotes(column)));
    }
    std::vector<std::string> values;
    for (std::size_t r = 1; r < records.size(); ++r) values.push_back(records[r].fields[c]);
    table.columns.push_back({.name = column, .width = 0, .values = std::move(values)});
  }
  table.leading = table.columns.size();
  return table;
}

}  // namespace rholm
