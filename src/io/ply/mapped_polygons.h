// A mesh in a binary PLY whose faces have any number of corners, where it lies. Layer: io, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "rholm/context.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"

namespace rholm {

class MappedPolygons {
 public:
  // Vertices, and no triangles.
  const MappedMesh& vertices() const { return vertices_; }
  std::size_t n_triangles() const { return n_triangles_; }
  std::size_t skipped() const { return skipped_; }  // faces with fewer than three corners

  // The triangles of all faces, as FaceList has them; what was visited is released.
  void visit(const std::function<void(const Triangle&)>& visit) const;

 private:
  friend std::optional<MappedPolygons> map_polygons(const std::filesystem::path&, const Context&);
  MappedPolygons(MappedMesh vertices, std::uint64_t n_faces)
      : vertices_(std::move(vertices)), n_faces_(n_faces) {}
  bool survey(std::size_t bytes);

  MappedMesh vertices_;
  std::uint64_t n_faces_;
  std::size_t n_triangles_ = 0, skipped_ = 0;
};

// As map_mesh(), of faces with any number of corners; all of them are looked at, and a file with
// anything wrong in its faces is none.
std::optional<MappedPolygons> map_polygons(const std::filesystem::path& path,
                                           const Context& context);

}  // namespace rholm
