#include "io/shapes/text_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/plain_text.h"
#include "io/shapes/column_names.h"

namespace rholm {
namespace {

constexpr std::size_t kMostHeaderLines = 32;         // without numbers; chosen: above any header
constexpr std::size_t kMostTellingRows = 65536;      // chosen
constexpr std::size_t kMostTellingValues = 4 << 20;  // 32 MB; chosen

bool is_separator(char c) { return is_blank(c) || c == ',' || c == ';'; }

bool at_comment(const TextCursor& text) {
  if (text.at_end()) return false;
  if (*text.at == '#' || *text.at == '%') return true;
  return *text.at == '/' && text.at + 1 != text.end && text.at[1] == '/';
}

bool at_row_end(const TextCursor& text) {
  return text.at_end() || is_line_end(*text.at) || at_comment(text);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_quotes(std::string_view text) {
  text = trimmed(text);
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

bool is_quoted(std::string_view text) { return !text.empty() && text.front() == '"'; }

// Returns true for the words that programs write in place of a missing number.
bool is_missing(std::string_view cell) {
  const std::string word = lower_case(without_quotes(cell));
  for (const char* missing : {"", "na", "n/a", "null", "none", "nil", "-", "--", "?", "-nan",
                              "1.#ind", "-1.#ind", "1.#qnan", "-1.#qnan"}) {
    if (word == missing) return true;
  }
  return false;
}

TableCell cell_of(std::string_view text, bool decimal_comma) {
  TableCell cell{.value = std::numeric_limits<double>::quiet_NaN(), .text = text};
  if (number_of_cell(text, decimal_comma || is_quoted(text), cell.value)) {
    cell.kind = std::isnan(cell.value) ? CellKind::kMissing : CellKind::kNumber;
  } else {
    cell.kind = is_missing(text) ? CellKind::kMissing : CellKind::kText;
  }
  return cell;
}

}  // namespace

bool number_of_cell(std::string_view cell, bool decimal_comma, double& value) {
  cell = without_quotes(cell);
  constexpr std::size_t kLongest =
      400;  // characters; a double has at most 767 digits, which few programs write
  std::array<char, kLongest> room;
  if (cell.empty() || cell.size() > room.size()) return false;
  bool has_mark = false;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    char c = cell[i];
    if (c == ',' && !decimal_comma) return false;
    if (c == ',' || c == '.') {
      if (has_mark) return false;
      has_mark = true;
      c = '.';
    }
    // Fortran writes exponents as 1.0D-05.
    const bool behind_digit =
        i > 0 && (room[i - 1] == '.' || (room[i - 1] >= '0' && room[i - 1] <= '9'));
    if ((c == 'd' || c == 'D') && behind_digit) c = 'e';
    room[i] = c;
  }
  TextCursor text(std::span<const char>(room.data(), cell.size()));
  return take_number(text, value) && text.at_end();
}

// ---- Rows ----

bool TableRows::next_row() {
  for (; !text_.at_end(); ++text_.at) {
    const char* const begin = text_.at;
    while (!text_.at_end() && is_separator(*text_.at)) ++text_.at;
    if (!at_row_end(text_)) {
      if (syntax_.separator != ' ') text_.at = begin;
      row_open_ = true;
      return true;
    }
    skip_to_line_end(text_);
    if (text_.at_end()) break;
  }
  row_open_ = false;
  return false;
}

void TableRows::end_row() {
  skip_to_line_end(text_);
  row_open_ = false;
}

// Moves from the end of a cell to the next cell, if there is one.
void TableRows::pass_separator() {
  if (syntax_.separator == ' ') {
    while (!text_.at_end() && is_separator(*text_.at)) ++text_.at;
    row_open_ = !at_row_end(text_);
    return;
  }
  row_open_ = !text_.at_end() && *text_.at == syntax_.separator;
  if (!row_open_) return;
  ++text_.at;
  if (!syntax_.open_end) return;
  TextCursor rest = text_;
  skip_blanks(rest);
  row_open_ = !at_row_end(rest);
}

bool TableRows::take_plain_number(double& value) {
  if (!row_open_) return false;
  const TextCursor before = text_;
  const auto skip = [this] {
    while (!text_.at_end() && is_blank(*text_.at) && *text_.at != syntax_.separator) ++text_.at;
  };
  const bool strict = syntax_.separator != ' ';
  if (strict) skip();
  if (take_number(text_, value)) {
    if (strict) skip();
    const bool ends = strict ? at_row_end(text_) || *text_.at == syntax_.separator
                             : at_row_end(text_) || is_blank(*text_.at) || *text_.at == ';' ||
                                   (*text_.at == ',' && !syntax_.decimal_comma);
    if (ends) {
      pass_separator();
      return true;
    }
  }
  text_ = before;
  return false;
}

bool TableRows::take_any_cell(TableCell& cell) {
  const bool strict = syntax_.separator != ' ';
  while (strict && !text_.at_end() && is_blank(*text_.at) && *text_.at != syntax_.separator) {
    ++text_.at;
  }
  const char* const first = text_.at;
  if (!text_.at_end() && *text_.at == '"') {  // two quotes mean one
    do {
      ++text_.at;
      while (!text_.at_end() && !is_line_end(*text_.at) && *text_.at != '"') ++text_.at;
      if (text_.at_end() || *text_.at != '"') break;
      ++text_.at;
    } while (!text_.at_end() && *text_.at == '"');
  }
  const auto ends = [&] {
    if (at_row_end(text_)) return true;
    if (strict) return *text_.at == syntax_.separator;
    if (*text_.at != ',' || !syntax_.decimal_comma) return is_separator(*text_.at);
    const char* const next = text_.at + 1;  // a comma before a blank only separates
    return next == text_.end || is_blank(*next) || is_line_end(*next);
  };
  while (!ends()) ++text_.at;
  cell =
      cell_of(trimmed({first, static_cast<std::size_t>(text_.at - first)}), syntax_.decimal_comma);
  pass_separator();
  return true;
}

bool TableRows::take_cell(TableCell& cell) { return row_open_ && take_any_cell(cell); }

// ---- Header ----

namespace {

std::span<const char> whole_lines(std::span<const char> begin, bool is_all) {
  if (is_all && begin.size() <= kTellingBytes) return begin;
  begin = begin.first(std::min(begin.size(), kTellingBytes));
  std::size_t n = begin.size();
  while (n > 0 && begin[n - 1] != '\n' && begin[n - 1] != '\r') --n;
  return begin.first(n);
}

// Contents of a row as they appear before its separators are known.
struct LineLook {
  std::size_t numbers = 0, missing = 0, texts = 0;
  bool is_row() const { return texts == 0 ? numbers + missing > 1 : numbers >= 3; }
  bool is_count() const { return numbers == 1 && missing + texts == 0; }
};

LineLook look_at_line(std::string_view line) {
  TextCursor text(line);
  const TableSyntax blanks;
  TableRows rows(text, blanks);
  LineLook look;
  TableCell cell;
  if (!rows.next_row()) return look;
  while (rows.take_cell(cell)) {
    if (cell.kind == CellKind::kNumber) {
      ++look.numbers;
    } else {
      ++(cell.kind == CellKind::kMissing ? look.missing : look.texts);
    }
  }
  return look;
}

// Splits names at separators; `separator` ' ' stands for blanks only.
std::vector<std::string> split_names(std::string_view line, char separator) {
  std::vector<std::string> names;
  std::string name;
  bool quoted = false, any = false;
  const auto put = [&] {
    const std::string_view shown = trimmed(name);
    const bool is_unit = separator == ' ' && !names.empty() && !shown.empty() &&
                         (shown.front() == '(' || shown.front() == '[');
    if (is_unit) {
      names.back() += std::string(" ").append(shown);  // belongs to the name before
    } else if (separator != ' ' || any) {
      names.emplace_back(shown);
    }
    name.clear();
    any = false;
  };
  for (const char c : trimmed(line)) {
    if (c == '"') {
      quoted = !quoted;
      any = true;
    } else if (!quoted && (separator == ' ' ? is_blank(c) : c == separator)) {
      put();
    } else {
      name += c;
      any = true;
    }
  }
  put();
  for (std::string& each : names) {
    const bool single = each.size() >= 2 && each.front() == '\'' && each.back() == '\'';
    if (single) each = each.substr(1, each.size() - 2);
  }
  return names;
}

constexpr std::array<char, 4> kSeparators = {';', '\t', ',', ' '};

bool names_position(std::string_view line) {
  return std::any_of(kSeparators.begin(), kSeparators.end(),
                     [&](char s) { return has_position(split_names(line, s)); });
}

struct NameLine {
  std::string_view text;
  bool is_comment = false;
};

std::string_view without_marks(std::string_view line) {
  while (!line.empty() && (line.front() == '#' || line.front() == '/' || line.front() == '%')) {
    line.remove_prefix(1);
  }
  return line;
}

// Moves to the first row, and returns the lines before it.
std::vector<NameLine> take_lines_before(TextCursor& text, TableHeader& header) {
  std::vector<NameLine> lines;
  std::size_t without_numbers = 0;
  const char* last = nullptr;  // last line without numbers
  while (!text.at_end()) {
    const TextCursor begin = text;
    skip_to_line_end(text);
    const std::string_view line(begin.at, static_cast<std::size_t>(text.at - begin.at));
    TextCursor content = begin;
    content.end = text.at;
    while (!content.at_end() && is_separator(*content.at)) ++content.at;
    const bool is_comment = at_comment(content);
    const LineLook look = is_comment ? LineLook{} : look_at_line(line);
    if (is_comment) {
      lines.push_back({without_marks(trimmed(line)), true});
      if (lines.size() > kMostHeaderLines) lines.erase(lines.begin());
    } else if (look.is_count() && !header.has_count) {
      header.has_count = true;
      TextCursor all(line);
      const TableSyntax blanks;
      TableRows row(all, blanks);
      TableCell cell;
      if (row.next_row() && row.take_cell(cell)) header.count = cell.value;
    } else if (look.is_row() && (look.texts == 0 || !names_position(line))) {
      text = begin;
      return lines;
    } else if (!content.at_end()) {
      if (++without_numbers > kMostHeaderLines || look.is_count()) {
        text = begin;
        return lines;
      }
      lines.push_back({line, false});
      last = content.at;
    }
    while (!text.at_end() && is_line_end(*text.at)) ++text.at;
  }
  if (last != nullptr && !header.has_count) text.at = last;  // no row follows this line
  return lines;
}

// ---- Separators ----

struct Fit {
  bool same = true;  // all rows have as many cells
  std::size_t columns = 0, texts = 0;
  bool commas = false, points = false;         // in cells that are numbers
  bool first_empty = true, last_empty = true;  // in every row
};

Fit fit_of(std::string_view rows_text, const TableSyntax& syntax) {
  TextCursor text(rows_text);
  TableRows rows(text, syntax);
  Fit fit;
  TableCell cell;
  for (std::size_t n = 0; n < kMostTellingRows && rows.next_row(); ++n) {
    std::size_t columns = 0;
    for (; rows.take_cell(cell); ++columns) {
      fit.texts += cell.kind == CellKind::kText;
      if (cell.kind == CellKind::kNumber) {
        fit.commas = fit.commas || cell.text.find(',') != std::string_view::npos;
        fit.points = fit.points || cell.text.find('.') != std::string_view::npos;
      }
      if (columns == 0 && !cell.text.empty()) fit.first_empty = false;
    }
    if (!cell.text.empty()) fit.last_empty = false;
    rows.end_row();
    if (n == 0) fit.columns = columns;
    fit.same = fit.same && columns == fit.columns;
    if (!fit.same && n > 0) break;
  }
  return fit;
}

struct Candidate {
  TableSyntax syntax;
  Fit fit;
};

std::vector<Candidate> candidates_of(std::string_view rows_text) {
  const std::size_t line_end = rows_text.find_first_of("\r\n");
  const std::string_view first = rows_text.substr(0, line_end);
  const auto in_first = [&](char c) { return first.find(c) != std::string_view::npos; };
  std::vector<Candidate> all;
  const auto add = [&](TableSyntax syntax) {
    Fit fit = fit_of(rows_text, syntax);
    if (syntax.separator != ' ' && fit.same && fit.last_empty && fit.columns > 1) {
      syntax.open_end = true;
      --fit.columns;
    }
    syntax.columns = fit.columns;
    all.push_back({syntax, fit});
  };
  if (in_first(';')) add({.separator = ';', .decimal_comma = true});
  if (in_first('\t')) add({.separator = '\t', .decimal_comma = true});
  if (rows_text.find(',') != std::string_view::npos) {
    add({.separator = ' ', .decimal_comma = true});
    // Commas are decimal in rows of three words without points (0,5 0,25 1), else separators.
    const Fit& fit = all.back().fit;
    if (!fit.commas || fit.points || fit.columns < 3) all.pop_back();
  }
  if (in_first(',')) add({.separator = ','});
  add({.separator = ' '});
  return all;
}

Candidate choose_syntax(std::string_view rows_text) {
  const std::vector<Candidate> all = candidates_of(rows_text);
  for (const bool texts : {false, true}) {
    for (const Candidate& c : all) {
      const bool leading = c.syntax.separator == '\t' && c.fit.first_empty;
      if (c.fit.same && c.fit.columns >= 3 && !leading && (texts || c.fit.texts == 0)) {
        return c;
      }
    }
  }
  for (const Candidate& c : all) {  // a row is wrong, which the reader will report
    if (c.fit.columns >= 3 && c.fit.texts == 0) return c;
  }
  return all.back();
}

// ---- Names ----

bool counts_up(const TellingRows& telling, std::size_t column) {
  const std::vector<double>& values = telling.columns[column];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != values[0] + static_cast<double>(i) || values[i] != std::floor(values[i]))
      return false;
  }
  return !values.empty();
}

// Returns the names in a line if they fit n columns. A table that R writes has no name for its
// column of row numbers.
std::optional<std::vector<std::string>> names_that_fit(std::string_view line, char separator,
                                                       const TellingRows& telling) {
  const std::size_t n = telling.columns.size();
  std::vector<std::string> names = split_names(line, separator);
  if (names.size() == n + 1 && names.back().empty()) names.pop_back();
  if (names.size() == n + 1 && names.front().ends_with(':')) names.erase(names.begin());
  if (names.size() + 1 == n && has_position(names) &&
      (counts_up(telling, 0) || telling.texts[0] == telling.rows)) {
    names.insert(names.begin(), "");
  }
  if (names.size() != n) return std::nullopt;
  return names;
}

void take_names(const std::vector<NameLine>& lines, const TellingRows& telling,
                TableHeader& header) {
  std::optional<std::vector<std::string>> others;  // names without a position
  const NameLine* unfit = nullptr;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    std::vector<char> separators(kSeparators.begin(), kSeparators.end());
    std::stable_partition(separators.begin(), separators.end(),
                          [&](char s) { return s == header.syntax.separator; });
    for (const char separator : separators) {
      auto names = names_that_fit(line->text, separator, telling);
      if (!names) continue;
      if (has_position(*names)) {
        header.names = *std::move(names);
        return;
      }
      if (!line->is_comment && !others) others = std::move(names);
    }
    if (unfit == nullptr && names_position(line->text)) unfit = &*line;
  }
  if (unfit != nullptr && !others) {
    header.unfit_names = std::string(unfit->text);
    for (const char separator : kSeparators) {
      const std::vector<std::string> names = split_names(unfit->text, separator);
      if (header.unfit == 0 && has_position(names)) header.unfit = names.size();
    }
    if (unfit->is_comment) {
      header.remarks.push_back("the comment " + in_quotes(trimmed(unfit->text)) +
                               " names other than " + std::to_string(telling.columns.size()) +
                               " columns and is not used");
      header.unfit_names.clear();
    }
  } else if (others) {
    header.names = *std::move(others);
  } else {
    for (const NameLine& line : lines) {
      if (line.is_comment) continue;
      header.remarks.push_back("the line " + in_quotes(trimmed(line.text)) + " is passed over");
      break;
    }
  }
}

