// The writers of shapes. Layer: io.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/file/output_buffer.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/shape_io.h"

namespace rholm {

// Called after n rows of a mapped mesh, from `first` on, have been written.
using ReleaseRows = std::function<void(std::size_t first, std::size_t n)>;

// Points or vertices, or triangles, of a mesh in memory or in a mapped file.
template <typename T>
class RowRange {
 public:
  RowRange() = default;
  explicit RowRange(std::span<const T> rows) : rows_(rows), size_(rows.size()) {}
  RowRange(const MeshView& mesh, ReleaseRows release)
      : mesh_(&mesh),
        release_(std::move(release)),
        size_(kPoints ? mesh.n_vertices : mesh.n_faces) {}
  // n rows that `walk` passes to its callback in order, each time they are visited.
  using Walk = std::function<void(const std::function<void(const T&)>& visit)>;
  RowRange(std::size_t n, Walk walk) : walk_(std::move(walk)), size_(n) {}
  std::size_t size() const { return size_; }
  // Returns row i; not available with a Walk.
  T operator[](std::size_t i) const {
    if (mesh_ == nullptr) return rows_[i];
    if constexpr (kPoints) {
      return mesh_->vertex(i);
    } else {
      return mesh_->triangle(i);
    }
  }
  // Calls visit(i) for all numbers in order, and releases visited rows.
  template <typename Visit>
  void visit_numbers(const Visit& visit) const {
    for (std::size_t first = 0; first < size_; first += kVisited) {
      const std::size_t n = std::min(kVisited, size_ - first);
      for (std::size_t i = first; i < first + n; ++i) visit(i);
      release(first, n);
    }
  }
  // Calls visit(i, row) for all rows in order, and releases visited rows.
  template <typename Visit>
  void visit(const Visit& visit) const {
    if (!walk_) return visit_numbers([&](std::size_t i) { visit(i, (*this)[i]); });
    std::size_t i = 0;
    walk_([&](const T& row) { visit(i++, row); });
  }
  void release(std::size_t first, std::size_t n) const {
    if (release_) release_(first, n);
  }
  static constexpr std::size_t kVisited = std::size_t{1} << 16;  // about 1 MB

 private:
  static constexpr bool kPoints = std::is_same_v<T, Vec3>;
  std::span<const T> rows_;
  const MeshView* mesh_ = nullptr;
  ReleaseRows release_;
  Walk walk_;
  std::size_t size_ = 0;
};
using PointRange = RowRange<Vec3>;
using TriangleRange = RowRange<Triangle>;

// An attribute of all points or vertices, in memory or in the rows of a mapped file.
class ScalarRange {
 public:
  explicit ScalarRange(const Attribute& attribute)
      : name(attribute.name), type(attribute.type), values_(attribute.values) {}
  explicit ScalarRange(const MappedScalar& scalar)
      : name(scalar.name), type(scalar.type), first_(scalar.first), stride_(scalar.stride) {}

  double operator[](std::size_t i) const {
    if (first_ == nullptr) return values_[i];
    double value = 0;
    load(i, 1, &value);
    return value;
  }
  // Returns all values if they are in memory as doubles, otherwise null.
  const double* in_memory() const { return first_ == nullptr ? values_.data() : nullptr; }
  // Loads n values from `begin` on.
  void load(std::size_t begin, std::size_t n, double* to) const;

  std::string name;
  ScalarType type;

 private:
  std::span<const double> values_;
  const std::byte* first_ = nullptr;
  std::size_t stride_ = 0;
};

// A mesh or points in the form for writers.
struct ShapeView {
  PointRange points;
  std::span<const Vec3> normals;  // for points; a mesh has normals as attributes
  TriangleRange faces;
  std::vector<ScalarRange> attributes;
  bool is_mesh = false;
};
ShapeView shape_view_of(const Mesh& mesh);
ShapeView shape_view_of(const PointCloud& cloud);

// Options of a writer of shapes.
struct ShapeWriting {
  bool ascii = false;     // text if the format has both
  std::string name = {};  // name of the file, for messages
};
// Writes a valid shape that the format can hold; returns warnings as write_shape() does.
using ShapeFormatter = std::vector<std::string>(const ShapeView& shape, const ShapeWriting& how,
                                                OutputBuffer& out);

// Writes a valid shape and returns warnings as write_shape() does. Throws Unsupported if the format
// cannot hold it, InvalidInput if a coordinate does not fit; `name` is for messages.
std::vector<std::string> format_shape(const ShapeView& shape, ShapeFormat format,
                                      const ShapeWriting& how, OutputBuffer& out);

// Returns the format from the options or the extension. Throws InvalidInput for "-" without a
// format, Unsupported for an unknown extension.
ShapeFormat written_format(const std::filesystem::path& path, const ShapeWriteOptions& options);

// Does the work of write_shape() for a valid shape.
std::vector<std::string> write_view(const ShapeView& shape, const std::filesystem::path& path,
                                    const ShapeWriteOptions& options, const Context& context);

ShapeFormatter format_ply, format_obj, format_off, format_stl, format_xyz;

// Writes points in blocks, all with normals or none, and with the same attributes, whose types hold
// their values. The output is what format_ply() writes for all points at once.
class PlyPoints {
 public:
  PlyPoints(std::uint64_t n, bool ascii, OutputBuffer& out) : n_(n), ascii_(ascii), out_(out) {}
  void put(const PointCloud& piece);

 private:
  std::uint64_t n_;
  bool ascii_;
  bool begun_ = false;
  OutputBuffer& out_;
};
// Write parts of format_xyz(): the text before the rows, and rows.
void put_xyz_header(bool names, OutputBuffer& out);
void put_xyz_rows(const ShapeView& shape, OutputBuffer& out);

// Several attributes that belong together, if all exist.
template <std::size_t kSize, class One = ScalarRange>
using AttributeGroup = std::optional<std::array<const One*, kSize>>;
template <std::size_t kSize, class One>
AttributeGroup<kSize, One> find_group(std::span<const One> attributes,
                                      const std::array<const char*, kSize>& names) {
  std::array<const One*, kSize> group = {};
  for (std::size_t k = 0; k < kSize; ++k) {
    for (const One& a : attributes) {
      if (group[k] == nullptr && a.name == names[k]) group[k] = &a;
    }
    if (group[k] == nullptr) return std::nullopt;
  }
  return group;
}

// Finds texture coordinates under their usual names.
template <class One>
AttributeGroup<2, One> find_texture(std::span<const One> attributes) {
  for (const std::array<const char*, 2>& names :
       {std::array{"u", "v"}, std::array{"s", "t"}, std::array{"texture_u", "texture_v"}}) {
    if (auto group = find_group<2, One>(attributes, names)) return group;
  }
  return std::nullopt;
}

// One normal per point or vertex, if the shape has normals.
class NormalRange {
 public:
  // Valid as long as the shape.
  explicit NormalRange(const ShapeView& shape);
  bool empty() const { return vectors_.empty() && !scalars_; }
  Vec3 operator[](std::size_t i) const {
    if (!scalars_) return vectors_[i];
    const auto& [x, y, z] = *scalars_;
    return {(*x)[i], (*y)[i], (*z)[i]};
  }

 private:
  std::span<const Vec3> vectors_;
  AttributeGroup<3> scalars_;
};

// Writes the numbers of a vector with blanks between them, and the character `last`.
inline void put_vector(const Vec3& v, char last, OutputBuffer& out) {
  out.number(v.x, ' ');
  out.number(v.y, ' ');
  out.number(v.z, last);
}

}  // namespace rholm
