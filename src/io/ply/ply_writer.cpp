// PLY: positions and normals as double, attributes in their own type, triangles as int lists.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "io/file/scalar_bytes.h"
#include "io/ply/ply_header.h"
#include "io/ply/ply_parts.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "io/spill/spill_file.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// A column of the vertex rows: values at intervals of `stride` doubles.
struct OutputColumn {
  std::string name;
  ScalarType type = ScalarType::kFloat64;
  const double* values = nullptr;
  std::size_t stride = 1;
  // Set if the values may not be in memory as doubles: an axis of the points, or scalars.
  std::optional<std::size_t> axis = {};
  const ScalarRange* scalars = nullptr;
};

constexpr std::size_t kBlock = 256;  // rows that stay in the first-level cache

struct RowBlock {
  std::size_t first = 0, n = 0;
  std::array<Vec3, kBlock> points;
};

// Returns a block's values at intervals of `stride` doubles; values not in memory go into `room`.
const double* values_of(const OutputColumn& column, const RowBlock& block,
                        std::array<double, kBlock>& room) {
  if (column.axis) return &block.points[0].x + *column.axis;
  if (column.scalars == nullptr) return column.values + block.first * column.stride;
  column.scalars->load(block.first, block.n, room.data());
  return room.data();
}

// Returns the attribute's own type if it holds all values exactly, otherwise double, so that no
// digits are lost. Values in a file always fit their type.
ScalarType stored_type(const ScalarRange& attribute, std::size_t n) {
  const double* const values = attribute.in_memory();
  const auto fits = [&](double value) { return is_value_of(attribute.type, value); };
  return values == nullptr || std::all_of(values, values + n, fits) ? attribute.type
                                                                    : ScalarType::kFloat64;
}

// Returns an unused name that PLY can hold (printable, without blanks).
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
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3 && shape.points.size() > 0; ++k) {
    columns.push_back({.name = kAxes[k], .stride = 3, .axis = k});
    taken.insert(kAxes[k]);
  }
  add_vectors(shape.normals, {"nx", "ny", "nz"});
  for (const ScalarRange& attribute : shape.attributes) {
    const double* const values = attribute.in_memory();
    columns.push_back({.name = free_name(attribute.name, taken),
                       .type = stored_type(attribute, shape.points.size()),
                       .values = values,
                       .scalars = values == nullptr ? &attribute : nullptr});
  }
  return columns;
}

struct Counts {
  std::uint64_t vertices = 0, faces = 0;
  bool is_mesh = false;
  bool wide_indices() const {
    return vertices > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  }
};

void put_header(const Counts& counts, const std::vector<OutputColumn>& columns, bool ascii,
                OutputBuffer& out) {
  out.text(ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n");
  out.text("element vertex ");
  out.number(counts.vertices, '\n');
  for (const OutputColumn& column : columns) {
    out.text("property ");
    out.text(ply_type_name(column.type));
    out.text(" ");
    out.text(column.name);
    out.text("\n");
  }
  if (counts.is_mesh) {
    out.text("element face ");
    out.number(counts.faces, '\n');
    out.text(counts.wide_indices() ? "property list uchar uint vertex_indices\n"
                                   : "property list uchar int vertex_indices\n");
  }
  out.text("end_header\n");
}

// Writes one value of each row of a block, at intervals of `row_size` bytes.
template <class T>
void encode(const double* values, std::size_t stride, std::size_t n, char* to,
            std::size_t row_size) {
  for (std::size_t i = 0; i < n; ++i) {
    store_little_endian(to + i * row_size, static_cast<T>(values[i * stride]));
  }
}

// Calls visit(block) for blocks of rows.
template <class Visit>
void visit_rows(const PointRange& points, const Visit& visit) {
  RowBlock block;
  for (std::size_t row = 0; row < points.size(); row += kBlock) {
    block.first = row;
    block.n = std::min(kBlock, points.size() - row);
    for (std::size_t i = 0; i < block.n; ++i) block.points[i] = points[row + i];
    visit(block);
    const std::size_t end = row + kBlock;
    if (end % PointRange::kVisited == 0) {
      points.release(end - PointRange::kVisited, PointRange::kVisited);
    }
  }
}

constexpr std::size_t kBinaryTriangle = 13;  // bytes: a count and three indices

// Writes rows of all columns to `to`; returns the end.
char* put_binary_rows(const std::vector<OutputColumn>& columns, const RowBlock& block,
                      std::size_t row_size, char* to) {
  char* const end = to + block.n * row_size;
  std::array<double, kBlock> room;
  for (const OutputColumn& column : columns) {
    const double* const values = values_of(column, block, room);
    with_scalar_type(column.type, [&](auto tag) {
      encode<typename decltype(tag)::type>(values, column.stride, block.n, to, row_size);
    });
    to += size_of(column.type);
  }
  return end;
}

std::size_t row_size_of(const std::vector<OutputColumn>& columns) {
  std::size_t size = 0;
  for (const OutputColumn& column : columns) size += size_of(column.type);
  return size;
}

void put_binary_rows(const std::vector<OutputColumn>& columns, const PointRange& points,
                     OutputBuffer& out) {
  const std::size_t row_size = row_size_of(columns);
  visit_rows(points, [&](const RowBlock& block) {
    out.advance(put_binary_rows(columns, block, row_size, out.room(block.n * row_size)));
    out.rows(block.n);
  });
}

// Writes a triangle; returns the end.
template <class Index>
char* store_triangle(const std::array<Index, 3>& t, char* to) {
  *to = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    store_little_endian(to + 1 + 4 * k, static_cast<std::uint32_t>(t[k]));
  }
  return to + kBinaryTriangle;
}

