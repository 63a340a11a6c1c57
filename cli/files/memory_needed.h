// What of memory reading a file takes, known before it is read. Layer: cli.
#pragma once

#include <cstddef>
#include <string>

#include "cli/options/memory_options.h"

namespace rholm::cli {

// Throws OutOfMemory, before it is read, if a shape needs more than was said with --max-memory.
// Streams and files of coefficients are let pass.
void require_to_read(const std::string& path, const MemoryOptions& memory);

// Bytes at most while a shape is read whole, about: what its file has, what becomes of it, and
// arrays that grow. From the size of the file and, of text, from a few samples of its lines. 0 for
// what is no regular file.
double memory_to_read(const std::string& path);

// The same of all that a command does with a mesh, for each of its vertices and of its faces, the
// mesh itself counted in.
struct MemoryOfMesh {
  double vertex = 0, face = 0;
  double of(std::size_t vertices, std::size_t faces) const {
    return vertex * static_cast<double>(vertices) + face * static_cast<double>(faces);
  }
};

}  // namespace rholm::cli
