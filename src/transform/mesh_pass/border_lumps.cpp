#include "transform/mesh_pass/border_lumps.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace rholm {
namespace {

constexpr std::size_t kRoom = std::size_t{1} << 20;  // vertices, some 20 MB

}  // namespace

template <typename L>
void BorderSums<L>::add(const BorderLumps<L>& part) {
  sums_.vertices.insert(sums_.vertices.end(), part.vertices.begin(), part.vertices.end());
  sums_.lumps.insert(sums_.lumps.end(), part.lumps.begin(), part.lumps.end());
  if (sums_.vertices.size() > 2 * combined_ + kRoom) combine();
}

template <typename L>
void BorderSums<L>::combine() {
  // The place of each vertex is sorted together with its number: this is faster than sorting
  // places.
  const std::size_t n = sums_.vertices.size();
  std::vector<std::uint64_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = std::uint64_t{sums_.vertices[i]} << 32 | i;
  std::sort(order.begin(), order.end());
  BorderLumps<L> sums{.per_vertex = sums_.per_vertex, .vertices = {}, .lumps = {}};
  sums.vertices.reserve(n);
  sums.lumps.reserve(n * sums_.per_vertex);
  for (const std::uint64_t one : order) {
    const auto vertex = static_cast<std::uint32_t>(one >> 32);
    const VertexLump<L>* lump =
        sums_.lumps.data() + static_cast<std::uint32_t>(one) * sums_.per_vertex;
    if (sums.vertices.empty() || sums.vertices.back() != vertex) {
      sums.add(vertex, lump);
    } else {
      add_lumps(lump, sums_.per_vertex,
                &*(sums.lumps.end() - static_cast<std::ptrdiff_t>(sums_.per_vertex)));
    }
  }
  sums_ = std::move(sums);
  combined_ = sums_.vertices.size();
}

template <typename L>
BorderLumps<L> BorderSums<L>::take(const std::function<bool(std::uint32_t vertex)>& is_done) {
  combine();
  BorderLumps<L> done{.per_vertex = sums_.per_vertex, .vertices = {}, .lumps = {}}, left = done;
  for (std::size_t i = 0; i < sums_.vertices.size(); ++i) {
    const std::uint32_t vertex = sums_.vertices[i];
    (is_done(vertex) ? done : left).add(vertex, sums_.lumps.data() + i * sums_.per_vertex);
  }
  sums_ = std::move(left);
  combined_ = sums_.vertices.size();
  return done;
}

template <typename L>
const BorderLumps<L>& BorderSums<L>::finish() {
  combine();
  return sums_;
}

template class BorderSums<std::int32_t>;
template class BorderSums<double>;

}  // namespace rholm
