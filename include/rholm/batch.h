// Populations: many shapes, one row of results each, in a table. Layer: model.
//
// What runs for a row is the caller's: here is what surrounds it, the list of shapes, the journal
// that makes a long run restartable, and the table in its files. docs/batch.md has the layouts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rholm {

// A shape of a manifest.
struct ManifestItem {
  std::string id;                   // unique; the path where the manifest has no ids
  std::string path;                 // as it stands there: relative to the manifest
  std::vector<std::string> values;  // of the other columns
};

// A list of shapes: CSV (RFC 4180), its first line the names of the columns.
struct Manifest {
  std::vector<std::string> columns;  // besides id and path, in their order
  std::vector<ManifestItem> items;   // in their order
};
inline constexpr std::size_t kMaxManifestField = 65536;  // bytes: chosen, above any path
// The list that a text is. Throws InvalidInput with the line: no column `path`, no rows, a name or
// an id that stands twice, quotes that do not match, a row that is too long or too short, a field
// above kMaxManifestField bytes, what is not UTF-8, a name that results need for themselves
// (is_batch_column()). `name` is for messages.
Manifest parse_manifest(std::span<const char> text, const std::string& name);
// The columns that results of rholm batch have in any case, first those in front.
std::vector<std::string> batch_columns();
// Whether a manifest may not use that name.
bool is_batch_column(std::string_view name);

// The value of a row in a column. Not there: monostate, an empty list, a NaN.
using Cell =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;
// A row: names of columns, each once, and values.
using BatchRow = std::vector<std::pair<std::string, Cell>>;

// Rows that are done, kept in a file to which they are appended: what a killed run has done is not
// done again. Each has a checksum; from the first one on that is damaged or not whole, the rest is
// dropped. The promise is against interrupted programs, not against power failures.
class BatchJournal {
 public:
  // Opens the journal, or begins it. `job` is a fingerprint of what is done, `rows` how many there
  // are. Throws InvalidInput for the journal of another job and for what is no journal, Io for
  // what cannot be read or written, and if another program is writing to it.
  BatchJournal(const std::filesystem::path& path, std::uint64_t job, std::size_t rows);
  ~BatchJournal();
  BatchJournal(const BatchJournal&) = delete;
  BatchJournal& operator=(const BatchJournal&) = delete;

  std::size_t done() const;           // how many rows it has
  bool has(std::size_t row) const;    // whether it has that one
  std::size_t dropped_bytes() const;  // that were damaged when it was opened
  // Adds a row; any thread may. Throws Io.
  void append(std::size_t row, const BatchRow& cells);
  // One that it has; any thread may. Throws Io, InvalidInput if the file has changed since.
  BatchRow read(std::size_t row) const;
  // Deletes the file: the results are written.
  void remove();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A fingerprint of texts in their order, for BatchJournal: FNV-1a of 64 bits.
std::uint64_t fingerprint(std::span<const std::string> texts);

// A column of a table. A row has one value, or, if `width` is not 0, as many numbers.
struct BatchColumn {
  std::string name;       // once in a table
  std::size_t width = 0;  // 0: one value a row; lists that are shorter end in NaN
  // Booleans as 1 and 0, -1 where there is none; whole numbers, where every row has one; other
  // numbers, NaN where there is none; texts.
  std::variant<std::vector<std::int8_t>, std::vector<std::int64_t>, std::vector<double>,
               std::vector<std::string>>
      values;
};

// A table. The order of its columns is that of their names but for the first `leading` ones.
struct BatchTable {
  std::size_t rows = 0;                                    // shapes
  std::size_t leading = 0;                                 // columns in front
  std::vector<BatchColumn> columns;                        // each with all rows
  std::vector<std::pair<std::string, std::string>> about;  // what it is of, for HDF5

  const BatchColumn* find(std::string_view name) const;  // null if there is none
  BatchRow row(std::size_t i) const;                     // without what it has not
};

// The table of `rows` rows; `row` is asked twice for each. Columns that no row has are left out,
// but for `leading`, which come first. Same rows, same table, however they were found.
BatchTable gather_batch(std::span<const std::string> leading, std::size_t rows,
                        const std::function<BatchRow(std::size_t)>& row);

// Names in their order: digits within them count as numbers, so that a.2 comes before a.10.
bool column_before(std::string_view a, std::string_view b);

// As HDF5 (.h5) or CSV (.csv, or "-"), whole or not at all. In CSV a list is as many columns,
// name.0, name.1, ...; `with_coefficients` is whether those named coefficients are among them.
// Texts in CSV that programs for tables take for formulas (they begin with = + - @ and are no
// numbers) have an apostrophe before them, which read_batch() and parse_manifest() take away,
// unless `raw_cells`. Throws Io, InvalidInput for another extension.
void write_batch(const BatchTable& table, const std::filesystem::path& path,
                 bool with_coefficients = true, bool raw_cells = false);
// The same of a file. Of CSV, which does not say what they are, all values are texts, and columns
// in the order of the file. Throws Io, InvalidInput, Unsupported.
BatchTable read_batch(const std::filesystem::path& path);

}  // namespace rholm
