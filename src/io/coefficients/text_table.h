// Coefficients as lines of text `l m C S`: what SHTOOLS and ICGEM files share. Layer: io, private.
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

// A line of a text, for messages "NAME: line 12: ...": `text` stands at its beginning.
struct TextLine {
  std::string_view content = {};  // without its line end
  bool complete = false;          // it has a line end
  TextCursor text{{}};
  const std::string* name = nullptr;
};
TextLine take_line(TextCursor& text, const std::string& name);
[[noreturn]] void refuse_line(const TextLine& line, const std::string& what);

std::string_view trimmed(std::string_view text);
// The fields between blanks, tabs and commas, as pyshtools separates them.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

// Calls visit(line, fields) for all lines that are left but empty ones; returns whether the last of
// all is complete.
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

// A number in the range of double precision, or none; Fortran's exponent letter D is accepted.
std::optional<double> number_of(std::string_view text);
// A finite number. `what` names it in the message.
double parse_finite(std::string_view text, const char* what, const TextLine& line);
// A whole number from 0 to `limit`.
int parse_count(std::string_view text, const char* what, int limit, const TextLine& line);

// Number of pairs (l, m) with 0 <= m <= l <= degree.
constexpr std::size_t n_pairs(int degree) {
  return (degree + std::size_t{1}) * (degree + std::size_t{2}) / 2;
}

// Collects lines `l m C S`, in any order, each pair once.
class CoefficientTable {
 public:
  // Fields l, m, C, S, and any further numbers (standard deviations), which are only checked;
  // S may be missing for m = 0.
  void add(std::span<const std::string_view> fields, const TextLine& line);
  std::size_t size() const { return entries_.size(); }
  // Pairs without a line are zero, up to `stated_degree` if there is one.
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

// What text files say beside the numbers, as keys and values in the order of writing: function,
// center, unit, method, numbers of kKnownNumbers, signed_sum. What an expansion does not know is
// left out.
std::vector<std::pair<std::string, std::string>> describe(const Expansion& expansion);
// The inverse, one key at a time, and csphase. False if the key is none of these. Throws
// InvalidInput for a value that cannot be, or a key given twice.
bool take_description(std::string_view key, std::string_view value, const TextLine& line,
                      ParsedCoefficients& parsed);

// Appends "l m C S\n", numbers with the shortest digits that read back the same.
void append_pair(std::string& text, int l, int m, const Coefficients& external);

// "number of lines" as a file written here says it, to show that it is whole. Throws
// InvalidInput if the file has another number or, saying one, does not end with a line end: then
// it may be cut within its last number.
void check_line_count(std::optional<int> stated, const CoefficientTable& table,
                      bool last_line_complete, const std::string& name);

// For values that may be given once. Throws InvalidInput if `slot` is taken.
template <typename Value>
void set_once(std::optional<Value>& slot, Value value, std::string_view key, const TextLine& line) {
  if (slot) refuse_line(line, "the key " + in_quotes(key) + " is given twice: delete one");
  slot = std::move(value);
}

}  // namespace rholm
