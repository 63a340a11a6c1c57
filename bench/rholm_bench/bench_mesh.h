// The meshes that the benchmark brings with it.
#pragma once

#include <filesystem>
#include <string>

#include "rholm/mesh.h"

namespace rholm::cli {

// A smooth star-shaped body around the origin with 12 n^2 triangles, about as many as wanted: the
// faces of a cube, row by row, as shape models come that are made from pictures. Coordinates are
// floats.
Mesh smooth_mesh(int triangles);

// The same triangles in random order, always the same.
void shuffle(Mesh& mesh);

// A binary PLY file, of floats if those hold the coordinates, without a name: it is gone with this
// object or the program, whatever ends it.
class TemporaryMesh {
 public:
  // In an existing folder. Throws Io, Cancelled.
  TemporaryMesh(const Mesh& mesh, const std::filesystem::path& folder);
  ~TemporaryMesh();
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;
  std::filesystem::path path() const;  // opens it while it is there

 private:
  explicit TemporaryMesh(const std::filesystem::path& folder);
  void write(const std::string& bytes) const;
  std::filesystem::path folder_;
  int descriptor_ = -1;
};

}  // namespace rholm::cli
