// Blended potential of an atlas on a grid, and at the
// vertices extracted from it (method 7.5). Layer: surface.
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

// Distance in steps from a cap up to which nodes receive a weight from it.
inline constexpr double kBandSteps = 2.5;
// Returns this distance as a length, at least Atlas::band.
double band_of(const Atlas& atlas, double step);

// Returns the band that a small cap has by its support alone.
double band_of_support(double support);

// Band of each cap. A small cap has at least a share of its support, unless a
// sheet with opposite normals is nearer. Where points are sparser than the step
// assumes, caps disagree by more than some steps, so the band must be wider.
class CapBands {
 public:
  CapBands(const Atlas& atlas, double step, const Context& context = {});
  // Restores known bands: `own` has one per cap, or is empty if all have the least band.
  CapBands(double least, std::vector<double> own) : least_(least), own_(std::move(own)) {}
  double operator[](std::size_t cap) const { return own_.empty() ? least_ : own_[cap]; }

 private:
  double least_ = 0;
  std::vector<double> own_;  // empty if all caps have the least band
};

// Caps that reach each block, in the order of blocks. Block
// b has the caps caps[first[b]] ... caps[first[b + 1] - 1].
struct CapLists {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> caps;
};

// Returns the part of space in each cap's support.
std::vector<Disc> discs_of(const Atlas& atlas, const CapBands& bands);
CapLists list_caps(const BlockGrid& grid, const std::vector<Disc>& discs,
                   const Context& context = {});

// Sets values to G = sum w g / sum w with w = (1 - d^2/R^2)^3 (1 - g^2/T^2)^2, or with
// the paper's weight as first factor (CapBlend). Returns one bit per node, 8 words per
// block. A bit is 1 where the value is doubtful: near the surface, but at the very end
// of all caps. One thread first calls `beside`, if given, while the others start.
std::vector<std::uint64_t> fill_grid(const Atlas& atlas, const CapBands& bands,
                                     const CapLists& lists, BlockGrid& grid, const Context& context,
                                     const std::function<void()>& beside = {});

// Moves vertices to G = 0 by one Newton step, and sets their normals nx, ny, nz.
// Vertices beside filled nodes are not moved; outside all caps the normal stays zero.
void project_vertices(const Atlas& atlas, const CapBands& bands, const CapLists& lists,
                      const BlockGrid& grid, ExtractedSurface& surface, const Context& context);

}  // namespace rholm
