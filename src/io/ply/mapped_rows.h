// The rows of a mapped binary PLY of a mesh. Layer: io, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "rholm/context.h"
#include "rholm/mapped_mesh.h"

namespace rholm {

inline constexpr std::size_t kFaceBytes = 1 + 3 * 4;  // a triangle: its length and three indices

// The result of mapping before the numbers of corners are known: the view has no triangles, but
// points to where the first triangle would be.
struct MappedRows {
  MappedMesh mesh;
  std::uint64_t n_faces = 0;
  std::size_t face_bytes = 0;  // all faces, to the end of the file
};
std::optional<MappedRows> map_rows(const std::filesystem::path& path, const Context& context);

}  // namespace rholm
