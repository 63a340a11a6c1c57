// A table of numbers as text: its header, and how its rows are cut into cells. Layer: io.
//
// Cells stand between blanks (where commas and semicolons count as blanks), or between commas,
// semicolons or tabs, of which each ends a cell. The first rows tell which, and whether the decimal
// mark is a comma. #, // and % begin comments.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/number_text.h"

namespace rholm {

// How rows are cut.
struct TableSyntax {
  char separator = ' ';        // ' ' is any run of blanks, commas and semicolons
  bool decimal_comma = false;  // a comma within a cell is the decimal mark
  bool open_end = false;       // every row ends with a separator, behind which is no cell
  std::size_t columns = 0;     // cells of the first row; 0: there is none
};

// What stands before the first row of values.
struct TableHeader {
  std::vector<std::string> names = {};  // of the columns; none, or as many as there are columns
  bool has_count = false;
  double count = 0;  // of points, as claimed
  TableSyntax syntax = {};
  std::size_t rows_at = 0;                // where the first row begins: bytes from the begin
  std::vector<std::string> remarks = {};  // for people: what a table usually has not
  // What names of columns should be and does not fit them, as it stands in the text; or empty.
  std::string unfit_names = {};
  std::size_t unfit = 0;  // how many
};

// What a cell holds.
enum class CellKind { kNumber, kMissing, kText };
struct TableCell {
  CellKind kind = CellKind::kMissing;
  double value = 0;            // NaN if it is missing
  std::string_view text = {};  // as it stands in the file, with quotes
};

// The number that a cell holds, which may stand in quotes. False if it is none.
bool number_of_cell(std::string_view cell, bool decimal_comma, double& value);

// Cuts rows at `text`; what is behind a comment mark belongs to no cell.
class TableRows {
 public:
  TableRows(TextCursor& text, const TableSyntax& syntax) : text_(text), syntax_(syntax) {}
  // To the first cell of the next row, over empty lines and comments; false at the end.
  bool next_row();
  // The next cell of the row; false if there is none.
  bool take_cell(TableCell& cell);
  // The same of a number that is written in the usual way, much faster; false, without moving, for
  // any other cell.
  bool take_plain_number(double& value);
  // Passes to the end of the line.
  void end_row();

 private:
  bool take_any_cell(TableCell& cell);
  void pass_separator();

  TextCursor& text_;
  const TableSyntax& syntax_;
  bool row_open_ = false;  // a cell follows, though it may be empty
};

// The values of the first rows, as they tell what columns are. Cells without a number are NaN.
struct TellingRows {
  std::vector<std::vector<double>> columns;
  std::vector<std::size_t> texts;  // cells of each column that are neither numbers nor missing
  std::size_t rows = 0;
};

// Bytes at the begin of a text that tell what it is: 20 000 rows of usual length. Chosen: a stream
// holds them while it is opened.
inline constexpr std::size_t kTellingBytes = std::size_t{1} << 20;

// The header of a text. `begin` is the first kTellingBytes of it, or all (`is_all`).
TableHeader look_at_table(std::span<const char> begin, bool is_all);
// Whole rows of `begin` behind its header; those of another length are left out.
TellingRows telling_rows(std::span<const char> begin, bool is_all, const TableHeader& header);

}  // namespace rholm
