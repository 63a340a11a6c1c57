// Triangle meshes and point clouds. Layer: shape.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// Type of a scalar in its file; kept so that a writer can restore it.
enum class ScalarType : std::uint8_t {
  kInt8,     // -2^7 ... 2^7 - 1
  kUint8,    // 0 ... 2^8 - 1
  kInt16,    // -2^15 ... 2^15 - 1
  kUint16,   // 0 ... 2^16 - 1
  kInt32,    // -2^31 ... 2^31 - 1
  kUint32,   // 0 ... 2^32 - 1
  kFloat32,  // IEEE 754 single
  kFloat64   // IEEE 754 double
};

// One named scalar per vertex or point: "red", "nx", "quality", ... Colours are red, green, blue
// (and alpha), normals nx, ny, nz, texture coordinates u, v, as in PLY files. Every type above
// is exact in a double.
struct Attribute {
  std::string name = {};                   // any name except the coordinates'
  ScalarType type = ScalarType::kFloat32;  // in its file, and in files written
  std::vector<double> values = {};         // one per vertex or point
};

using Triangle = std::array<std::uint32_t, 3>;  // vertex indices, counter-clockwise from outside

// Triangles that share vertices.
struct Mesh {
  std::vector<Vec3> vertices = {};         // in any unit
  std::vector<Triangle> faces = {};        // vertex indices
  std::vector<Attribute> attributes = {};  // per vertex, each with vertices.size() values
};

// Points without faces.
struct PointCloud {
  std::vector<Vec3> points = {};   // in any unit
  std::vector<Vec3> normals = {};  // empty, or one per point (as in the file, not normalised)
  std::vector<Attribute> attributes = {};  // per point, without the normals
};

// Returns the attribute of that name, or nullptr.
const Attribute* find_attribute(const std::vector<Attribute>& attributes, const std::string& name);
// Appends an attribute, and removes an existing one with the same name.
void set_attribute(std::vector<Attribute>& attributes, Attribute attribute);

// Throws InvalidInput unless every coordinate is finite, every index is below the number of
// vertices and every attribute has one value per vertex. An empty mesh is valid.
void validate(const Mesh& mesh);
void validate(const PointCloud& cloud);

}  // namespace rholm
