#include "model/batch/row_bytes.h"

#include <bit>

namespace rholm {
namespace {

template <class Number>
void put(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>((value >> (8 * i)) & 0xff);
  }
}

template <class Number>
Number get(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return static_cast<Number>(value);
}

void put_text(std::string& bytes, std::string_view text) {
  put_u32(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

// Appends the bytes that follow the index of the kind in Cell.
struct CellBytes {
  std::string& bytes;
  void operator()(std::monostate) const {}
  void operator()(bool value) const { bytes += value ? '\1' : '\0'; }
  void operator()(std::int64_t value) const { put_u64(bytes, std::bit_cast<std::uint64_t>(value)); }
  void operator()(double value) const { put_u64(bytes, std::bit_cast<std::uint64_t>(value)); }
  void operator()(const std::string& value) const { put_text(bytes, value); }
  void operator()(const std::vector<double>& values) const {
    put_u32(bytes, static_cast<std::uint32_t>(values.size()));
    for (const double value : values) (*this)(value);
  }
};

// Every step returns false if bytes are missing; memory is limited by the size of the bytes.
class RowReader {
 public:
  explicit RowReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<BatchRow> row() {
    std::uint32_t count = 0;
    if (!number(count)) return std::nullopt;
    BatchRow cells;
    for (std::uint32_t i = 0; i < count; ++i) {
      std::pair<std::string, Cell>& one = cells.emplace_back();
      if (!text(one.first) || !cell(one.second)) return std::nullopt;
    }
    return rest_.empty() ? std::optional(std::move(cells)) : std::nullopt;
  }

 private:
  template <class Number>
  bool number(Number& value) {
    if (rest_.size() < sizeof(Number)) return false;
    value = get<Number>(rest_);
    rest_.remove_prefix(sizeof(Number));
    return true;
  }

  bool real(double& value) {
    std::uint64_t bits = 0;
    if (!number(bits)) return false;
    value = std::bit_cast<double>(bits);
    return true;
  }

  bool text(std::string& value) {
    std::uint32_t size = 0;
    if (!number(size) || rest_.size() < size) return false;
    value = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }

  bool list(std::vector<double>& values) {
    std::uint32_t size = 0;
    if (!number(size) || rest_.size() / sizeof(double) < size) return false;
    values.resize(size);
    for (double& value : values) {
      if (!real(value)) return false;
    }
    return true;
  }

  bool cell(Cell& value) {
    std::uint8_t kind = 0;
    if (!number(kind)) return false;
    switch (kind) {
      case 0:
        return true;
      case 1: {
        std::uint8_t bit = 0;
        if (!number(bit) || bit > 1) return false;
        value = bit == 1;
        return true;
      }
      case 2: {
        std::uint64_t bits = 0;
        if (!number(bits)) return false;
        value = std::bit_cast<std::int64_t>(bits);
        return true;
      }
      case 3:
        return real(value.emplace<double>());
      case 4:
        return text(value.emplace<std::string>());
      case 5:
        return list(value.emplace<std::vector<double>>());
      default:
        return false;
    }
  }

  std::string_view rest_;
};

}  // namespace

void put_u32(std::string& bytes, std::uint32_t value) { put(bytes, value); }
void put_u64(std::string& bytes, std::uint64_t value) { put(bytes, value); }
std::uint32_t get_u32(std::string_view bytes) { return get<std::uint32_t>(bytes); }
std::uint64_t get_u64(std::string_view bytes) { return get<std::uint64_t>(bytes); }

std::string row_bytes(const BatchRow& cells) {
  std::string bytes;
  put_u32(bytes, static_cast<std::uint32_t>(cells.size()));
  for (const auto& [name, cell] : cells) {
    put_text(bytes, name);
    bytes += static_cast<char>(cell.index());
    std::visit(CellBytes{bytes}, cell);
  }
  return bytes;
}

std::optional<BatchRow> parse_row(std::string_view bytes) { return RowReader(bytes).row(); }

}  // namespace rholm
