// Points to which caps are fitted. Layer: atlas.
#pragma once

#include <cstddef>
#include <span>

#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// Points and unit normals in the order of a tree.
struct OrderedPoints {
  const PointTree& tree;
  std::span<const Vec3> points;
  std::span<const Vec3> normals;
  const SamplingGaps* gaps = nullptr;  // nullptr: the points are even
  // Number of points that each normal was computed from; 0: the normals were given.
  std::size_t normal_neighbors = 0;

  // Returns the number of neighbours of point i that reach as far as k of even points.
  std::size_t scaled(std::size_t i, std::size_t k) const {
    return gaps != nullptr ? gaps->scaled(i, k) : k;
  }
};

}  // namespace rholm
