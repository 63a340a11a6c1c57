// Points as rows of bytes, each value in the smallest type that has it. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/topology.h"

namespace rholm {

// Types of an attribute: the type in files, and the kept type, which has all its values.
struct ColumnLayout {
  std::string name = {};
  ScalarType type = ScalarType::kFloat32, kept = ScalarType::kFloat32;

  friend bool operator==(const ColumnLayout&, const ColumnLayout&) = default;
};

// A row: x, y, z, the normal if there are normals, the attributes.
struct PointLayout {
  bool single_points = true;   // all coordinates are floats
  bool single_normals = true;  // all normals are
  bool normals = false;
  std::vector<ColumnLayout> columns = {};

  std::size_t row_bytes() const;
  friend bool operator==(const PointLayout&, const PointLayout&) = default;
};

// Returns the narrowest layout for all points of the cloud.
PointLayout layout_of(const PointCloud& cloud);
// Widens a layout to fit another one as well. Throws InvalidInput if their attributes differ.
void widen(PointLayout& layout, const PointLayout& other);

// Writes point i to `to`, which has row_bytes(). Missing normals and not finite ones become zero.
void put_row(const PointLayout& layout, const PointCloud& cloud, std::size_t i, std::byte* to);
// Adds the rows to the cloud, which is empty or of this layout. With `box`, only rows within it are
// added. With `taken`, their numbers among the rows are added there. Throws InvalidInput unless
// `rows` are whole rows.
void take_rows(const PointLayout& layout, std::span<const std::byte> rows, PointCloud& cloud,
               const Bounds* box = nullptr, std::vector<std::uint32_t>* taken = nullptr);
// Returns a cloud without points, of this layout.
PointCloud empty_cloud(const PointLayout& layout);
// Reserves room for n points in all.
void reserve_rows(const PointLayout& layout, std::size_t n, PointCloud& cloud);
bool is_within(const Bounds& box, const Vec3& p);

std::vector<std::byte> layout_bytes(const PointLayout& layout);
// Throws InvalidInput for other bytes.
PointLayout parse_layout(std::span<const std::byte> bytes);

}  // namespace rholm
