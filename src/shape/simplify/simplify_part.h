// Simplification of a part of a surface, the rest of which stays or is simplified elsewhere. Layer:
// shape.
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
  kLocked,   // stays where it is, with what it is joined to elsewhere
  kUnlocked  // free, but has been locked before: its quadric does not know of borders
};

struct SimplifyPart {
  std::vector<Vec3> points = {};
  std::vector<Triangle> triangles = {};
  std::vector<PartVertex> kinds = {};  // per vertex
  // Per vertex, what it stands for already, with weight 0 where the triangles around say it; or
  // none of all. Lengths are in units.
  std::vector<PlaneQuadric> quadrics = {};
  double unit = 1;
};

struct SimplifiedPart {
  std::vector<Triangle> triangles = {};      // by the given vertices
  std::vector<std::uint32_t> origins = {};   // which of the given ones each was
  std::vector<std::uint32_t> vertices = {};  // of the given ones that are left, ascending
  std::vector<PlaneQuadric> quadrics = {};   // of these
  double error = 0;                          // as Simplification::error
  // On the way, one after the other: so many triangles were left once no vertex went that costs
  // more (a sum of squared distances times areas, in units): parts of a surface are simplified as
  // one if they end at the same cost.
  struct Step {
    double cost = 0;
    std::uint64_t triangles = 0;
  };
  std::vector<Step> steps = {};
};

// As simplify(), until no more triangles are left than that, or the error is reached. Two parts
// with common vertices, locked in both, are as manifold together afterwards as before.
SimplifiedPart simplify_part(SimplifyPart part, std::size_t triangles, double max_error,
                             const Context& context = {});

}  // namespace rholm
