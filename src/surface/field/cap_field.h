// The blended potential of an atlas on a grid, and on the vertices extracted from it (method 7.5).
// Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "surface/grid/block_grid.h"
#include "surface/level_set/extract.h"

namespace rholm {

// A cap has a weight at nodes within so many steps of it.
inline constexpr double kBandSteps = 2.5;
// The same as a length: at least Atlas::band.
double band_of(const Atlas& atlas, double step);

// What a small cap would have by its support alone.
double band_of_support(double support);

// The band of each cap: of small ones at least a part of their support, as long as no sheet that
// faces the other way is so near. Where points are sparser than those that the step was chosen for
// caps disagree by more than some steps.
class CapBands {
 public:
  CapBands(const Atlas& atlas, double step, const Context& context = {});
  // As found before: one of each cap, or none if all have the least.
  CapBands(double least, std::vector<double> own) : least_(least), own_(std::move(own)) {}
  double operator[](std::size_t cap) const { return own_.empty() ? least_ : own_[cap]; }

 private:
  double least_ = 0;
  std::vector<double> own_;  // empty if none is larger
};

// The caps that reach each block, in their order: those of block b are
// caps[first[b]] ... caps[first[b + 1] - 1].
struct CapLists {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> caps;
};

// The part of space in a cap's support.
std::vector<Disc> discs_of(const Atlas& atlas, const CapBands& bands);
CapLists list_caps(const BlockGrid& grid, const std::vector<Disc>& discs,
                   const Context& context = {});

// Sets values to G = sum w g / sum w, w = (1 - d^2/R^2)^3 (1 - g^2/T^2)^2, or with the weight of
// the paper in the place of the first factor: CapBlend. Returns one bit per node, 8 words per
// block: 1 where the value is doubtful, near the surface but at the very end of all caps. One of
// the threads calls `beside` first, if there is one, and the others go ahead.
std::vector<std::uint64_t> fill_grid(const Atlas& atlas, const CapBands& bands,
                                     const CapLists& lists, BlockGrid& grid, const Context& context,
                                     const std::function<void()>& beside = {});

// Moves vertices to G = 0 by one Newton step, and sets their normals nx, ny, nz; those beside
// filled nodes stay, with normals of their triangles.
void project_vertices(const Atlas& atlas, const CapBands& bands, const CapLists& lists,
                      const BlockGrid& grid, ExtractedSurface& surface, const Context& context);

}  // namespace rholm
