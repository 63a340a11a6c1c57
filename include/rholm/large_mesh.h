// Meshes larger than memory: what can be done with one where it lies in a file. Layer: io.
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

// Whether vertices have more than their coordinates.
bool has_attributes(const MappedMesh& mesh);

// Their names and types, without values.
std::vector<Attribute> described_attributes(const MappedMesh& mesh);
// What read_shape() would warn of: values that are not finite, with counts.
std::vector<std::string> attribute_warnings(const MappedMesh& mesh);

// Whether all faces are triangles: see MappedMesh::counts_are_three().
bool has_triangles_only(const MappedMesh& mesh, const Context& context = {});

// As MappedMesh::release(), of vertices.
void release_vertices(const MappedMesh& mesh, std::size_t first, std::size_t n);

// The mesh with its release() and release_vertices(): good as long as the mesh.
MeshInPlace in_place(const MappedMesh& mesh);

// As write_shape() of the mesh read, with the same bytes, and the mesh stays where it lies. Throws
// also InvalidInput for faces that are no triangles.
std::vector<std::string> write_shape(const MappedMesh& mesh, const std::filesystem::path& path,
                                     const ShapeWriteOptions& options = {},
                                     const Context& context = {});

// What convert_mesh() has written.
struct ConvertedMesh {
  std::vector<Attribute> attributes = {};  // of the mesh, without values
  std::vector<std::string> warnings = {};  // those of read_shape()
  std::vector<std::string> written = {};   // and those of write_shape()
};
// Writes the mesh of a binary PLY, of vertices and faces as map_mesh() takes them but with any
// number of corners, as write_shape() does what read_shape() has read, with the same bytes; and the
// mesh stays where it lies. None, and nothing is written, for all other files, and where something
// is wrong with faces: read_shape() reads it, or says what is wrong. Throws as write_shape().
std::optional<ConvertedMesh> convert_mesh(const std::filesystem::path& from,
                                          const std::filesystem::path& to,
                                          const ShapeWriteOptions& options = {},
                                          const Context& context = {});

// What can be told of a mesh without knowing which triangles are neighbours.
struct MeshSurvey {
  Bounds bounds;         // of all vertices
  double area = 0;       // of all triangles
  bool closed = false;   // every edge is run through as often one way as the other, by a hash that
                         // others pass once in 2^60: closed, and oriented
  double volume = 0;     // signed; meaningful if closed
  Vec3 volume_centroid;  // of the solid; likewise, and if the volume is not zero
};
// Reads the vertices once and the triangles a few times. Throws InvalidInput for coordinates that
// are not finite, indices out of range, and faces that are no triangles; Cancelled. Same bits for
// any number of threads.
MeshSurvey survey_mesh(const MappedMesh& mesh, const Context& context = {});

}  // namespace rholm
