// Tables as HDF5: a dataset for each column. Layout: docs/batch.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/hdf5/hdf5_values.h"
#include "io/hdf5/hdf5_writer.h"
#include "model/batch/table_parts.h"
#include "rholm/error.h"
#include "rholm/version.h"

namespace rholm {
namespace {

using hdf5::Writer;

void write_column(Writer& writer, const BatchColumn& column, std::size_t rows) {
  const char* name = column.name.c_str();
  const std::array<std::uint64_t, 2> extents = {rows, column.width};
  const std::span<const std::uint64_t> shape(extents.data(), column.width == 0 ? 1 : 2);
  if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
    writer.write_texts(Writer::kRoot, name, *texts);
  } else if (const auto* booleans = std::get_if<std::vector<std::int8_t>>(&column.values)) {
    const Writer::Object dataset =
        writer.write_dataset(Writer::kRoot, name, shape, booleans->data());
    writer.write_attribute(dataset, kBooleanMark, 1);
  } else if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
    writer.write_dataset(Writer::kRoot, name, shape, wholes->data());
  } else {
    writer.write_dataset(Writer::kRoot, name, shape,
                         std::get<std::vector<double>>(column.values).data());
  }
}

// Checks a name: HDF5 takes a slash for a folder, and two names are reserved.
void check_name(const std::string& column, const std::string& name) {
  if (!column.empty() && column != "." && column.find('/') == std::string::npos &&
      column != kColumnNames && column != kBatchAbout) {
    return;
  }
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("{}: no column can be called '{}' in HDF5: take another name, or .csv",
                          name, column));
}

// Makes a table from a file's columns; each must have a value for every row.
class Reader {
 public:
  Reader(std::span<const char> bytes, const std::string& name)
      : file_(hdf5::open({bytes.data(), bytes.size()}, name)), root_(hdf5::root_group(file_)) {}

  BatchTable table() {
    check_version();
    BatchTable table;
    table.rows = count(kBatchRows);
    table.leading = count(kBatchLeading);
    for (const std::string& name : texts_of(kColumnNames)) table.columns.push_back(column(name));
    if (table.leading > table.columns.size()) fail("more columns lead than there are");
    for (const BatchColumn& one : table.columns) check(one, table.rows);
    about(table);
    return table;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::kInvalidInput, fmt::format("{}: {}", file_.name, what));
  }

  hdf5::Array attribute(const char* name) const {
    const auto found = hdf5::find_attribute(file_, root_, name);
    if (!found) fail(fmt::format("is no table of results: it has no attribute '{}'", name));
    return *found;
  }

  std::size_t count(const char* name) const {
    const std::int64_t value = hdf5::to_integer(file_, attribute(name));
    if (value < 0) fail(fmt::format("'{}' is {}", name, value));
    return static_cast<std::size_t>(value);
  }

  void check_version() const {
    if (hdf5::to_text(file_, attribute("format")) != kBatchFormat) {
      fail("is HDF5, but no table of results");
    }
    if (hdf5::to_integer(file_, attribute("version_major")) != kBatchMajor) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} was written by a newer rholm: take that", file_.name));
    }
  }

  hdf5::Array array(const std::string& name) const {
    return hdf5::read_dataset(file_, hdf5::open_member(file_, root_, name));
  }

  std::vector<std::string> texts_of(const std::string& name) const {
    return hdf5::to_texts(file_, array(name));
  }

  BatchColumn column(const std::string& name) const {
    const hdf5::Object dataset = hdf5::open_member(file_, root_, name);
    const hdf5::Array values = hdf5::read_dataset(file_, dataset);
    if (values.extents.empty() || values.extents.size() > 2) {
      fail(fmt::format("'{}' is no column", name));
    }
    BatchColumn column{.name = name, .width = 0, .values = {}};
    if (values.extents.size() == 2) column.width = values.extents[1];
    if (values.type.kind == hdf5::Kind::kFloat) {
      column.values = hdf5::to_doubles(file_, values);
    } else if (column.width != 0) {
      fail(fmt::format("the lists of '{}' are not of numbers", name));
    } else if (values.type.kind != hdf5::Kind::kInteger) {
      column.values = hdf5::to_texts(file_, values);
    } else if (hdf5::find_attribute(file_, dataset, kBooleanMark)) {
      column.values = booleans(hdf5::to_integers(file_, values), name);
    } else {
      column.values = hdf5::to_integers(file_, values);
    }
    return column;
  }

  std::vector<std::int8_t> booleans(const std::vector<std::int64_t>& values,
                                    const std::string& name) const {
    std::vector<std::int8_t> result;
    result.reserve(values.size());
    for (const std::int64_t value : values) {
      if (value < -1 || value > 1)
        fail(fmt::format("{} in '{}' is neither yes nor no", value, name));
      result.push_back(static_cast<std::int8_t>(value));
    }
    return result;
  }

  void check(const BatchColumn& column, std::size_t rows) const {
    const std::size_t size = std::visit([](const auto& v) { return v.size(); }, column.values);
    const std::size_t width = std::max<std::size_t>(column.width, 1);
    if (size / width != rows || size % width != 0) {
      fail(fmt::format("'{}' has {} values for {} rows", column.name, size, rows));
    }
  }

  void about(BatchTable& table) const {
    for (const std::string& line : texts_of(kBatchAbout)) {
      const std::size_t sign = line.find('=');
      if (sign == std::string::npos) fail("'about' has a line without a value");
      table.about.emplace_back(line.substr(0, sign), line.substr(sign + 1));
    }
  }

  hdf5::File file_;
  hdf5::Object root_;
};

}  // namespace

void write_table_hdf5(const BatchTable& table, const std::filesystem::path& path) {
  const std::string name = path.string();
  AtomicFile output(path);
  if (output.temporary_path().empty()) {
    throw Error(ErrorCode::kUnsupported,
                name + ": HDF5 needs a file that can be rewound, not a pipe: write .csv instead");
  }
  Writer writer(name, output.temporary_path().string(), table.columns.size() + 2);
  writer.write_attribute(Writer::kRoot, "format", std::string(kBatchFormat));
  writer.write_attribute(Writer::kRoot, "version_major", kBatchMajor);
  writer.write_attribute(Writer::kRoot, "version_minor", kBatchMinor);
  writer.write_attribute(Writer::kRoot, "program", std::string("rholm ") + kVersion);
  writer.write_attribute(Writer::kRoot, kBatchRows, static_cast<int>(table.rows));
  writer.write_attribute(Writer::kRoot, kBatchLeading, static_cast<int>(table.leading));
  std::vector<std::string> names, about;
  for (const BatchColumn& column : table.columns) {
    check_name(column.name, name);
    names.push_back(column.name);
  }
  for (const auto& [key, value] : table.about) about.push_back(key + "=" + value);
  writer.write_texts(Writer::kRoot, kColumnNames, names);
  writer.write_texts(Writer::kRoot, kBatchAbout, about);
  for (const BatchColumn& column : table.columns) {
    write_column(writer, column, table.rows);
  }
  writer.close();
  output.commit();
}

BatchTable parse_table_hdf5(std::span<const char> bytes, const std::string& name) {
  return Reader(bytes, name).table();
}

}  // namespace rholm
