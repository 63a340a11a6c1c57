// Output in large blocks, to a file or to memory. Layer: io.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/file/number_text.h"
#include "rholm/context.h"

namespace rholm {

class OutputBuffer {
 public:
  // Without a file, all output stays in memory for take(). `rows` is the total of the later calls
  // of rows(): each flush reports stage "write", or throws Cancelled.
  explicit OutputBuffer(AtomicFile* file, std::size_t rows = 0, const Context& context = {});

  // Returns room for at least n bytes; the caller then calls advance(end).
  char* room(std::size_t n) {
    if (bytes_.size() - used_ < n) make_room(n);
    return bytes_.data() + used_;
  }
  void advance(const char* end) { used_ = static_cast<std::size_t>(end - bytes_.data()); }

  void text(std::string_view text) {
    char* to = room(text.size());
    advance(std::copy(text.begin(), text.end(), to));
  }
  template <class Number>
  void number(Number value) {
    advance(format_number(room(kMaxNumberLength), value));
  }
  // Writes a number and the character after it.
  template <class Number>
  void number(Number value, char separator) {
    char* end = format_number(room(kMaxNumberLength + 1), value);
    *end = separator;
    advance(end + 1);
  }
  void rows(std::size_t n) { rows_done_ += n; }

  void flush();
  std::vector<char> take();

 private:
  void make_room(std::size_t n);

  AtomicFile* file_;
  Context context_;
  std::size_t rows_;
  std::size_t rows_done_ = 0;
  std::vector<char> bytes_;
  std::size_t used_ = 0;
};

}  // namespace rholm
