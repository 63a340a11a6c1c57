// Lumps that the parts of a mesh have in common.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "base/aligned_array.h"
#include "base/bytes.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// For parts whose vertices lie among those of others: whoever works one of them borrows lumps of
// all vertices that nobody else adds to. Sums of lumps are exact: it is all the same to whose a
// part was added.
template <typename L>
class CommonLumps {
 public:
  // lumps_per_vertex() of each of n vertices.
  CommonLumps(std::size_t n_vertices, std::size_t per_vertex)
      : n_vertices_(n_vertices), per_vertex_(per_vertex) {}

  // So many may be borrowed at a time: two, or as many as take a gigabyte.
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

  // When all have been given back: the sums of n vertices from `first` on. To be called once for
  // each vertex, before lumps() and write().
  const VertexLump<L>* add_up(std::size_t first, std::size_t n);
  const VertexLump<L>* lumps(std::size_t first) const {
    return arrays_.front().data() + per_vertex_ * first;
  }

  // The sums as bytes; and to lumps that are borrowed for it what another process wrote. Throws Io
  // for bytes that are no lumps of as many vertices.
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
