// Estimates the memory for reading a file, before it is read. Layer: cli.
#pragma once

#include <cstddef>
#include <string>

#include "cli/options/memory_options.h"
#include "rholm/mesh.h"

namespace rholm::cli {

// Memory for reading a shape, and its size. Counts in text files come from samples of lines.
struct ShapeMemory {
  double reading = 0;              // largest number of bytes while it is read, file included
  double vertices = 0, faces = 0;  // faces are triangles; a polygon gives several
  double attributes = 0;           // number of values per vertex besides its position
  double kept() const {            // size of the shape in bytes
    return (sizeof(Vec3) + sizeof(double) * attributes) * vertices + sizeof(Triangle) * faces;
  }
};

// Returns zeros for files that are not regular, and for files of coefficients.
ShapeMemory memory_to_read(const std::string& path);

// Largest number of bytes while a command works on a mesh: per vertex, per face, and constant. The
// mesh itself is included.
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

// Throws OutOfMemory before reading if a shape, or the work on it, needs more than --max-memory.
// Accepts streams and files of coefficients.
void require_to_read(const std::string& path, const MemoryOptions& memory,
                     const MemoryOfMesh& work = {});

}  // namespace rholm::cli
