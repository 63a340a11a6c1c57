// The benchmark's own meshes.
#pragma once

#include <filesystem>
#include <string>

#include "rholm/mesh.h"

namespace rholm::cli {

// Returns a smooth body, star-shaped about the origin, with 12 n^2 triangles, near the given
// number. The faces of a cube are listed row by row, like shape models that are made from pictures.
// Coordinates have single precision.
Mesh smooth_mesh(int triangles);

// Puts the triangles into a random order, which is always the same.
void shuffle(Mesh& mesh);

// A temporary binary PLY file without a name, of floats if they hold the coordinates. The file is
// removed with this object, or when the program ends in any way.
class TemporaryMesh {
 public:
  // Makes the file in an existing folder. Throws Io, Cancelled.
  TemporaryMesh(const Mesh& mesh, const std::filesystem::path& folder);
  ~TemporaryMesh();
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;
  std::filesystem::path path() const;  // valid while the object exists

 private:
  explicit TemporaryMesh(const std::filesystem::path& folder);
  void write(const std::string& bytes) const;
  std::filesystem::path folder_;
  int descriptor_ = -1;
};

}  // namespace rholm::cli
