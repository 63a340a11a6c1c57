// Gives access to the normals of a mesh's vertices, the attributes nx, ny, nz. Layer: shape.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Points to the values of the three attributes. It stays valid when the list of attributes moves.
struct NormalAttributes {
  std::array<std::vector<double>*, 3> axes{};

  // Returns true if all three attributes exist; the other functions require this.
  explicit operator bool() const { return axes[0] && axes[1] && axes[2]; }
  Vec3 operator[](std::size_t v) const { return {(*axes[0])[v], (*axes[1])[v], (*axes[2])[v]}; }
  void set(std::size_t v, const Vec3& normal) const {
    (*axes[0])[v] = normal.x, (*axes[1])[v] = normal.y, (*axes[2])[v] = normal.z;
  }
};

inline NormalAttributes normal_attributes(Mesh& mesh) {
  NormalAttributes normals;
  for (Attribute& attribute : mesh.attributes) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (attribute.name == std::string{'n', "xyz"[k]}) normals.axes[k] = &attribute.values;
    }
  }
  return normals;
}

}  // namespace rholm
