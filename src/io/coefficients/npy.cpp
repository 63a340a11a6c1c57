// NumPy's array file: magic, version, length of the header, the header (a Python dictionary
// literal) and the numbers. Source: numpy.lib.format, versions 1.0 to 3.0.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

#include "base/cancel.h"
#include "io/coefficients/codec.h"
#include "io/file/number_text.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;  // NumPy's alignment of the numbers, for memory maps

[[noreturn]] void refuse(const std::string& name, const std::string& what,
                         ErrorCode code = ErrorCode::kInvalidInput) {
  throw Error(code, name + ": " + what);
}

struct Header {
  std::string descr;
  std::optional<bool> fortran_order;
  std::vector<std::size_t> shape;
};

// Parses the dictionary as NumPy writes it. Keys are strings; values are strings, True or False, or
// tuples of whole numbers. Other Python syntax is rejected.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Header parse() {
    expect('{');
    while (!accept('}')) {
      const std::string key = take_string();
      expect(':');
      take_value(key);
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    skip_spaces(text_);
    if (!text_.at_end()) fail();
    if (header_.descr.empty() || !header_.fortran_order || !has_shape_) {
      refuse(name_, "the NumPy header lacks descr, fortran_order or shape");
    }
    return header_;
  }

 private:
  [[noreturn]] void fail() const {
    refuse(name_,
           fmt::format("the NumPy header is malformed at its byte {}", text_.at - text_.begin));
  }
  bool accept(char c) {
    skip_spaces(text_);
    if (text_.at_end() || *text_.at != c) return false;
    ++text_.at;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail();
  }
  std::string take_string() {
    const char quote = accept('\'') ? '\'' : '"';
    if (quote == '"') expect('"');
    std::string value;
    while (!text_.at_end() && *text_.at != quote) {
      if (*text_.at == '\\' || *text_.at == '\n') fail();
      value += *text_.at++;
    }
    expect(quote);
    return value;
  }
  bool take_flag() {
    for (const auto& [word, value] : {std::pair{"True", true}, std::pair{"False", false}}) {
      const std::string_view rest(text_.at, static_cast<std::size_t>(text_.end - text_.at));
      if (rest.starts_with(word)) {
        text_.at += std::strlen(word);
        return value;
      }
    }
    fail();
  }
  void take_shape() {
    expect('(');
    while (!accept(')')) {
      skip_spaces(text_);
      std::size_t extent = 0;
      if (header_.shape.size() == 32 || !take_integer(text_, extent)) fail();  // NumPy's limit
      header_.shape.push_back(extent);
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    has_shape_ = true;
  }
  void take_value(const std::string& key) {
    skip_spaces(text_);
    if (key == "descr" && header_.descr.empty()) {
      if (!text_.at_end() && *text_.at == '[') {
        refuse(name_, "the array has named fields: save a plain array of shape (2, L+1, L+1)",
               ErrorCode::kUnsupported);
      }
      header_.descr = take_string();
    } else if (key == "fortran_order" && !header_.fortran_order) {
      header_.fortran_order = take_flag();
    } else if (key == "shape" && !has_shape_) {
      take_shape();
    } else {
      fail();
    }
  }

  TextCursor text_;
  const std::string& name_;
  Header header_;
  bool has_shape_ = false;
};

template <typename Unsigned>
Unsigned load(const char* bytes, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    const std::size_t place = big_endian ? sizeof(Unsigned) - 1 - i : i;
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * place);
  }
  return static_cast<Unsigned>(value);
}

