// Where two sheets cross each other, so that points lie on no surface of a body. Layer: shape.
//
// Around a point near a crossing two paraboloids explain the points, and each of them has points on
// both sides of the other. At an edge, or where one sheet ends at another one, a side is empty.
// Points are chosen by their coordinates, so that any order and any tiles look at the same ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// Points near crossings that are named.
inline constexpr std::size_t kNamedCrossings = 3;
// A point is compared with so many neighbours, or with all of a wider ball where points are noisy.
inline constexpr std::size_t kCrossingNeighbors = 48;

struct CrossingSearch {
  std::size_t n = 0;    // points of the whole cloud
  double diagonal = 0;  // of the whole cloud
  double noise = 0;     // standard deviation of the points across their surface

  // Least radius of the ball around a point; 0 where balls that noise asks for are not local, and
  // nothing is looked for.
  double reach() const;
  bool is_local() const;
};

struct Crossings {
  double length = 0;        // of the lines along which sheets cross: an estimate
  std::uint64_t found = 0;  // points that were looked at and are near such a line
  // Some of these points, and the random numbers that choose them: the least ones, in order.
  std::array<Vec3, kNamedCrossings> at = {};
  std::array<std::uint64_t, kNamedCrossings> rank = {};

  std::size_t named() const;
  void add(const Crossings& other);
};

// Points in the order of the tree. Points that are `foreign`, if there are any, belong to other
// parts of the cloud, and are only neighbours here.
Crossings find_crossings(const PointTree& tree, std::span<const Vec3> points,
                         const SamplingGaps& gaps, std::span<const std::uint8_t> foreign,
                         const CrossingSearch& search, const Context& context);

}  // namespace rholm
