// Arrays in the format of the pages of web/: "RHOLM1\0\0", a length (u32), JSON of this length,
// the arrays, little-endian, each at a multiple of 8 bytes from the beginning. The JSON is
// {"arrays": [{"name", "type": "f32" | "f64" | "u32" | "u8", "shape": [...], "offset"}],
// "meta": further data}.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm {

class NamedArrays {
 public:
  using Shape = std::initializer_list<std::size_t>;
  // Adds an array of this shape, row by row. The name must be printable, without quotes.
  void add(const char* name, std::span<const double> values, Shape shape);
  void add(const char* name, std::span<const float> values, Shape shape);
  void add(const char* name, std::span<const std::uint32_t> values, Shape shape);
  void add(const char* name, std::span<const std::uint8_t> values, Shape shape);

  // Returns all bytes. `meta` is JSON.
  std::string bytes(std::string_view meta) const;

 private:
  void add_bytes(const char* name, const char* type, std::span<const std::byte> bytes, Shape shape);

  struct Part {
    std::string about;  // JSON without the offset and the end
    std::string bytes;
  };
  std::vector<Part> parts_;
};

std::vector<float> floats_of(std::span<const Vec3> points);                  // flat array [n][3]
std::vector<std::uint32_t> indices_of(std::span<const Triangle> triangles);  // flat array [m][3]

}  // namespace rholm