// Returns the text of the header and removes it, with the bytes before it, from `bytes`.
std::string_view take_header(std::string_view& bytes, const std::string& name) {
  const auto need = [&](std::size_t size) {
    if (bytes.size() < size) refuse(name, "the file ends within the NumPy header");
  };
  need(kMagic.size() + 2);
  const int version = static_cast<unsigned char>(bytes[kMagic.size()]);
  if (version < 1 || version > 3) {
    refuse(name, fmt::format("NumPy format version {}: 1 to 3 are read", version),
           ErrorCode::kUnsupported);
  }
  bytes.remove_prefix(kMagic.size() + 2);
  const std::size_t field = version == 1 ? 2 : 4;
  need(field);
  const std::size_t length = version == 1 ? load<std::uint16_t>(bytes.data(), false)
                                          : load<std::uint32_t>(bytes.data(), false);
  bytes.remove_prefix(field);
  need(length);
  const std::string_view header = bytes.substr(0, length);
  bytes.remove_prefix(length);
  return header;
}

// Size and byte order of a number, from `descr`.
struct NumberLayout {
  std::size_t size = 8;
  bool big_endian = false;

  double load_number(const char* bytes) const {
    if (size == 4) return std::bit_cast<float>(load<std::uint32_t>(bytes, big_endian));
    return std::bit_cast<double>(load<std::uint64_t>(bytes, big_endian));
  }
};

NumberLayout parse_descr(const std::string& descr, const std::string& name) {
  for (const std::size_t size : {8, 4}) {
    for (const bool big_endian : {false, true}) {
      if (descr == fmt::format("{}f{}", big_endian ? '>' : '<', size)) return {size, big_endian};
    }
  }
  // The header may hold any bytes: the message shows only printable ASCII.
  std::string shown = descr.substr(0, 16);
  for (char& c : shown) c = c < 0x20 || c > 0x7e ? '?' : c;
  refuse(name,
         "the array's type is '" + shown +
             "': save real numbers, float64 or float32, of shape "
             "(2, L+1, L+1)",
         ErrorCode::kUnsupported);
}

// Returns L for the shape (2, L+1, L+1).
int degree_of(const std::vector<std::size_t>& shape, const std::string& name) {
  const bool fits = shape.size() == 3 && shape[0] == 2 && shape[1] == shape[2] && shape[1] >= 1;
  if (!fits || shape[1] > kMaxDegree + std::size_t{1}) {
    refuse(name, fmt::format("the array's shape is ({}): it must be (2, L+1, L+1), L from 0 to {}",
                             fmt::join(shape, ", "), kMaxDegree));
  }
  return static_cast<int>(shape[1]) - 1;
}

}  // namespace

bool looks_like_npy(std::string_view bytes) { return bytes.starts_with(kMagic); }

ParsedCoefficients parse_npy(std::string_view bytes, const std::string& name) {
  const Header header = HeaderParser(take_header(bytes, name), name).parse();
  const NumberLayout layout = parse_descr(header.descr, name);
  const int degree = degree_of(header.shape, name);
  const std::size_t side = degree + std::size_t{1};
  if (bytes.size() != 2 * side * side * layout.size) {
    refuse(name, fmt::format("it has {} bytes of numbers, the shape (2, {}, {}) needs {}",
                             bytes.size(), side, side, 2 * side * side * layout.size));
  }
  ParsedCoefficients parsed;
  parsed.external = Coefficients(degree);
  const std::span<double> values = parsed.external.values();
  std::size_t to = 0;
  CancelPoll poll;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    for (std::size_t l = 0; l < side; ++l) {
      for (std::size_t m = 0; m < side; ++m) {
        poll();
        const std::size_t from = *header.fortran_order ? plane + 2 * (l + side * m) : to;
        values[to++] = layout.load_number(bytes.data() + from * layout.size);
      }
    }
  }
  return parsed;
}

std::string format_npy(const Expansion&, const Coefficients& external, const Convention&) {
  const int side = external.degree() + 1;
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': (2, {}, {}), }}", side, side);
  const std::size_t before = kMagic.size() + 4;  // magic, version, length
  const std::size_t unpadded = before + header.size() + 1;
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
            static_cast<char>(header.size() >> 8)};
  bytes += header;
  bytes.reserve(bytes.size() + 8 * external.values().size());
  CancelPoll poll;
  for (const double value : external.values()) {
    poll();
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift);
  }
  return bytes;
}

}  // namespace rholm
