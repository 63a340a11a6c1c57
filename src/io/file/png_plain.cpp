// PNG without a library. Rows are differences to their left or upper neighbours, compressed by
// repetitions and the fixed codes of RFC 1951.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>

#include "base/crc32.h"
#include "io/file/png_encoder.h"

namespace rholm {
namespace {

void append_big_endian(std::vector<char>& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

// Appends length, name, data, and a checksum of name and data.
void append_chunk(std::vector<char>& png, std::string_view name, std::string_view data) {
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  png.insert(png.end(), name.begin(), name.end());
  png.insert(png.end(), data.begin(), data.end());
  append_big_endian(png, crc32(data, crc32(name)));
}

// --- Filters -------------------------------------------------------------------------------

// PNG's numbers of the filters; Average and Paeth are not used.
enum class Filter : std::uint8_t { kNone, kSub, kUp };

std::uint8_t filtered(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                      std::size_t i, Filter filter) {
  constexpr std::size_t kPixel = 3;
  int before = 0;
  if (filter == Filter::kSub && i >= kPixel) before = row[i - kPixel];
  if (filter == Filter::kUp && !above.empty()) before = above[i];
  return static_cast<std::uint8_t>(row[i] - before);
}

// Returns the sum of the absolute signed differences. libpng chooses the filter in the same way.
std::size_t cost(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                 Filter filter) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    sum += static_cast<std::size_t>(
        std::abs(static_cast<std::int8_t>(filtered(row, above, i, filter))));
  }
  return sum;
}

// Returns the filtered rows, each after the number of its filter.
std::vector<std::uint8_t> filtered_rows(const Image& image) {
  const std::size_t length = 3 * static_cast<std::size_t>(image.width);
  const auto rows = static_cast<std::size_t>(image.height);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(rows * (length + 1));
  std::span<const std::uint8_t> above;
  for (std::size_t y = 0; y < rows; ++y) {
    const std::span<const std::uint8_t> row(image.rgb.data() + y * length, length);
    Filter best = Filter::kNone;
    std::size_t least = cost(row, above, best);
    for (const Filter filter : {Filter::kSub, Filter::kUp}) {
      const std::size_t sum = cost(row, above, filter);
      if (sum < least) best = filter, least = sum;
    }
    bytes.push_back(static_cast<std::uint8_t>(best));
    for (std::size_t i = 0; i < length; ++i) bytes.push_back(filtered(row, above, i, best));
    above = row;
  }
  return bytes;
}

// --- Compression (RFC 1950, RFC 1951) -------------------------------------------------------

class BitWriter {
 public:
  explicit BitWriter(std::vector<char>& bytes) : bytes_(bytes) {}
  // Writes n bits, the lowest bit first.
  void put(std::uint32_t value, unsigned n) {
    bits_ |= static_cast<std::uint64_t>(value) << n_bits_;
    for (n_bits_ += n; n_bits_ >= 8; n_bits_ -= 8, bits_ >>= 8) {
      bytes_.push_back(static_cast<char>(bits_ & 0xff));
    }
  }
  // Writes a Huffman code, the highest bit first.
  void put_code(std::uint32_t code, unsigned n) {
    std::uint32_t reversed = 0;
    for (unsigned i = 0; i < n; ++i) reversed |= (code >> i & 1) << (n - 1 - i);
    put(reversed, n);
  }
  void fill_byte() {
    if (n_bits_ > 0) put(0, 8 - n_bits_);
  }

 private:
  std::vector<char>& bytes_;
  std::uint64_t bits_ = 0;
  unsigned n_bits_ = 0;
};

// Section 3.2.6: writes a byte, the end of a block (256) or a length symbol.
void put_symbol(BitWriter& out, std::uint32_t symbol) {
  if (symbol < 144) return out.put_code(0x30 + symbol, 8);
  if (symbol < 256) return out.put_code(0x190 + symbol - 144, 9);
  if (symbol < 280) return out.put_code(symbol - 256, 7);
  out.put_code(0xc0 + symbol - 280, 8);
}

struct Range {
  std::uint32_t base = 0;
  unsigned extra_bits = 0;
};

// Section 3.2.5: symbols 257 to 285 and codes 0 to 29 each stand for a range of values. Lengths
// double the size of a range every four codes, distances every two.
constexpr std::array<Range, 29> length_ranges() {
  std::array<Range, 29> ranges = {};
  std::uint32_t base = 3;
  for (std::size_t i = 0; i < 28; ++i) {
    ranges[i] = {base, i < 8 ? 0U : static_cast<unsigned>(i / 4 - 1)};
    base += 1U << ranges[i].extra_bits;
  }
  ranges[28] = {258, 0};
  return ranges;
}
constexpr std::array<Range, 30> distance_ranges() {
  std::array<Range, 30> ranges = {};
  std::uint32_t base = 1;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] = {base, i < 4 ? 0U : static_cast<unsigned>(i / 2 - 1)};
    base += 1U << ranges[i].extra_bits;
  }
  return ranges;
}
constexpr std::array<Range, 29> kLengths = length_ranges();
constexpr std::array<Range, 30> kDistances = distance_ranges();

