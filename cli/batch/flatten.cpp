#include "cli/batch/flatten.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "cli/grammar/values.h"

namespace rholm::cli {
namespace {

bool is_number_or_null(const Json& value) { return value.is_number() || value.is_null(); }

Cell cell_of_list(const Json& list) {
  if (list.empty()) return {};
  if (std::all_of(list.begin(), list.end(), is_number_or_null)) {
    std::vector<double> numbers;
    for (const Json& value : list) {
      numbers.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                        : value.get<double>());
    }
    return numbers;
  }
  if (!std::all_of(list.begin(), list.end(), [](const Json& v) { return v.is_string(); })) {
    return list.dump();
  }
  std::string text;
  for (const Json& value : list) text += (text.empty() ? "" : "; ") + value.get<std::string>();
  return text;
}

Cell cell_of(const Json& value) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > kMost) return value.get<double>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  return value.is_array() ? cell_of_list(value) : Cell();
}

void flatten_within(const Json& object, const std::string& prefix,
                    const std::function<bool(const std::string&)>& wanted, BatchRow& row) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    if (value.is_object()) {
      flatten_within(value, name + ".", wanted, row);
    } else if (wanted(name)) {
      const bool is_there =
          std::any_of(row.begin(), row.end(), [&](const auto& cell) { return cell.first == name; });
      if (!is_there) row.emplace_back(name, cell_of(value));
    }
  }
}

}  // namespace

void flatten(const Json& report, const std::function<bool(const std::string&)>& wanted,
             BatchRow& row) {
  if (report.is_object()) flatten_within(report, "", wanted, row);
}

bool is_of_the_run(const std::string& name) {
  const std::vector<std::string> parts = split(name, '.');
  return std::any_of(parts.begin(), parts.end(), [](const std::string& part) {
    return part == "seconds" || part == "cpu_seconds" || part == "wall_seconds" ||
           part == "times" || part == "peak_memory_bytes";
  });
}

}  // namespace rholm::cli
