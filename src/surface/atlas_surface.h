// From an atlas to its surface: grid, holes, triangles, trimming. Layer: surface.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/simplify.h"
#include "surface/holes/seen_space.h"
#include "surface/level_set/cut_handles.h"

namespace rholm {

// Connected parts without support that are smaller are kept: a gap between random points is no
// hole. Of the median of the supports of caps.
double least_hole(double support);
inline constexpr double kBridged = 0.01;  // support of a vertex that stays: above 0

// Where to stop on a surface of a grid, if nothing says so.
SimplifyOptions simplify_stops(SimplifyOptions options, double step);

struct AtlasSurfaceOptions {
  double step = 0;          // edge of the grid's cubes
  bool keep_holes = false;  // cut away what is in no support, instead of closing it
  double min_component = 0.01;
  std::optional<SimplifyOptions> simplify = {};  // with nothing in it: 1/50 of the step
  const Resolution* resolution = nullptr;        // what is smaller than that is cut
  const SeenSpace* seen = nullptr;        // what scanners have seen to be empty is not closed
  std::function<void(Mesh&)> judge = {};  // is given the surface before it is simplified
  std::size_t max_memory = std::size_t{8} << 30;
  std::size_t memory_in_use = 0;  // bytes of max_memory that the caller holds
};

struct AtlasSurface {
  Mesh mesh;  // with normals nx, ny, nz
  std::size_t holes = 0, smooth_holes = 0;
  double guessed = 0;  // share of the closed surface's area that is beside filled nodes
  std::size_t cut_handles = 0;
  std::size_t dropped_components = 0;
  std::size_t faces = 0;  // before simplification
  double simplify_error = 0;
  std::size_t memory = 0;  // foreseen with what was in use, bytes
};

// Throws InvalidInput if more memory than allowed would be needed, or the surface does not close.
AtlasSurface extract_atlas(const Atlas& atlas, const AtlasSurfaceOptions& options,
                           const Context& context = {});

}  // namespace rholm
