// Lumps that all parts of a mesh have in common.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "base/aligned_array.h"
#include "base/bytes.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// For parts whose vertices lie among the vertices of other parts. A thread that computes a part
// borrows an array of lumps of all vertices, to which nobody else adds. Sums of lumps are exact: it
// does not matter to which array a part was added.
template <typename L>
class CommonLumps {
 public:
  // Has `per_vertex` = lumps_per_vertex() lumps for each of n vertices.
  CommonLumps(std::size_t n_vertices, std::size_t per_vertex)
      : n_vertices_(n_vertices), per_vertex_(per_vertex) {}

  // Returns how many arrays may be borrowed at a time: two, or the number that takes a gigabyte.
  std::size_t most_borrowed() const;

  class Loan {
   public:
    explicit Loan(CommonLumps& from) : from_(from), lumps_(from.borrow()) {}
    ~Loan() { from_.give_back(lumps_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    VertexLump<L>* lumps() const { return lumps_; }

   private:
    CommonLumps& from_;
    VertexLump<L>* lumps_;
  };

  // Returns the sums of n vertices from `first` on, after all arrays have been given back. Called
  // once for each vertex, before lumps() and write().
  const VertexLump<L>* add_up(std::size_t first, std::size_t n);
  const VertexLump<L>* lumps(std::size_t first) const {
    return arrays_.front().data() + per_vertex_ * first;
  }

  // write() writes the sums as bytes; add_written() adds what another process wrote, to borrowed
  // lumps. Throws Io for bytes that are not lumps of the same number of vertices.
  void write(ByteWriter& writer) const;
  void add_written(ByteReader& reader);

 private:
  VertexLump<L>* borrow();
  void give_back(VertexLump<L>* lumps);

  std::size_t n_vertices_, per_vertex_;
  std::mutex mutex_;
  std::vector<AlignedArray<VertexLump<L>>> arrays_;
  std::vector<VertexLump<L>*> free_;
};

}  // namespace rholm
