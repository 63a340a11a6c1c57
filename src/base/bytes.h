// Numbers as bytes for other processes of a program, in the machine's own byte order. Layer: base.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rholm/error.h"

namespace rholm {

class ByteWriter {
 public:
  template <typename T>
  ByteWriter& value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    return append(&v, sizeof v);
  }
  ByteWriter& number(std::uint64_t n) { return value(n); }
  // Writes the number of values before the values.
  template <typename T>
  ByteWriter& array(std::span<const T> values) {
    return number(values.size()).row(values);
  }
  ByteWriter& text(std::string_view characters) { return array(std::span(characters)); }
  ByteWriter& texts(const std::vector<std::string>& all) {
    number(all.size());
    for (const std::string& one : all) text(one);
    return *this;
  }
  template <typename T>
  ByteWriter& row(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return append(values.data(), values.size_bytes());
  }
  std::string take() { return std::move(bytes_); }

 private:
  ByteWriter& append(const void* data, std::size_t n) {
    if (n > 0) bytes_.append(static_cast<const char*>(data), n);
    return *this;
  }
  std::string bytes_;
};

// Reads what a ByteWriter wrote, in the same order; throws Io where the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  template <typename T>
  void value(T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&v, take(sizeof v), sizeof v);
  }
  template <typename T>
  void array(std::vector<T>& values) {
    const std::uint64_t n = number();
    if (n > bytes_.size() / sizeof(T)) refuse();
    values.resize(n);
    row(std::span<T>(values));
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    value(n);
    return n;
  }
  // Returns a view that is valid as long as the bytes given to the constructor.
  std::string_view text() {
    const std::uint64_t n = number();
    return {take(n), n};
  }
  std::vector<std::string> texts() {
    std::vector<std::string> all;
    for (std::uint64_t n = number(); n > 0; --n) all.emplace_back(text());
    return all;
  }
  template <typename T>
  void row(std::span<T> values) {
    const char* from = take(values.size_bytes());
    if (!values.empty()) std::memcpy(values.data(), from, values.size_bytes());
  }
  std::string_view rest() const { return bytes_; }
  // Throws Io if unread bytes are left.
  void finish() const {
    if (!bytes_.empty()) refuse();
  }
  [[noreturn]] static void refuse() {
    throw Error(ErrorCode::kIo, "what another process sent is damaged");
  }

 private:
  const char* take(std::size_t n) {
    if (n > bytes_.size()) refuse();
    const char* at = bytes_.data();
    bytes_ = bytes_.substr(n);
    return at;
  }
  std::string_view bytes_;
};

// Writes numbers in rows of `row` numbers. A row of zeros takes only one byte.
template <typename T, typename IsZero>
void write_sparse(ByteWriter& writer, std::span<const T> all, std::size_t row,
                  const IsZero& is_zero) {
  writer.value(std::uint64_t{all.size()});
  for (std::size_t first = 0; first < all.size(); first += row) {
    const auto part = all.subspan(first, std::min(row, all.size() - first));
    const bool is_empty = std::all_of(part.begin(), part.end(), is_zero);
    writer.value(static_cast<std::uint8_t>(is_empty ? 0 : 1));
    if (!is_empty) writer.row(part);
  }
}
// Calls take(first, part) for each row with values. Throws Io unless `n` numbers were written.
template <typename T, typename Take>
void read_sparse(ByteReader& reader, std::size_t n, std::size_t row, const Take& take) {
  std::uint64_t written = 0;
  reader.value(written);
  if (written != n) ByteReader::refuse();
  std::vector<T> room(row);
  for (std::size_t first = 0; first < n; first += row) {
    std::uint8_t has_any = 0;
    reader.value(has_any);
    if (has_any == 0) continue;
    const auto part = std::span(room).first(std::min(row, n - first));
    reader.row(part);
    take(first, std::span<const T>(part));
  }
}

}  // namespace rholm
