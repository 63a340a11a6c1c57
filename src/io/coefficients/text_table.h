// Coefficients as lines of text `l m C S`, for SHTOOLS and ICGEM files. Layer: io, private.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/plain_text.h"
#include "io/coefficients/codec.h"
#include "io/file/number_text.h"

namespace rholm {

// A line of a text, for messages "NAME: line 12: ..."; `text` points to its beginning.
struct TextLine {
  std::string_view content = {};  // without its line end
  bool complete = false;          // true if it has a line end
  TextCursor text{{}};
  const std::string* name = nullptr;
};
TextLine take_line(TextCursor& text, const std::string& name);
[[noreturn]] void refuse_line(const TextLine& line, const std::string& what);

std::string_view trimmed(std::string_view text);
// Splits a line into its fields between blanks, tabs and commas, as pyshtools does.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

// Calls visit(line, fields) for all following lines that are not empty. Returns true if the last
// line is complete.
template <typename Visit>
bool visit_lines(TextCursor& text, const std::string& name, const Visit& visit) {
  std::vector<std::string_view> fields;
  bool last_complete = false;
  CancelPoll poll;
  while (!text.at_end()) {
    poll();
    const TextLine line = take_line(text, name);
    last_complete = line.complete;
    split_fields(line.content, fields);
    if (!fields.empty()) visit(line, std::span<const std::string_view>(fields));
  }
  return last_complete;
}

// Returns a number in the range of double precision, or none. Accepts Fortran's exponent letter D.
std::optional<double> number_of(std::string_view text);
// Returns a finite number, which messages call `what`.
double parse_finite(std::string_view text, const char* what, const TextLine& line);
// Returns a whole number from 0 to `limit`.
int parse_count(std::string_view text, const char* what, int limit, const TextLine& line);

// Returns the number of pairs (l, m) with 0 <= m <= l <= degree.
constexpr std::size_t n_pairs(int degree) {
  return (degree + std::size_t{1}) * (degree + std::size_t{2}) / 2;
}

// Collects lines `l m C S` in any order, each pair once.
class CoefficientTable {
 public:
  // Takes the fields l, m, C, S, and any further numbers (standard deviations), which are checked
  // and ignored. S may be missing for m = 0.
  void add(std::span<const std::string_view> fields, const TextLine& line);
  std::size_t size() const { return entries_.size(); }
  // Sets pairs without a line to zero, up to `stated_degree` if it is given.
  Coefficients assemble(std::optional<int> stated_degree, const std::string& name) const;

 private:
  struct Entry {
    std::uint16_t l;
    std::uint16_t m;
    double c;
    double s;
  };
  static_assert(kMaxDegree <= UINT16_MAX);
  std::vector<Entry> entries_;
  int max_degree_ = -1;
};

// Returns the description of an expansion for text files, as keys and values in the order of
// writing. The keys are function, center, unit, method, numbers of kKnownNumbers and signed_sum.
// Unknown values are left out.
std::vector<std::pair<std::string, std::string>> describe(const Expansion& expansion);
// Does the inverse for one key, which may also be csphase. Returns false for any other key. Throws
// InvalidInput for an impossible value or a repeated key.
bool take_description(std::string_view key, std::string_view value, const TextLine& line,
                      ParsedCoefficients& parsed);

// Appends "l m C S\n", with the shortest digits that read back as the same numbers.
void append_pair(std::string& text, int l, int m, const Coefficients& external);

// Checks the "number of lines" that files of rholm state. Throws InvalidInput if it differs. Also
// throws if a file with this statement does not end with a line end, because it may be cut off
// within its last number.
void check_line_count(std::optional<int> stated, const CoefficientTable& table,
                      bool last_line_complete, const std::string& name);

// Sets a value that may be given once; throws InvalidInput if `slot` already has a value.
template <typename Value>
void set_once(std::optional<Value>& slot, Value value, std::string_view key, const TextLine& line) {
  if (slot) refuse_line(line, "the key " + in_quotes(key) + " is given twice: delete one");
  slot = std::move(value);
}

}  // namespace rholm
