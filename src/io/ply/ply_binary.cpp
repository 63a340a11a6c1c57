#include <algorithm>
#include <array>
#include <bit>

#include "base/plain_text.h"
#include "io/file/scalar_bytes.h"
#include "io/ply/ply_body.h"

namespace rholm {
namespace {

// Decodes n values at intervals of `stride` bytes into `out`, at intervals of `out_stride` doubles.
using Decoder = void (*)(const char* first, std::size_t stride, std::size_t n, double* out,
                         std::size_t out_stride);

template <class T, bool kSwap>
void decode(const char* first, std::size_t stride, std::size_t n, double* out,
            std::size_t out_stride) {
  for (std::size_t i = 0; i < n; ++i) {
    out[i * out_stride] = static_cast<double>(load<T, kSwap>(first + i * stride));
  }
}

Decoder decoder_of(ScalarType type, bool swap) {
  return with_scalar_type(type, [swap](auto tag) -> Decoder {
    using T = typename decltype(tag)::type;
    return swap ? decode<T, true> : decode<T, false>;
  });
}

// Loads an integer of a list: its length, or an index. (The largest type, uint32, fits.)
template <bool kSwap>
std::int64_t load_integer(const char* from, ScalarType type) {
  return with_scalar_type(type, [from](auto tag) {
    return static_cast<std::int64_t>(load<typename decltype(tag)::type, kSwap>(from));
  });
}
std::int64_t load_integer(const char* from, ScalarType type, bool swap) {
  return swap ? load_integer<true>(from, type) : load_integer<false>(from, type);
}

bool has_list(const PlyElement& element, std::size_t first, std::size_t last) {
  return std::any_of(element.properties.begin() + static_cast<std::ptrdiff_t>(first),
                     element.properties.begin() + static_cast<std::ptrdiff_t>(last),
                     [](const PlyProperty& p) { return p.is_list; });
}

// Returns the bytes of the properties [first, last) of a row, none of which is a list.
std::size_t fixed_size(const PlyElement& element, std::size_t first, std::size_t last) {
  std::size_t size = 0;
  for (std::size_t i = first; i < last; ++i) size += size_of(element.properties[i].type);
  return size;
}

struct Column {
  std::size_t offset = 0;  // bytes before the value in its row
  Decoder decoder = nullptr;
  PlyVertices::Slot slot;
};

std::vector<Column> wanted_columns(const PlyElement& element, const PlyVertices& vertices,
                                   bool swap) {
  std::vector<Column> columns;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (vertices.slots()[i].first != nullptr) {
      columns.push_back({.offset = offset,
                         .decoder = decoder_of(property.type, swap),
                         .slot = vertices.slots()[i]});
    }
    offset += size_of(property.type);
  }
  return columns;
}

}  // namespace

PlyBinaryBody::PlyBinaryBody(const ShapeSource& source, const PlyHeader& header)
    : source_(source),
      at_(source.bytes.data() + header.body),
      end_(source.bytes.data() + source.bytes.size()),
      swap_((header.encoding == PlyEncoding::kBigEndian) !=
            (std::endian::native == std::endian::big)) {}

void PlyBinaryBody::fail_truncated(const PlyElement& element) const {
  source_.fail("truncated: the " + std::to_string(source_.bytes.size()) +
               " bytes of the file end before the " + std::to_string(element.count) +
               " rows of element " + in_quotes(element.name) + " do");
}

// Throws unless n items of `size` bytes are left.
void PlyBinaryBody::require(const PlyElement& element, std::uint64_t n, std::size_t size) const {
  if (size > 0 && n > left() / size) fail_truncated(element);
}

void PlyBinaryBody::skip_bytes(const PlyElement& element, std::uint64_t n, std::size_t size) {
  require(element, n, size);
  at_ += n * size;
}

std::uint64_t PlyBinaryBody::take_count(const PlyElement& element, const PlyProperty& list) {
  require(element, 1, size_of(list.count_type));
  const std::int64_t count = load_integer(at_, list.count_type, swap_);
  if (count < 0) {
    source_.fail("a list " + in_quotes(list.name) + " has the length " + std::to_string(count));
  }
  at_ += size_of(list.count_type);
  require(element, static_cast<std::uint64_t>(count), size_of(list.type));
  return static_cast<std::uint64_t>(count);
}

void PlyBinaryBody::skip_properties(const PlyElement& element, std::size_t first,
                                    std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const PlyProperty& property = element.properties[i];
    const std::uint64_t n = property.is_list ? take_count(element, property) : 1;
    skip_bytes(element, n, size_of(property.type));
  }
}

void PlyBinaryBody::skip(const PlyElement& element) {
  const std::size_t n = element.properties.size();
  if (!has_list(element, 0, n)) {
    skip_bytes(element, element.count, fixed_size(element, 0, n));
    return;
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    skip_properties(element, 0, n);
    source_.progress(at_);
  }
}

