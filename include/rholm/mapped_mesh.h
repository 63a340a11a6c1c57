// The mesh of a binary PLY file where it lies in the file. Layer: io.
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

// A scalar of every vertex beside its coordinates: that of vertex i lies at first + i * stride.
struct MappedScalar {
  std::string name = {};                   // as in the file
  ScalarType type = ScalarType::kFloat32;  // in the machine's own byte order
  const std::byte* first = nullptr;        // that of vertex 0
  std::size_t stride = 0;                  // bytes from one to the next
};

struct MappedRows;

// A memory map of a file, for reading. Nothing of it is in memory before it is used, and the system
// may drop what has been.
//
// A file that another program makes shorter while it is mapped raises SIGBUS in whoever reads the
// missing part; the library cannot turn this into an exception. A program that must not die of it
// handles the signal, or reads the file with read_shape().
class MappedMesh {
 public:
  // The two exchange what they hold: a new one leaves nothing to the other.
  MappedMesh(MappedMesh&& other) noexcept { *this = std::move(other); }
  MappedMesh& operator=(MappedMesh&& other) noexcept;
  MappedMesh(const MappedMesh&) = delete;
  MappedMesh& operator=(const MappedMesh&) = delete;
  ~MappedMesh();

  // Vertices and faces as they lie; not checked: neither that coordinates are finite nor that
  // indices are in range. Good as long as this object.
  const MeshView& view() const { return view_; }

  // Attributes of the vertices, in the order of the file.
  const std::vector<MappedScalar>& scalars() const { return scalars_; }

  // Whether each of n faces from `first` on is a triangle; what the view shows of others has no
  // meaning, and the file must be read with read_shape(). Meant for blocks of faces that are in the
  // cache anyway: some 0.5 ns each.
  bool counts_are_three(std::size_t first, std::size_t n) const;

  // Takes the pages of these faces out of the program's memory; they come back when they are used
  // again. With one call behind each block of a pass, a file larger than the memory is no burden.
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

// Maps a PLY file in the machine's own byte order that holds vertices with x, y, z side by side,
// all float or all double, with or without further scalars, and then faces as lists of 32-bit
// indices with a length of one byte, no other properties, all of three corners as far as the file's
// size tells, and no more. None for every other file, or none at all: read_shape() reads it, or
// says what is wrong. Throws InvalidInput for a PLY file with a malformed header.
std::optional<MappedMesh> map_mesh(const std::filesystem::path& path, const Context& context = {});

}  // namespace rholm
