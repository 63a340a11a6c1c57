// Extracts the surface of an atlas: grid, holes, triangles, trimming. Layer: surface.
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

// Returns the area below which a connected part without support is kept, because a gap
// between random points is not a hole. `support` is the median of the caps' supports.
double least_hole(double support);
inline constexpr double kBridged = 0.01;  // positive support that marks a vertex as kept

// Returns options that stop at a default error if `options` set no limit. `step`: the grid's step.
SimplifyOptions simplify_stops(SimplifyOptions options, double step);

struct AtlasSurfaceOptions {
  double step = 0;          // edge of the grid's cubes
  bool keep_holes = false;  // cut away what lies in no support, instead of closing it
  double min_component = 0.01;
  std::optional<SimplifyOptions> simplify = {};  // if empty: error up to 1/50 of the step
  const Resolution* resolution = nullptr;        // handles smaller than the resolution are cut
  const SeenSpace* seen = nullptr;        // space that scanners saw to be empty is not closed
  std::function<void(Mesh&)> judge = {};  // receives the surface before simplification
  std::size_t max_memory = std::size_t{8} << 30;
  std::size_t memory_in_use = 0;  // bytes of max_memory that the caller already holds
};

struct AtlasSurface {
  Mesh mesh;  // has normals nx, ny, nz
  std::size_t holes = 0, smooth_holes = 0;
  double guessed = 0;  // share of the closed surface's area in triangles at filled nodes
  std::size_t cut_handles = 0;
  std::size_t dropped_components = 0;
  std::size_t faces = 0;  // number of faces before simplification
  double simplify_error = 0;
  std::size_t memory = 0;  // estimate in bytes, including memory_in_use
};

// Throws OutOfMemory beyond max_memory, InvalidInput without caps or if the surface stays open.
AtlasSurface extract_atlas(const Atlas& atlas, const AtlasSurfaceOptions& options,
                           const Context& context = {});

}  // namespace rholm
