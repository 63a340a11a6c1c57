// Copies a part of a mesh to a mesh of its own. Layer: surface.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

struct MeshPiece {
  Mesh mesh;                                   // a mesh without attributes
  std::vector<std::uint32_t> vertices, faces;  // indices in the whole mesh, ascending
};

// Decides which positions piece_around() includes.
class NearPlaces {
 public:
  NearPlaces(std::span<const Vec3> centers, double reach);
  bool has(const Vec3& place) const;

 private:
  // Most positions lie in no cube; one bit of their key's hash usually shows this.
  static constexpr int kFilterBits = 16;
  static std::size_t filter_of(std::uint64_t key) {
    return (key * 0x9E3779B97F4A7C15u) >> (64 - kFilterBits);
  }
  std::bitset<std::size_t{1} << kFilterBits> filter_;
  std::unordered_set<std::uint64_t> cubes_;
  double reach_;
};

// Returns all triangles within `reach` of the vertices `centers`, and some others.
MeshPiece piece_around(const Mesh& mesh, const std::vector<std::uint32_t>& centers, double reach,
                       const Context& context);

}  // namespace rholm