template <std::size_t kSize>
std::uint32_t range_of(const std::array<Range, kSize>& ranges, std::uint32_t value) {
  const auto above =
      std::upper_bound(ranges.begin(), ranges.end(), value,
                       [](std::uint32_t v, const Range& range) { return v < range.base; });
  return static_cast<std::uint32_t>(above - ranges.begin() - 1);
}

void put_repetition(BitWriter& out, std::uint32_t length, std::uint32_t distance) {
  const std::uint32_t l = range_of(kLengths, length), d = range_of(kDistances, distance);
  put_symbol(out, 257 + l);
  out.put(length - kLengths[l].base, kLengths[l].extra_bits);
  out.put_code(d, 5);
  out.put(distance - kDistances[d].base, kDistances[d].extra_bits);
}

// Returns the number of bytes from `at` on that equal the bytes from `earlier` on.
std::uint32_t common_length(std::span<const std::uint8_t> data, std::size_t earlier,
                            std::size_t at) {
  constexpr std::size_t kLongest = 258;
  const std::size_t most = std::min(kLongest, data.size() - at);
  std::size_t n = 0;
  while (n < most && data[earlier + n] == data[at + n]) ++n;
  return static_cast<std::uint32_t>(n);
}

// Writes one block. A table has the last position of each hash of four bytes.
void deflate(std::span<const std::uint8_t> data, std::vector<char>& compressed) {
  constexpr std::size_t kLeast = 4, kFarthest = 32768;
  constexpr unsigned kHashBits = 15;  // chosen: as many entries as a distance reaches
  std::vector<std::size_t> last(std::size_t{1} << kHashBits, data.size());
  BitWriter out(compressed);
  out.put(1, 1);  // the last block
  out.put(1, 2);  // fixed codes
  for (std::size_t at = 0; at < data.size();) {
    std::uint32_t length = 0;
    std::size_t distance = 0;
    if (data.size() - at >= kLeast) {
      std::uint32_t word;
      std::memcpy(&word, &data[at], sizeof word);
      std::size_t& slot = last[word * 2654435761U >> (32 - kHashBits)];  // 2^32 / golden ratio
      if (slot < at && at - slot <= kFarthest) {
        length = common_length(data, slot, at);
        distance = at - slot;
      }
      slot = at;
    }
    if (length >= kLeast) {
      put_repetition(out, length, static_cast<std::uint32_t>(distance));
      at += length;
    } else {
      put_symbol(out, data[at]);
      ++at;
    }
  }
  put_symbol(out, 256);
  out.fill_byte();
}

std::uint32_t adler32(std::span<const std::uint8_t> data) {
  constexpr std::size_t kBetween = 5552;  // 5552 bytes keep the sums below 2^32 (RFC 1950)
  constexpr std::uint32_t kModulus = 65521;
  std::uint32_t a = 1, b = 0;
  while (!data.empty()) {
    const auto part = data.first(std::min(kBetween, data.size()));
    for (const std::uint8_t byte : part) a += byte, b += a;
    a %= kModulus, b %= kModulus;
    data = data.subspan(part.size());
  }
  return b << 16 | a;
}

std::vector<char> zlib_stream(std::span<const std::uint8_t> data) {
  std::vector<char> stream = {'\x78', '\x01'};  // a window of 32 KiB, the fastest compression
  deflate(data, stream);
  append_big_endian(stream, adler32(data));
  return stream;
}

}  // namespace

std::vector<char> png_of(const Image& image) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kLargestChunk = std::size_t{1} << 30;  // chosen; the format has 2^31 - 1
  std::vector<char> png(kSignature.begin(), kSignature.end());
  std::vector<char> header;
  append_big_endian(header, static_cast<std::uint32_t>(image.width));
  append_big_endian(header, static_cast<std::uint32_t>(image.height));
  // 8 bits a colour, RGB, the only compression method, the only filter method, not interlaced.
  header.insert(header.end(), {8, 2, 0, 0, 0});
  append_chunk(png, "IHDR", {header.data(), header.size()});
  const std::vector<char> stream = zlib_stream(filtered_rows(image));
  for (std::string_view rest(stream.data(), stream.size()); !rest.empty();) {
    const std::string_view part = rest.substr(0, kLargestChunk);
    append_chunk(png, "IDAT", part);
    rest.remove_prefix(part.size());
  }
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace rholm
