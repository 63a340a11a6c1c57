#include "surface/field/data_support.h"

#include <algorithm>
#include <cmath>

#include "atlas/cap/cap_support.h"
#include "base/parallel.h"

namespace rholm {
namespace {

// s^2 of CapSupport at the rim of the data. At the edge of a hole the points fill half
// a disc: their mean is 0.42 R from the edge, and the ellipse's half axis is 0.53 R.
constexpr double kRim = 0.63;
// s^2 up to which caps fade to the fill of a hole beyond the rim (chosen: with a tenth
// more, caps bend on their own, and flares and steps appear around the fill).
constexpr double kEnd = 0.7;
// Value of s^2 where no cap is near; above kRim and kEnd.
constexpr double kNone = 2;

// Returns the least s^2 among the caps that reach a block and for which `counts` is true.
template <typename Counts>
double least_place(const Atlas& atlas, const CapLists& lists, std::size_t block, const Vec3& x,
                   const Counts& counts) {
  double least = kNone;
  for (std::size_t i = lists.first[block]; i < lists.first[block + 1]; ++i) {
    const Cap& cap = atlas.caps[lists.caps[i]];
    const double square = place(cap, x - cap.frame.seed());
    if (square < least && counts(lists.caps[i])) least = square;
  }
  return least;
}

// Returns true if x is within `near` of the cap's surface. Behind an open sheet the
// fill begins where the band of its caps ends: near their data, but not on them.
bool lies_on(const Atlas& atlas, const Cap& cap, const Vec3& x, double near) {
  const std::span<const double> coefficients(atlas.coefficients);
  const CapValue value =
      evaluate(cap, coefficients.subspan(cap.first, n_coefficients(cap.basis, cap.degree)), x);
  return value.valid && std::abs(value.distance) < near;
}

}  // namespace

std::vector<double> data_support(const Atlas& atlas, const CapLists& lists,
                                 const ExtractedSurface& surface, const CapBands& bands,
                                 const Context& context) {
  std::vector<double> support(surface.mesh.vertices.size(), -1);
  parallel_for(lists.first.size() - 1, 64, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      for (std::size_t v = surface.first_vertex[b]; v < surface.first_vertex[b + 1]; ++v) {
        const Vec3& x = surface.mesh.vertices[v];
        const bool guessed = !surface.filled.empty() && surface.filled[v] != 0;
        support[v] = 1 - least_place(atlas, lists, b, x, [&](std::uint32_t c) {
                           return !guessed || lies_on(atlas, atlas.caps[c], x, bands[c] / 2);
                         }) / kRim;
      }
    }
  });
  return support;
}

NodeSupport node_support(const Atlas& atlas, const CapLists& lists, const BlockGrid& grid,
                         const Context& context) {
  return [&, context](std::span<const Vec3> x, std::span<double> support) {
    parallel_for(x.size(), 1024, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3 p = (x[i] - grid.origin) / (8 * grid.step);
        const auto cell = [](double c) { return static_cast<std::int32_t>(std::floor(c + 1e-6)); };
        const std::int32_t b = find_block(grid, {cell(p.x), cell(p.y), cell(p.z)});
        support[i] = 0;
        // Blocks added later for the holes have no caps.
        if (b == kNoBlock || static_cast<std::size_t>(b) + 1 >= lists.first.size()) continue;
        const double nearest = least_place(atlas, lists, static_cast<std::size_t>(b), x[i],
                                           [](std::uint32_t) { return true; });
        support[i] = std::clamp((kEnd - nearest) / (kEnd - kRim), 0.0, 1.0);
      }
    });
  };
}

}  // namespace rholm
