// Operations on meshes larger than memory, in a mapped file. Layer: io.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/mapped_mesh.h"
#include "rholm/shape_io.h"
#include "rholm/topology.h"

namespace rholm {

// Returns true if vertices have more than their coordinates.
bool has_attributes(const MappedMesh& mesh);

// Returns names and types of the attributes, without values.
std::vector<Attribute> described_attributes(const MappedMesh& mesh);
// Returns the warnings that read_shape() would give: counts of values that are not finite.
std::vector<std::string> attribute_warnings(const MappedMesh& mesh);

// Returns true if all faces have three corners: see MappedMesh::counts_are_three().
bool has_triangles_only(const MappedMesh& mesh, const Context& context = {});

// Does for vertices what MappedMesh::release() does for faces.
void release_vertices(const MappedMesh& mesh, std::size_t first, std::size_t n);

// Returns the mesh with its release() and release_vertices(); valid as long as `mesh`.
MeshInPlace in_place(const MappedMesh& mesh);

// Writes the same bytes as write_shape() for the mesh that read_shape() returns, without reading it
// into memory. Throws in addition InvalidInput for faces with other than three corners.
std::vector<std::string> write_shape(const MappedMesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});

// Metadata and messages of convert_mesh().
struct ConvertedMesh {
  std::vector<Attribute> attributes = {};  // attributes of the mesh, without values
  std::vector<std::string> warnings = {};  // warnings of read_shape()
  std::vector<std::string> written = {};   // warnings of write_shape()
};
// Converts the mesh of a binary PLY without reading it into memory. It writes the same bytes as
// read_shape() with write_shape(). Vertices and faces are stored as for map_mesh(), but faces may
// have any number of corners. Returns nothing and writes nothing for other files or wrong faces:
// use read_shape(), which may report the error. Throws as write_shape().
std::optional<ConvertedMesh> convert_mesh(const std::filesystem::path& from,
                                          const std::filesystem::path& to,
                                          const ShapeWriteOptions& options = {},
                                          const Context& context = {});

// Properties of a mesh that need no adjacency of faces.
struct MeshSurvey {
  Bounds bounds;         // bounding box of all vertices
  double area = 0;       // sum over all faces
  bool closed = false;   // every edge is used equally often in both directions, by a hash with
                         // false positives at 2^-60: closed and oriented
  double volume = 0;     // signed; meaningful if closed
  Vec3 volume_centroid;  // centroid of the solid; meaningful if closed and with volume
};
// Reads the vertices once and the faces a few times. Throws InvalidInput for coordinates that are
// not finite, indices out of range, and faces with other than three corners; Cancelled. Same bits
// for any number of threads.
MeshSurvey survey_mesh(const MappedMesh& mesh, const Context& context = {});

}  // namespace rholm
