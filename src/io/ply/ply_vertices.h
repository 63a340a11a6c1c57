// The destination of the values of PLY vertices. Layer: io.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/ply/ply_header.h"
#include "rholm/mesh.h"

namespace rholm {

// Collects vertices in blocks of rows. A reader writes the values of a block into the slots of its
// properties; then the block is checked and appended. (Appending blocks from the cache avoids
// clearing the large arrays first.)
class PlyVertices {
 public:
  // A destination for a property: row i goes to first[i * stride]; nullptr means not wanted.
  struct Slot {
    double* first = nullptr;
    std::size_t stride = 1;
  };

  // `points`: normals belong to points, not to attributes. Throws InvalidInput without x, y, z.
  PlyVertices(const ShapeSource& source, const PlyElement& element, bool points);

  std::size_t block_rows() const { return block_rows_; }
  const std::vector<Slot>& slots() const { return slots_; }  // one per property of the element
  void reserve(std::size_t rows);
  // Throws InvalidInput if a position of a mesh is not finite.
  void append_block(std::size_t rows);

  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Attribute> attributes;
  std::vector<std::string> warnings;

 private:
  bool claim_vector(const PlyElement& element, const char* const (&names)[3],
                    std::vector<Vec3>& block);

  const ShapeSource& source_;
  bool points_;
  std::size_t block_rows_;
  std::vector<Slot> slots_;
  std::vector<Vec3> position_block_;
  std::vector<Vec3> normal_block_;
  std::vector<std::vector<double>> attribute_blocks_;
};

}  // namespace rholm
