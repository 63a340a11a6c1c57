#include "transform/mesh_pass/common_lumps.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace rholm {

template <typename L>
std::size_t CommonLumps<L>::most_borrowed() const {
  constexpr std::size_t kBytes = std::size_t{1} << 30;
  const std::size_t each = std::max<std::size_t>(1, n_vertices_ * per_vertex_ * sizeof(L) * 4);
  return std::max<std::size_t>(2, kBytes / each);
}

// Returns the array that was given back last: it is still in the cache.
template <typename L>
VertexLump<L>* CommonLumps<L>::borrow() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) {
    arrays_.push_back(AlignedArray<VertexLump<L>>::zeros(n_vertices_ * per_vertex_));
    free_.reserve(arrays_.size());  // giving back must not fail
    return arrays_.back().data();
  }
  VertexLump<L>* const lumps = free_.back();
  free_.pop_back();
  return lumps;
}

template <typename L>
void CommonLumps<L>::give_back(VertexLump<L>* lumps) {
  const std::lock_guard lock(mutex_);
  free_.push_back(lumps);
}

template <typename L>
const VertexLump<L>* CommonLumps<L>::add_up(std::size_t first, std::size_t n) {
  VertexLump<L>* const sums = arrays_.front().data() + per_vertex_ * first;
  for (std::size_t k = 1; k < arrays_.size(); ++k) {
    add_lumps(arrays_[k].data() + per_vertex_ * first, per_vertex_ * n, sums);
  }
  return sums;
}

namespace {

// Vertices in a run; a run without lumps is left out, because a part has only some of the runs.
constexpr std::size_t kWritten = 64;

}  // namespace

template <typename L>
void CommonLumps<L>::write(ByteWriter& writer) const {
  const std::span<const VertexLump<L>> all(arrays_.front().data(), n_vertices_ * per_vertex_);
  write_sparse(writer, all, kWritten * per_vertex_, [](const VertexLump<L>& lump) {
    return lump.value[0] == 0 && lump.value[1] == 0 && lump.value[2] == 0 && lump.value[3] == 0;
  });
}

template <typename L>
void CommonLumps<L>::add_written(ByteReader& reader) {
  const Loan loan(*this);
  read_sparse<VertexLump<L>>(reader, n_vertices_ * per_vertex_, kWritten * per_vertex_,
                             [&](std::size_t first, std::span<const VertexLump<L>> row) {
                               add_lumps(row.data(), row.size(), loan.lumps() + first);
                             });
}

template class CommonLumps<std::int32_t>;
template class CommonLumps<double>;

}  // namespace rholm
