// Conditions that hold for any bytes given to a reader of shapes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/file/output_buffer.h"
#include "io/shapes/shape_writers.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/shape_io.h"

namespace rholm::fuzzing {

inline void require(bool condition) {
  if (!condition) std::abort();
}

inline std::vector<char> formatted(const ShapeView& shape, ShapeFormat format) {
  OutputBuffer out(nullptr);
  format_shape(shape, format, {.name = "fuzz"}, out);
  return out.take();
}

inline ShapeView view_of(const ShapeFile& file) {
  return std::visit([](const auto& shape) { return shape_view_of(shape); }, file.shape);
}

template <typename T>
std::vector<T> all_of(const RowRange<T>& range) {
  std::vector<T> all;
  range.visit([&](std::size_t, const T& row) { all.push_back(row); });
  return all;
}

// Checks that positions, normals of points and triangles are read back with the same bits. (A mesh
// all of whose faces were skipped is read back as points.)
inline void check_round_trip(const ShapeView& shape, ShapeFormat format) {
  const std::vector<char> bytes = formatted(shape, format);
  const ShapeFile again = parse_shape(bytes, to_string(format));
  const ShapeView read = view_of(again);
  require(all_of(shape.points) == all_of(read.points));
  require(all_of(shape.faces) == all_of(read.faces));
  if (!shape.is_mesh) {
    require(std::equal(shape.normals.begin(), shape.normals.end(), read.normals.begin(),
                       read.normals.end()));
  }
}

// Checks that an Error is thrown, or that the shape is valid and survives writing in the same
// format and as PLY. `extension` chooses the reader where the content does not.
inline void check_reader(const std::uint8_t* data, std::size_t size, const std::string& extension) {
  const std::span<const char> bytes(reinterpret_cast<const char*>(data), size);
  ShapeFile file;
  try {
    file = parse_shape(bytes, "fuzz." + extension);
  } catch (const Error&) {
    return;
  }
  std::visit([](const auto& shape) { validate(shape); }, file.shape);
  // Memory is at most a small multiple of the file: each number takes a byte of it or more.
  const ShapeView shape = view_of(file);
  require(shape.points.size() <= size && shape.faces.size() <= size);
  check_round_trip(shape, ShapeFormat::kPly);
  // Formats that round to float or have no triangles are tested by their own round trips.
  const ShapeFormatInfo& format = shape_format_info(file.format);
  const bool exact = format.faces && !format.single_precision;
  if (exact || !shape.is_mesh) check_round_trip(shape, file.format);
}

}  // namespace rholm::fuzzing
