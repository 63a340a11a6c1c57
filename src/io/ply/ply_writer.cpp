// PLY: positions and normals as double, attributes in their own type, triangles as int lists.
#include <algorithm>
#include <limits>
#include <set>

#include "io/file/scalar_bytes.h"
#include "io/ply/ply_header.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"

namespace rholm {
namespace {

// A column of a vertex: `count` values `stride` doubles apart.
struct OutputColumn {
  std::string name;
  ScalarType type = ScalarType::kFloat64;
  const double* values = nullptr;
  std::size_t stride = 1;
};

// The attribute's own type if it holds all values exactly, else double: nothing is lost.
ScalarType stored_type(const Attribute& attribute) {
  const auto fits = [&](double value) { return is_value_of(attribute.type, value); };
  return std::all_of(attribute.values.begin(), attribute.values.end(), fits) ? attribute.type
                                                                             : ScalarType::kFloat64;
}

// A name PLY can hold (printable, without blanks) that is not taken yet.
std::string free_name(const std::string& wanted, std::set<std::string>& taken) {
  std::string name;
  for (const char c : wanted) name += c > 0x20 && c != 0x7f ? c : '_';
  if (name.empty()) name = "scalar";
  std::string candidate = name;
  for (int i = 2; !taken.insert(candidate).second; ++i) candidate = name + "_" + std::to_string(i);
  return candidate;
}

std::vector<OutputColumn> columns_of(const ShapeView& shape) {
  std::vector<OutputColumn> columns;
  std::set<std::string> taken;
  const auto add_vectors = [&](std::span<const Vec3> v, const std::array<const char*, 3>& names) {
    if (v.empty()) return;
    const std::array<const double*, 3> first = {&v[0].x, &v[0].y, &v[0].z};
    for (std::size_t k = 0; k < 3; ++k) {
      columns.push_back({.name = names[k], .values = first[k], .stride = 3});
      taken.insert(names[k]);
    }
  };
  add_vectors(shape.points, {"x", "y", "z"});
  add_vectors(shape.normals, {"nx", "ny", "nz"});
  for (const Attribute& attribute : shape.attributes) {
    columns.push_back({.name = free_name(attribute.name, taken),
                       .type = stored_type(attribute),
                       .values = attribute.values.data()});
  }
  return columns;
}

void put_header(const ShapeView& shape, const std::vector<OutputColumn>& columns, bool ascii,
                bool wide_indices, OutputBuffer& out) {
  out.text(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
  out.text("element vertex ");
  out.number(shape.points.size(), '\n');
  for (const OutputColumn& column : columns) {
    out.text("property ");
    out.text(ply_type_name(column.type));
    out.text(" ");
    out.text(column.name);
    out.text("\n");
  }
  if (shape.is_mesh) {
    out.text("element face ");
    out.number(shape.triangles.size(), '\n');
    out.text(wide_indices ? "property list uchar uint vertex_indices\n"
                          : "property list uchar int vertex_indices\n");
  }
  out.text("end_header\n");
}

// Writes one value of each row of a block, `row_size` bytes apart.
template <class T>
void encode(const double* values, std::size_t stride, std::size_t n, char* to,
            std::size_t row_size) {
  for (std::size_t i = 0; i < n; ++i) {
    store_little_endian(to + i * row_size, static_cast<T>(values[i * stride]));
  }
}

void put_binary_rows(const std::vector<OutputColumn>& columns, std::size_t n, OutputBuffer& out) {
  std::size_t row_size = 0;
  for (const OutputColumn& column : columns) row_size += size_of(column.type);
  constexpr std::size_t kBlock = 256;  // rows that stay in the first-level cache
  for (std::size_t row = 0; row < n; row += kBlock) {
    const std::size_t rows = std::min(kBlock, n - row);
    char* to = out.room(rows * row_size);
    char* const end = to + rows * row_size;
    for (const OutputColumn& column : columns) {
      with_scalar_type(column.type, [&](auto tag) {
        encode<typename decltype(tag)::type>(column.values + row * column.stride, column.stride,
                                             rows, to, row_size);
      });
      to += size_of(column.type);
    }
    out.advance(end);
    out.rows(rows);
  }
}

void put_binary_triangles(std::span<const Triangle> triangles, OutputBuffer& out) {
  for (const Triangle& t : triangles) {
    char* to = out.room(13);
    *to = 3;
    for (std::size_t k = 0; k < 3; ++k) store_little_endian(to + 1 + 4 * k, t[k]);
    out.advance(to + 13);
    out.rows(1);
  }
}

// Floats with the digits that read back as the same float, others as the same double.
void put_text_rows(const std::vector<OutputColumn>& columns, std::size_t n, OutputBuffer& out) {
  for (std::size_t row = 0; row < n; ++row) {
    for (const OutputColumn& column : columns) {
      const char separator = &column == &columns.back() ? '\n' : ' ';
      const double value = column.values[row * column.stride];
      if (column.type == ScalarType::kFloat32) {
        out.number(static_cast<float>(value), separator);
      } else {
        out.number(value, separator);
      }
    }
    out.rows(1);
  }
}

void put_text_triangles(std::span<const Triangle> triangles, OutputBuffer& out) {
  for (const Triangle& t : triangles) {
    out.text("3 ");
    out.number(t[0], ' ');
    out.number(t[1], ' ');
    out.number(t[2], '\n');
    out.rows(1);
  }
}

}  // namespace

void format_ply(const ShapeView& shape, bool ascii, OutputBuffer& out) {
  const std::vector<OutputColumn> columns = columns_of(shape);
  const bool wide_indices =
      shape.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  put_header(shape, columns, ascii, wide_indices, out);
  if (ascii) {
    put_text_rows(columns, shape.points.size(), out);
    put_text_triangles(shape.triangles, out);
  } else {
    put_binary_rows(columns, shape.points.size(), out);
    put_binary_triangles(shape.triangles, out);
  }
}

}  // namespace rholm
