// Estimates the memory that reading a file takes before it is read. Layer: cli.
#pragma once

#include <cstddef>
#include <string>

#include "cli/options/memory_options.h"
#include "rholm/mesh.h"

namespace rholm::cli {

// The memory that reading a shape takes, and its size. Counts of text come from samples of lines.
struct ShapeMemory {
  double reading = 0;              // bytes at most while it is read, with those of the file
  double vertices = 0, faces = 0;  // faces are triangles, of which a polygon becomes several
  double attributes = 0;           // values of each vertex beside its position
  double kept() const {            // bytes of the shape
    return (sizeof(Vec3) + sizeof(double) * attributes) * vertices + sizeof(Triangle) * faces;
  }
};

// All zero for what is no regular file, and for files of coefficients.
ShapeMemory memory_to_read(const std::string& path);

// Bytes at most while a command works on a mesh, for each of its vertices and of its faces, the
// mesh itself counted in, and bytes that every mesh takes.
struct MemoryOfMesh {
  double vertex = 0, face = 0, any = 0;
  double of(std::size_t vertices, std::size_t faces) const {
    return any + vertex * static_cast<double>(vertices) + face * static_cast<double>(faces);
  }
  double of(const ShapeMemory& shape) const {
    if (shape.vertices == 0) return 0;
    return any + (vertex + sizeof(double) * shape.attributes) * shape.vertices + face * shape.faces;
  }
};

// Throws OutOfMemory, before it is read, if reading a shape, or the work on it that follows, needs
// more than was said with --max-memory. Streams and files of coefficients are let pass.
void require_to_read(const std::string& path, const MemoryOptions& memory,
                     const MemoryOfMesh& work = {});

}  // namespace rholm::cli
