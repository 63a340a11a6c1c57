// Simplifies a part of a surface whose remainder stays unchanged or is simplified separately.
// Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/simplify.h"
#include "shape/simplify/plane_quadric.h"

namespace rholm {

enum class PartVertex : std::uint8_t {
  kFree,
  kLocked,   // stays in place, with its connections to other parts
  kUnlocked  // free, but locked earlier: its quadric does not include borders
};

struct SimplifyPart {
  std::vector<Vec3> points = {};
  std::vector<Triangle> faces = {};
  std::vector<PartVertex> kinds = {};  // per vertex
  // Quadric of each vertex, or empty. Where the weight is 0, the triangles around the vertex define
  // the quadric. Lengths are in units.
  std::vector<PlaneQuadric> quadrics = {};
  double unit = 1;
};

struct SimplifiedPart {
  std::vector<Triangle> faces = {};          // refer to the given vertices
  std::vector<std::uint32_t> origins = {};   // given triangle that each one was
  std::vector<std::uint32_t> vertices = {};  // remaining given vertices, ascending
  std::vector<PlaneQuadric> quadrics = {};   // of the remaining vertices
  double error = 0;                          // as Simplification::error
  // History of the simplification: `triangles` were left when all collapses of at most this cost
  // were done. The cost is a sum of squared distances times areas, in units. Parts that end at the
  // same cost are simplified as one surface is.
  struct Step {
    double cost = 0;
    std::uint64_t faces = 0;
  };
  std::vector<Step> steps = {};
};

// Simplifies as simplify() until at most `triangles` are left or the error is reached. Two parts
// with common vertices, locked in both, are as manifold together afterwards as before.
SimplifiedPart simplify_part(SimplifyPart part, std::size_t triangles, double max_error,
                             const Context& context = {});

}  // namespace rholm