void put_binary_triangles(const TriangleRange& triangles, OutputBuffer& out) {
  triangles.visit([&](std::size_t, const Triangle& t) {
    out.advance(store_triangle(t, out.room(kBinaryTriangle)));
    out.rows(1);
  });
}

// Writes floats with digits that read back as the same float, other values as the same double.
void put_text_rows(const std::vector<OutputColumn>& columns, const PointRange& points,
                   OutputBuffer& out) {
  std::vector<std::array<double, kBlock>> rooms(columns.size());
  std::vector<const double*> values(columns.size());
  visit_rows(points, [&](const RowBlock& block) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      values[c] = values_of(columns[c], block, rooms[c]);
    }
    for (std::size_t i = 0; i < block.n; ++i) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const OutputColumn& column = columns[c];
        const char separator = c + 1 == columns.size() ? '\n' : ' ';
        const double value = values[c][i * column.stride];
        if (column.type == ScalarType::kFloat32) {
          out.number(static_cast<float>(value), separator);
        } else {
          out.number(value, separator);
        }
      }
      out.rows(1);
    }
  });
}

void put_text_triangles(const TriangleRange& triangles, OutputBuffer& out) {
  triangles.visit([&](std::size_t, const Triangle& t) {
    out.text("3 ");
    out.number(t[0], ' ');
    out.number(t[1], ' ');
    out.number(t[2], '\n');
    out.rows(1);
  });
}

}  // namespace

std::vector<std::string> format_ply(const ShapeView& shape, const ShapeWriting& how,
                                    OutputBuffer& out) {
  const std::vector<OutputColumn> columns = columns_of(shape);
  put_header({shape.points.size(), shape.faces.size(), shape.is_mesh}, columns, how.ascii, out);
  if (how.ascii) {
    put_text_rows(columns, shape.points, out);
    put_text_triangles(shape.faces, out);
  } else {
    put_binary_rows(columns, shape.points, out);
    put_binary_triangles(shape.faces, out);
  }
  return {};
}

void PlyPoints::put(const PointCloud& piece) {
  const ShapeView shape = shape_view_of(piece);
  const std::vector<OutputColumn> columns = columns_of(shape);
  if (!begun_) put_header({n_, 0, false}, columns, ascii_, out_);
  begun_ = true;
  if (ascii_) {
    put_text_rows(columns, shape.points, out_);
  } else {
    put_binary_rows(columns, shape.points, out_);
  }
}

namespace {

// PLY indices have 32 bits.
constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 32;

std::vector<OutputColumn> columns_of_part(const Mesh& part) {
  ShapeView places;
  places.points = PointRange(part.vertices);
  std::vector<OutputColumn> columns = columns_of(places);
  std::set<std::string> taken = {"x", "y", "z"};
  for (const Attribute& attribute : part.attributes) {
    columns.push_back({.name = free_name(attribute.name, taken),
                       .type = attribute.type,
                       .values = attribute.values.data()});
  }
  return columns;
}

}  // namespace

PlyLayout::PlyLayout(std::uint64_t vertices, std::uint64_t triangles,
                     std::span<const Attribute> attributes)
    : vertices_(vertices), triangles_(triangles) {
  if (vertices > kMostVertices) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the mesh has {} vertices, a PLY can number {}: take a coarser step, "
                            "or simplify",
                            vertices, kMostVertices));
  }
  Mesh none;
  none.vertices.emplace_back();  // for the columns' names
  none.attributes.assign(attributes.begin(), attributes.end());
  const std::vector<OutputColumn> columns = columns_of_part(none);
  row_ = row_size_of(columns);
  OutputBuffer out(nullptr);
  put_header({vertices, triangles, true}, columns, false, out);
  const std::vector<char> text = out.take();
  header_.assign(text.begin(), text.end());
}

std::uint64_t PlyLayout::vertex(std::uint64_t number) const {
  return header_.size() + number * row_;
}

std::uint64_t PlyLayout::triangle(std::uint64_t number) const {
  return vertex(vertices_) + number * kBinaryTriangle;
}

std::vector<std::byte> ply_vertices(const Mesh& part) {
  if (part.vertices.empty()) return {};
  const std::vector<OutputColumn> columns = columns_of_part(part);
  const std::size_t row_size = row_size_of(columns);
  std::vector<std::byte> bytes(row_size * part.vertices.size());
  char* to = reinterpret_cast<char*>(bytes.data());
  visit_rows(PointRange(part.vertices),
             [&](const RowBlock& block) { to = put_binary_rows(columns, block, row_size, to); });
  return bytes;
}

std::vector<std::byte> ply_triangles(std::span<const WideTriangle> triangles) {
  std::vector<std::byte> bytes(kBinaryTriangle * triangles.size());
  char* to = reinterpret_cast<char*>(bytes.data());
  for (const WideTriangle& t : triangles) to = store_triangle(t, to);
  return bytes;
}

PlyParts::PlyParts(const std::filesystem::path& path, const PlyLayout& layout,
                   const Context& context, AtomicFile::Writers writers)
    : file_(path, context, writers) {
  file_.write(layout.header());
  if (!file().empty()) SpillFile(file(), SpillFile::Mode::kInPlace).make_room(layout.size());
}

void PlyParts::put(const std::filesystem::path& file, const PlyLayout& layout,
                   const PlyPart& part) {
  SpillFile out(file, SpillFile::Mode::kInPlace);
  out.write_at(layout.vertex(part.first_vertex), ply_vertices(part.vertices));
  out.write_at(layout.triangle(part.first_triangle), ply_triangles(part.faces));
  out.close();
}

void PlyParts::append(std::span<const std::byte> bytes) {
  file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void PlyParts::commit() { file_.commit(); }

}  // namespace rholm
