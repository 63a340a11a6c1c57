// The header of a PLY file. Layer: io.
// Source: G. Turk, The PLY Polygon File Format (1994), and the type names of later writers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/shapes/shape_source.h"
#include "rholm/mesh.h"

namespace rholm {

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  // type of the value, or of a list's items
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;  // type of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  // as claimed, not yet checked
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  // byte at which the data begin
};

// Throws InvalidInput with the line.
PlyHeader parse_ply_header(const ShapeSource& source);

// Return the element of this name or nullptr, and the index of a property or kNoProperty.
const PlyElement* find_element(const PlyHeader& header, const char* name);
inline constexpr std::size_t kNoProperty = SIZE_MAX;
std::size_t find_property(const PlyElement& element, const std::string& name);

// Returns a warning about an element that is not read: "element 'edge' with 3 rows passed over".
std::string passed_over_warning(const PlyElement& element);

std::size_t size_of(ScalarType type);        // in bytes
const char* ply_type_name(ScalarType type);  // "uchar", "float", ...

}  // namespace rholm
