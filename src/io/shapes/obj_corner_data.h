// Normals and texture coordinates of OBJ corners, brought to the vertices. Layer: io.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

// What the corners of faces say of their vertices: an index of a normal, or of a texture
// coordinate, for each. Kept as long as no vertex has two different ones.
class CornerData {
 public:
  // `values` are those defined so far, numbered like `index`.
  template <class Value>
  void assign(std::uint32_t vertex, std::uint32_t index, std::size_t n_vertices,
              const std::vector<Value>& values) {
    if (vertex >= n_vertices) {
      ahead_.push_back({vertex, index});  // a face before its vertices
      return;
    }
    if (index_.size() <= vertex) index_.resize(n_vertices, kNone);
    if (index_[vertex] == kNone) {
      index_[vertex] = index;
    } else if (index_[vertex] != index) {
      const std::size_t last = std::max(index_[vertex], index);
      if (last >= values.size() || values[index_[vertex]] != values[index]) conflict_ = true;
    }
  }

  // One value per vertex, if every vertex of a triangle has exactly one (others get zeros).
  template <class Value>
  std::vector<Value> values_of(const Mesh& mesh, const std::vector<Value>& values) {
    const std::size_t n = mesh.vertices.size();
    for (const auto& [vertex, index] : std::exchange(ahead_, {})) assign(vertex, index, n, values);
    index_.resize(n, kNone);
    const auto has_none = [&](std::uint32_t corner) { return index_[corner] == kNone; };
    for (const Triangle& t : mesh.triangles) {
      if (std::any_of(t.begin(), t.end(), has_none)) conflict_ = true;
    }
    std::vector<Value> result;
    if (conflict_) return result;
    result.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (index_[i] != kNone) result[i] = values[index_[i]];
    }
    return result;
  }
  bool used() const { return !index_.empty() || !ahead_.empty(); }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Assignment {
    std::uint32_t vertex;
    std::uint32_t index;
  };
  std::vector<std::uint32_t> index_;
  std::vector<Assignment> ahead_;
  bool conflict_ = false;
};

}  // namespace rholm
