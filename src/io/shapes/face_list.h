// Collects faces: triangles at once, polygons when all vertices are known. Layer: io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// Returns the warning for this number of skipped faces.
std::string skipped_warning(std::size_t faces);

class FaceList {
 public:
  void reserve(std::size_t faces) { triangles_.reserve(faces); }
  void add_triangle(const Triangle& triangle) { triangles_.push_back(triangle); }
  void add_triangles(std::span<const Triangle> triangles) {
    triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  }
  // Adds a face with any number of corners. Corners of polygons that are equal to the corner before
  // are dropped; faces with fewer than three corners are skipped and counted.
  void add(std::span<const std::uint32_t> corners);

  // Returns the triangles of all faces in the order of the calls; to be called once. All corners
  // must be below vertices.size(). Adds a warning if faces were skipped.
  std::vector<Triangle> finish(const std::vector<Vec3>& vertices,
                               std::vector<std::string>& warnings);

 private:
  struct Polygon {
    std::size_t place = 0;  // number of triangles before it in `triangles_`
    std::size_t end = 0;    // index after its last corner in `corners_`
  };
  void add_polygon(std::span<const std::uint32_t> corners);

  std::vector<Triangle> triangles_;
  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> corners_;  // corners of the polygons
  std::size_t skipped_ = 0;
};

}  // namespace rholm