void PlyBinaryBody::read_vertices(const PlyElement& element, PlyVertices& vertices) {
  if (has_list(element, 0, element.properties.size())) {
    return read_varying_vertices(element, vertices);
  }
  const std::size_t stride = fixed_size(element, 0, element.properties.size());
  require(element, element.count, stride);
  vertices.reserve(element.count);
  const std::vector<Column> columns = wanted_columns(element, vertices, swap_);
  for (std::uint64_t row = 0; row < element.count;) {
    const std::size_t n = std::min<std::uint64_t>(vertices.block_rows(), element.count - row);
    for (const Column& c : columns) {
      c.decoder(at_ + c.offset, stride, n, c.slot.first, c.slot.stride);
    }
    at_ += n * stride;
    row += n;
    vertices.append_block(n);
    source_.progress(at_);
  }
}

// Rows with lists have no fixed size: reads value by value.
void PlyBinaryBody::read_varying_vertices(const PlyElement& element, PlyVertices& vertices) {
  std::size_t in_block = 0;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const PlyVertices::Slot& slot = vertices.slots()[i];
      if (property.is_list || slot.first == nullptr) {
        skip_properties(element, i, i + 1);
        continue;
      }
      require(element, 1, size_of(property.type));
      decoder_of(property.type, swap_)(at_, 0, 1, slot.first + in_block * slot.stride, 1);
      at_ += size_of(property.type);
    }
    if (++in_block == vertices.block_rows()) {
      vertices.append_block(in_block);
      in_block = 0;
      source_.progress(at_);
    }
  }
  vertices.append_block(in_block);
}

void PlyBinaryBody::read_faces(const PlyElement& element, std::size_t list, PlyFaces& faces) {
  const PlyProperty& property = element.properties[list];
  // A face has at least its count, and most faces have three corners.
  require(element, element.count, size_of(property.count_type));
  const std::size_t triangle = size_of(property.count_type) + 3 * size_of(property.type);
  faces.list.reserve(std::min<std::uint64_t>(element.count, left() / triangle));
  with_scalar_type(property.type, [&](auto tag) {
    using Index = typename decltype(tag)::type;
    if constexpr (std::is_integral_v<Index>) {
      if (swap_) {
        read_face_rows<Index, true>(element, list, faces);
      } else {
        read_face_rows<Index, false>(element, list, faces);
      }
    }
  });
}

template <class Index, bool kSwap>
void PlyBinaryBody::read_face_rows(const PlyElement& element, std::size_t list, PlyFaces& faces) {
  const std::size_t n_properties = element.properties.size();
  const PlyProperty& property = element.properties[list];
  std::uint64_t row = 0;
  if (n_properties == 1 && size_of(property.count_type) == 1 && sizeof(Index) == 4) {
    row = read_plain_triangles<kSwap>(element, faces);
  }
  std::vector<std::uint32_t> corners;
  for (; row < element.count; ++row) {
    skip_properties(element, 0, list);
    const std::uint64_t n = take_count(element, property);
    corners.resize(n);
    for (std::uint64_t k = 0; k < n; ++k) {
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): a negative one stays negative, and is refused
      const auto index = static_cast<std::int64_t>(load<Index, kSwap>(at_ + k * sizeof(Index)));
      if (static_cast<std::uint64_t>(index) >= faces.n_vertices()) faces.fail_index(row, index);
      corners[k] = static_cast<std::uint32_t>(index);
    }
    at_ += n * sizeof(Index);
    faces.list.add(corners);
    skip_properties(element, list + 1, n_properties);
    if (row % 1024 == 0) source_.progress(at_);
  }
}

// Reads the usual layout: a byte 3 and three 4-byte indices. Returns the number of rows read, which
// end before the first face that is not a triangle.
template <bool kSwap>
std::uint64_t PlyBinaryBody::read_plain_triangles(const PlyElement& element, PlyFaces& faces) {
  constexpr std::size_t kStride = 1 + 3 * 4;
  std::array<Triangle, 1024> block;  // 12 kB, stays in the first-level cache
  std::uint64_t row = 0;
  const std::uint64_t rows = std::min<std::uint64_t>(element.count, left() / kStride);
  while (row < rows) {
    const std::size_t n = std::min<std::uint64_t>(block.size(), rows - row);
    std::uint32_t largest = 0;
    std::size_t i = 0;
    for (; i < n && at_[i * kStride] == 3; ++i) {
      const char* corners = at_ + i * kStride + 1;
      block[i] = {load<std::uint32_t, kSwap>(corners), load<std::uint32_t, kSwap>(corners + 4),
                  load<std::uint32_t, kSwap>(corners + 8)};
      largest = std::max({largest, block[i][0], block[i][1], block[i][2]});
    }
    // The loop over rows handles an index out of range, because it names the face.
    if (largest >= faces.n_vertices()) break;
    faces.list.add_triangles(std::span(block).first(i));
    at_ += i * kStride;
    row += i;
    if (i < n) break;
    source_.progress(at_);
  }
  return row;
}

void PlyBinaryBody::read_strips(const PlyElement& element, std::size_t list, PlyFaces& faces) {
  const PlyProperty& property = element.properties[list];
  const std::size_t size = size_of(property.type);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    skip_properties(element, 0, list);
    const std::uint64_t n = take_count(element, property);
    for (std::uint64_t k = 0; k < n; ++k, at_ += size) {
      faces.add_to_strip(load_integer(at_, property.type, swap_));
    }
    faces.end_strip();
    skip_properties(element, list + 1, element.properties.size());
    source_.progress(at_);
  }
}

}  // namespace rholm
