// A mesh in a mapped binary PLY whose faces have any number of corners. Layer: io, private.
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
  // Returns the vertices, without triangles.
  const MappedMesh& vertices() const { return vertices_; }
  std::size_t n_triangles() const { return n_triangles_; }
  std::size_t skipped() const { return skipped_; }  // faces with fewer than three corners

  // Calls visit for the triangles of all faces, as FaceList makes them; releases visited faces.
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

// Maps a file as map_mesh() does, but with any number of corners per face. Checks all faces, and
// returns nothing if a face is invalid.
std::optional<MappedPolygons> map_polygons(const std::filesystem::path& path,
                                           const Context& context);

}  // namespace rholm
