#include "transform/mesh_pass/scatter.h"

#include <hwy/cache_control.h>

#include <bit>
#include <cstring>
#include <type_traits>

namespace rholm {
namespace {

// Sums beyond 32 bits wrap around, which the pass detects.
template <typename T>
void add_lump(const T* lump, T* sum) {
  using Unit = std::conditional_t<sizeof(T) == 4, std::uint32_t, double>;
  using Four [[gnu::vector_size(4 * sizeof(T))]] = Unit;
  Four a, b;
  std::memcpy(&a, sum, sizeof a);
  std::memcpy(&b, lump, sizeof b);
  a += b;
  std::memcpy(sum, &a, sizeof a);
}

template <bool kHessians, typename T>
void add_triangle(const std::byte* record, const TriangleBlock<T>& block, std::size_t t,
                  VertexLump<T>* vertices, std::uint32_t first_vertex) {
  const std::size_t slot = lump_slot<T>(t);
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t corner;
    std::memcpy(&corner, record + 4 * i, sizeof corner);
    VertexLump<T>* vertex = vertices + lumps_per_vertex(kHessians) * (corner - first_vertex);
    add_lump(block.lump[i][slot].value, vertex[0].value);
    if constexpr (kHessians) {
      add_lump(block.hessian[0][i][slot].value, vertex[1].value);
      add_lump(block.hessian[1][i][slot].value, vertex[2].value);
    }
  }
}

template <bool kHessians, typename T>
void scatter(const std::byte* record, std::size_t stride, std::size_t n,
             const TriangleBlock<T>& block, VertexLump<T>* vertices, std::uint32_t first_vertex) {
  for (std::size_t at = 0; at < n; at += 8, record += 8 * stride) {
    std::uint64_t flags;
    std::memcpy(&flags, block.flag + at, sizeof flags);
    if (at + 8 <= n && flags == 0) {
      for (std::size_t odd = 0; odd < 2; ++odd) {
        const std::byte* one = record + odd * stride;
#pragma GCC unroll 4
        for (std::size_t t = odd; t < 8; t += 2, one += 2 * stride) {
          add_triangle<kHessians>(one, block, at + t, vertices, first_vertex);
        }
      }
      continue;
    }
    for (std::size_t t = 0; t < 8 && at + t < n; ++t) {
      if ((block.flag[at + t] & kNodes) == 0) {
        add_triangle<kHessians>(record + t * stride, block, at + t, vertices, first_vertex);
      }
    }
  }
}

}  // namespace

template <typename T>
void scatter_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const TriangleBlock<T>& block, VertexLump<T>* vertices) {
  const auto [record, stride, first] = places;
  if (hessians) return scatter<true>(record, stride, n, block, vertices, first);
  scatter<false>(record, stride, n, block, vertices, first);
}

template <typename T>
void ask_for_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const VertexLump<T>* vertices) {
  const std::byte* record = places.record;
  for (std::size_t t = 0; t < n; ++t, record += places.stride) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t corner;
      std::memcpy(&corner, record + 4 * i, sizeof corner);
      hwy::Prefetch(vertices + lumps_per_vertex(hessians) * (corner - places.first));
    }
  }
}

template <typename T>
void link_fans(const CornerPlaces& places, std::size_t n, const TriangleBlock<T>& block,
               std::uint32_t* fans) {
  const std::byte* record = places.record;
  for (std::size_t t = 0; t < n; ++t, record += places.stride) {
    std::uint32_t corner[3];
    std::memcpy(corner, record, sizeof corner);
    const std::uint32_t name[3] = {block.hash[0][t], block.hash[1][t], block.hash[2][t]};
    fans[corner[0] - places.first] += name[1] - name[2];
    fans[corner[1] - places.first] += name[2] - name[0];
    fans[corner[2] - places.first] += name[0] - name[1];
  }
}

template <typename T>
void sample_half_edges(const TriangleBlock<T>& block, std::size_t n,
                       std::vector<SampledHalfEdge>& sample) {
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t *a = block.hash[i], *b = block.hash[i == 2 ? 0 : i + 1];
    for (std::size_t first = 0; first < n; first += 64) {
      std::uint64_t bits;
      static_assert(std::endian::native == std::endian::little);
      std::memcpy(&bits, block.sampled[i] + first / 8, sizeof bits);
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t t = first + static_cast<std::size_t>(std::countr_zero(bits));
        const std::uint32_t product = a[t] * b[t];
        sample.push_back({.name = std::uint64_t{product} << 32 | (a[t] + b[t]),
                          .error = block.edge_error[i][t],
                          .lumped = (block.flag[t] & kNodes) == 0});
      }
    }
  }
}

template void ask_for_lumps(const CornerPlaces&, std::size_t, bool,
                            const VertexLump<std::int32_t>*);
template void ask_for_lumps(const CornerPlaces&, std::size_t, bool, const VertexLump<double>*);
template void scatter_lumps(const CornerPlaces&, std::size_t, bool,
                            const TriangleBlock<std::int32_t>&, VertexLump<std::int32_t>*);
template void scatter_lumps(const CornerPlaces&, std::size_t, bool, const TriangleBlock<double>&,
                            VertexLump<double>*);
template void link_fans(const CornerPlaces&, std::size_t, const TriangleBlock<std::int32_t>&,
                        std::uint32_t*);
template void link_fans(const CornerPlaces&, std::size_t, const TriangleBlock<double>&,
                        std::uint32_t*);
template void sample_half_edges(const TriangleBlock<std::int32_t>&, std::size_t,
                                std::vector<SampledHalfEdge>&);
template void sample_half_edges(const TriangleBlock<double>&, std::size_t,
                                std::vector<SampledHalfEdge>&);

}  // namespace rholm
