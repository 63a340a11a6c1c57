// A table of numbers as text: its header, and how its rows are split into cells. Layer: io.
//
// Cells are separated by blanks (where commas and semicolons count as blanks), or each ended by a
// comma, semicolon or tab. The first rows determine the separator, and whether the decimal mark is
// a comma. #, // and % begin comments.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/number_text.h"

namespace rholm {

// How rows are split into cells.
struct TableSyntax {
  char separator = ' ';        // ' ' is any run of blanks, commas and semicolons
  bool decimal_comma = false;  // a comma within a cell is the decimal mark
  bool open_end = false;       // every row ends with a separator, after which there is no cell
  std::size_t columns = 0;     // cells of the first row; 0: there is none
};

// The text before the first row of values.
struct TableHeader {
  std::vector<std::string> names = {};  // none, or one name for each column
  bool has_count = false;
  double count = 0;  // claimed number of points
  TableSyntax syntax = {};
  std::size_t rows_at = 0;                // byte offset of the first row
  std::vector<std::string> remarks = {};  // unusual properties of the table, for people
  // The text that should be names of columns but does not fit them; or empty.
  std::string unfit_names = {};
  std::size_t unfit = 0;  // number of unfit names
};

// The content of a cell.
enum class CellKind { kNumber, kMissing, kText };
struct TableCell {
  CellKind kind = CellKind::kMissing;
  double value = 0;            // NaN if it is missing
  std::string_view text = {};  // unchanged text of the file, with quotes
};

// Returns in `value` the number of a cell, which may be in quotes. False if it has no number.
bool number_of_cell(std::string_view cell, bool decimal_comma, double& value);

// Splits rows at `text` into cells; text after a comment mark belongs to no cell.
class TableRows {
 public:
  TableRows(TextCursor& text, const TableSyntax& syntax) : text_(text), syntax_(syntax) {}
  // Moves to the first cell of the next row, over empty lines and comments; false at the end.
  bool next_row();
  // Takes the next cell of the row; false if there is none.
  bool take_cell(TableCell& cell);
  // Does the same, much faster, for a number in the usual form. Returns false, without moving, for
  // any other cell.
  bool take_plain_number(double& value);
  // Moves to the end of the line.
  void end_row();

 private:
  bool take_any_cell(TableCell& cell);
  void pass_separator();

  TextCursor& text_;
  const TableSyntax& syntax_;
  bool row_open_ = false;  // a cell follows, which may be empty
};

// Values of the first rows, which determine the roles of columns. Cells without a number are NaN.
struct TellingRows {
  std::vector<std::vector<double>> columns;
  std::vector<std::size_t> texts;  // cells of each column that are neither numbers nor missing
  std::size_t rows = 0;
};

// Number of bytes at the start of a text that determine its format: 20 000 rows of usual length.
// Chosen: a stream holds them while it is opened.
inline constexpr std::size_t kTellingBytes = std::size_t{1} << 20;

// Returns the header of a text. `begin` is its first kTellingBytes, or all of it (`is_all`).
TableHeader look_at_table(std::span<const char> begin, bool is_all);
// Returns the whole rows of `begin` after its header, without rows of another length.
TellingRows telling_rows(std::span<const char> begin, bool is_all, const TableHeader& header);

}  // namespace rholm
