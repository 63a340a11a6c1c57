// Populations: many shapes, each with one row of results in a table. Layer: model.
//
// The caller computes the rows. This header provides the list of shapes, the journal that makes a
// long run restartable, and the files of the table. docs/batch.md describes the layouts.
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
  std::string id;                   // unique; the path if the manifest has no ids
  std::string path;                 // as written in the manifest; relative to the manifest
  std::vector<std::string> values;  // values of the other columns
};

// A list of shapes: CSV (RFC 4180) whose first line names the columns.
struct Manifest {
  std::vector<std::string> columns;  // besides id and path, in file order
  std::vector<ManifestItem> items;   // in file order
};
inline constexpr std::size_t kMaxManifestField = 65536;  // bytes: chosen, above any path
// Parses a manifest; `name` is for messages. Throws InvalidInput with the line. Causes: no column
// `path`, no rows, a repeated name or id, unmatched quotes, rows too long or too short. Further
// causes: a field above kMaxManifestField bytes, invalid UTF-8, a name that the results use
// (is_batch_column()).
Manifest parse_manifest(std::span<const char> text, const std::string& name);
// Returns the columns that rholm batch always writes, in order; they come first.
std::vector<std::string> batch_columns();
// Returns true if results use this column name, so that a manifest may not.
bool is_batch_column(std::string_view name);

// Value of a row in a column. A missing value is monostate, an empty list, or a NaN.
using Cell =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;
// A row: pairs of column name and value; each name occurs once.
using BatchRow = std::vector<std::pair<std::string, Cell>>;

// Finished rows, appended to a file, so that a run that was killed does not repeat them. Each row
// has a checksum; rows from the first damaged or incomplete one on are dropped. The journal
// protects against interrupted programs, not against power failures.
class BatchJournal {
 public:
  // Opens the journal, or creates it. `job` is a fingerprint of the work, `rows` the number of
  // rows. Throws InvalidInput for the journal of another job or a file that is no journal. Throws
  // Io if the file cannot be read or written, or if another program is writing to it.
  BatchJournal(const std::filesystem::path& path, std::uint64_t job, std::size_t rows);
  ~BatchJournal();
  BatchJournal(const BatchJournal&) = delete;
  BatchJournal& operator=(const BatchJournal&) = delete;

  std::size_t done() const;           // number of stored rows
  bool has(std::size_t row) const;    // true if the row is stored
  std::size_t dropped_bytes() const;  // damaged bytes dropped at opening
  // Adds a row. Thread-safe. Throws Io.
  void append(std::size_t row, const BatchRow& cells);
  // Reads a stored row. Thread-safe. Throws Io; InvalidInput if the file has changed since.
  BatchRow read(std::size_t row) const;
  // Deletes the file, once the results are written.
  void remove();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns a fingerprint of texts and their order, for BatchJournal: FNV-1a of 64 bits.
std::uint64_t fingerprint(std::span<const std::string> texts);

// A column of a table. A row has one value, or `width` numbers if `width` is not 0.
struct BatchColumn {
  std::string name;       // unique in a table
  std::size_t width = 0;  // 0: one value per row; shorter lists end in NaN
  // Booleans as 1 and 0, and -1 for a missing value; whole numbers if every row has one; other
  // numbers, with NaN for a missing value; texts.
  std::variant<std::vector<std::int8_t>, std::vector<std::int64_t>, std::vector<double>,
               std::vector<std::string>>
      values;
};

// A table. The first `leading` columns keep their order; the others are sorted by name.
struct BatchTable {
  std::size_t rows = 0;                                    // number of shapes
  std::size_t leading = 0;                                 // number of leading columns
  std::vector<BatchColumn> columns;                        // each with all rows
  std::vector<std::pair<std::string, std::string>> about;  // metadata for HDF5: key and value

  const BatchColumn* find(std::string_view name) const;  // null if there is none
  BatchRow row(std::size_t i) const;                     // without missing values
};

// Makes the table of `rows` rows; calls `row` twice for each. Leaves out columns without values,
// except `leading`, which come first. Same rows, same table, in whatever order they came.
BatchTable gather_batch(std::span<const std::string> leading, std::size_t rows,
                        const std::function<BatchRow(std::size_t)>& row);

// Returns the order of names: digits count as numbers, so that a.2 comes before a.10.
bool column_before(std::string_view a, std::string_view b);

// Writes a table as HDF5 (.h5) or CSV (.csv, or "-"), completely or not at all. In CSV a list takes
// several columns, name.0, name.1, ...; columns of coefficients are left out if not
// `with_coefficients`. Texts in CSV that spreadsheets take for formulas (they begin with = + - @
// and are no numbers) get an apostrophe in front, unless `raw_cells`. read_batch() and
// parse_manifest() remove it. Throws Io, InvalidInput for another extension.
void write_batch(const BatchTable& table, const std::filesystem::path& path,
                 bool with_coefficients = true, bool raw_cells = false);
// Reads the table of a file. CSV does not state types: its values are all texts, and its columns
// keep the order of the file. Throws Io, InvalidInput, Unsupported.
BatchTable read_batch(const std::filesystem::path& path);

}  // namespace rholm
