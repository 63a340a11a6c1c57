#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "model/batch/csv.h"
#include "model/batch/table_parts.h"
#include "rholm/batch.h"
#include "rholm/error.h"

namespace rholm {
namespace {

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, fmt::format("{}: line {}: {}", name, line, what));
}

// Checks that columns of results may have these names: HDF5 takes a slash for a folder.
void check_names(const CsvRecord& header, const std::string& name) {
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::string& column = header.fields[i];
    const auto before = header.fields.begin() + static_cast<std::ptrdiff_t>(i);
    if (column.empty()) fail(name, header.line, fmt::format("column {} has no name", i + 1));
    if (column == "." || column.find('/') != std::string::npos) {
      fail(name, header.line,
           fmt::format("no column can be called {}: take a name without a slash",
                       in_quotes(column)));
    }
    if (std::find(header.fields.begin(), before, column) != before) {
      fail(name, header.line, fmt::format("two columns are called {}", in_quotes(column)));
    }
    if (column != "path" && column != "id" && is_batch_column(column)) {
      fail(name, header.line,
           fmt::format("the results have a column {} of their own: take another name",
                       in_quotes(column)));
    }
  }
}

}  // namespace

std::vector<std::string> batch_columns() {
  return {"id", "path", "exit_code", "message", "warnings", "seconds", "cpu_seconds"};
}

bool is_batch_column(std::string_view name) {
  const std::vector<std::string> own = batch_columns();
  return name == kColumnNames || name == kBatchAbout || name == kCoefficientsColumn ||
         std::find(own.begin(), own.end(), name) != own.end();
}

Manifest parse_manifest(std::span<const char> text, const std::string& name) {
  const std::vector<CsvRecord> records = parse_csv(text, name, kMaxManifestField);
  if (records.empty()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is empty; a manifest has a line of names, one of them path, and a "
                            "line for each shape",
                            name));
  }
  const CsvRecord& header = records.front();
  check_names(header, name);
  std::optional<std::size_t> path, id;
  Manifest manifest;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    if (header.fields[i] == "path") {
      path = i;
    } else if (header.fields[i] == "id") {
      id = i;
    } else {
      manifest.columns.push_back(header.fields[i]);
    }
  }
  if (!path) {
    fail(name, header.line,
         fmt::format("there is no column 'path'; there are {}",
                     in_quotes(fmt::format("{}", fmt::join(header.fields, ",")))));
  }
  if (records.size() == 1) fail(name, header.line, "no shapes follow the names of the columns");
  std::unordered_map<std::string, std::size_t> lines;  // line of each id
  for (std::size_t r = 1; r < records.size(); ++r) {
    const CsvRecord& record = records[r];
    ManifestItem item{record.fields[id.value_or(*path)], record.fields[*path], {}};
    if (item.path.empty()) fail(name, record.line, "the path is empty");
    if (item.id.empty()) fail(name, record.line, "the id is empty");
    const auto [twin, is_new] = lines.emplace(item.id, record.line);
    if (!is_new) {
      fail(name, record.line,
           fmt::format("the id {} stands in line {} already{}", in_quotes(item.id), twin->second,
                       id ? "" : "; give the shapes ids of their own in a column 'id'"));
    }
    for (std::size_t i = 0; i < record.fields.size(); ++i) {
      if (i != *path && i != id) item.values.push_back(record.fields[i]);
    }
    manifest.items.push_back(std::move(item));
  }
  return manifest;
}

}  // namespace rholm