// Returns true if the first row only numbers the columns, 0 1 2 ..., as pandas does for columns
// without names: beside an empty cell, or above rows with decimals.
bool numbers_columns(std::string_view rows_text, const TableSyntax& syntax) {
  if (syntax.separator == ' ') return false;  // a point may be 0 1 2
  TextCursor text(rows_text);
  TableRows rows(text, syntax);
  TableCell cell;
  if (!rows.next_row()) return false;
  std::size_t number = 0;
  bool has_empty = false;
  for (std::size_t k = 0; rows.take_cell(cell); ++k) {
    if (k == 0 && cell.text.empty()) {
      has_empty = true;
    } else if (cell.text != std::to_string(number++)) {
      return false;
    }
  }
  if (number < 3) return false;
  rows.end_row();
  std::size_t others = 0;
  for (; others < kMostTellingRows && rows.next_row(); ++others) {
    bool whole = true;
    while (rows.take_cell(cell)) {
      whole = whole && cell.kind == CellKind::kNumber && cell.value == std::floor(cell.value) &&
              cell.text.find_first_of(".,") == std::string_view::npos;
    }
    rows.end_row();
    if (whole && !has_empty) return false;
  }
  return others > 0;
}

}  // namespace

TableHeader look_at_table(std::span<const char> begin, bool is_all) {
  const std::span<const char> lines = whole_lines(begin, is_all);
  TextCursor text(lines);
  TableHeader header;
  const std::vector<NameLine> before = take_lines_before(text, header);
  const auto rest = [&] {
    return std::string_view(text.at, static_cast<std::size_t>(text.end - text.at));
  };
  header.rows_at = static_cast<std::size_t>(text.at - text.begin);
  if (text.at_end()) return header;
  if (!look_at_line(rest().substr(0, rest().find_first_of("\r\n"))).is_row()) return header;
  Candidate chosen = choose_syntax(rest());
  header.syntax = chosen.syntax;
  if (numbers_columns(rest(), header.syntax)) {
    skip_to_line_end(text);
    skip_spaces(text);
    header.rows_at = static_cast<std::size_t>(text.at - text.begin);
    chosen = choose_syntax(rest());
    header.syntax = chosen.syntax;
    header.remarks.emplace_back("the first line numbers the columns");
  }
  if (chosen.fit.commas) header.remarks.emplace_back("decimal commas");
  take_names(before, telling_rows(begin, is_all, header), header);
  return header;
}

TellingRows telling_rows(std::span<const char> begin, bool is_all, const TableHeader& header) {
  const std::span<const char> lines = whole_lines(begin, is_all);
  TextCursor text(lines.subspan(std::min(header.rows_at, lines.size())));
  TableRows rows(text, header.syntax);
  const std::size_t n = header.syntax.columns;
  TellingRows telling{.columns = std::vector<std::vector<double>>(n),
                      .texts = std::vector<std::size_t>(n)};
  std::vector<TableCell> row;
  while (telling.rows < kMostTellingRows && telling.rows * n < kMostTellingValues &&
         rows.next_row()) {
    row.clear();
    for (TableCell cell; rows.take_cell(cell);) row.push_back(cell);
    rows.end_row();
    if (row.size() != n) continue;
    for (std::size_t k = 0; k < n; ++k) {
      telling.columns[k].push_back(row[k].value);
      telling.texts[k] += row[k].kind == CellKind::kText;
    }
    ++telling.rows;
  }
  return telling;
}

}  // namespace rholm
