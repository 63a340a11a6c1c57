#include "studio/items/arrays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rholm/render.h"
#include "shape/topology/identical.h"

namespace rholm::studio {
namespace {

std::vector<std::uint8_t> bytes_of(const std::vector<std::array<float, 3>>& colors) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * colors.size());
  for (const auto& color : colors) {
    for (const float part : color) {
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0F, 1.0F))));
    }
  }
  return bytes;
}

}  // namespace

std::vector<Triangle> joined_triangles(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_identical(mesh.vertices);
  std::vector<Triangle> joined = mesh.faces;
  for (Triangle& t : joined) {
    for (std::uint32_t& corner : t) corner = first[corner];
  }
  return joined;
}

std::vector<float> normals_of(std::span<const float> positions, std::span<const Triangle> triangles,
                              std::span<const Triangle> joined) {
  std::vector<float> normals(positions.size(), 0.0F);
  for (const Triangle& t : joined) {
    const float* a = &positions[3 * std::size_t{t[0]}];
    const float* b = &positions[3 * std::size_t{t[1]}];
    const float* c = &positions[3 * std::size_t{t[2]}];
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const float v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
    for (const std::uint32_t corner : t) {
      float* sum = &normals[3 * std::size_t{corner}];
      for (int k = 0; k < 3; ++k) sum[k] += n[k];
    }
  }
  for (std::size_t i = 0; i < normals.size(); i += 3) {
    float* n = &normals[i];
    // In small units, squares of areas would underflow in single precision.
    const double length =
        std::sqrt(double{n[0]} * n[0] + double{n[1]} * n[1] + double{n[2]} * n[2]);
    const double factor = length > 0 ? 1 / length : 0;
    for (int k = 0; k < 3; ++k) n[k] = static_cast<float>(n[k] * factor);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = joined[t][k], to = triangles[t][k];
      if (from != to)
        std::copy_n(&normals[3 * std::size_t{from}], 3, &normals[3 * std::size_t{to}]);
    }
  }
  return normals;
}

std::vector<std::uint8_t> colors_of(const Mesh& mesh) { return bytes_of(vertex_colors(mesh)); }
std::vector<std::uint8_t> colors_of(const PointCloud& cloud) {
  return bytes_of(vertex_colors(cloud));
}

}  // namespace rholm::studio
