// The mesh of a binary PLY file, mapped into memory instead of read. Layer: io.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

// A scalar per vertex besides the coordinates: vertex i has it at first + i * stride.
struct MappedScalar {
  std::string name = {};                   // as in the file
  ScalarType type = ScalarType::kFloat32;  // in the machine's own byte order
  const std::byte* first = nullptr;        // address of the scalar of vertex 0
  std::size_t stride = 0;                  // bytes between consecutive vertices
};

struct MappedRows;

// A read-only memory map of a file. Pages are loaded when they are used, and the system may drop
// them again.
//
// If another program truncates the file while it is mapped, reading the missing part raises SIGBUS.
// The library cannot turn this signal into an exception. A program that must survive it handles the
// signal, or reads the file with read_shape().
class MappedMesh {
 public:
  // A move exchanges the contents: an object that is new leaves the other one empty.
  MappedMesh(MappedMesh&& other) noexcept { *this = std::move(other); }
  MappedMesh& operator=(MappedMesh&& other) noexcept;
  MappedMesh(const MappedMesh&) = delete;
  MappedMesh& operator=(const MappedMesh&) = delete;
  ~MappedMesh();

  // Returns vertices and faces as stored in the file. Coordinates may be infinite or NaN and
  // indices out of range: nothing is checked. Valid as long as this object.
  const MeshView& view() const { return view_; }

  // Returns the attributes of the vertices, in the order of the file.
  const std::vector<MappedScalar>& scalars() const { return scalars_; }

  // Returns true if each of n faces from `first` on has three corners. Otherwise the view's faces
  // have no meaning, and the file must be read with read_shape(). Meant for blocks of faces already
  // in the processor's cache: about 0.5 ns per face.
  bool counts_are_three(std::size_t first, std::size_t n) const;

  // Removes the pages of these faces from the program's memory; using them loads them again. Called
  // after each block of a pass, it lets a pass over a file larger than memory succeed.
  void release(std::size_t first, std::size_t n) const;

 private:
  friend std::optional<MappedRows> map_rows(const std::filesystem::path&, const Context&);
  friend std::optional<MappedMesh> map_mesh(const std::filesystem::path&, const Context&);
  MappedMesh(void* map, std::size_t size) : map_(map), size_(size) {}

  void* map_ = nullptr;
  std::size_t size_ = 0;
  MeshView view_;
  std::vector<MappedScalar> scalars_;
};

// Maps a PLY file in the machine's own byte order. Vertices have x, y, z side by side, all float or
// all double, and may have further scalars. Faces follow as lists of 32-bit indices with a one-byte
// length, without other properties; the file's size must match three corners per face, and nothing
// follows. Returns nothing for other files: read_shape() reads them or states the error. Throws
// InvalidInput for a PLY file with a malformed header.
std::optional<MappedMesh> map_mesh(const std::filesystem::path& path, const Context& context = {});

}  // namespace rholm
