// Finds places where two sheets cross, so that points lie on no surface of a body. Layer: shape.
//
// Near a crossing, two paraboloids explain the points, and each has points on both sides of the
// other. At an edge, or where a sheet ends at another, one side is empty. Points are chosen by
// coordinates, so that any order and any tiles give the same ones.
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

// Largest number of points near crossings that are reported with their coordinates.
inline constexpr std::size_t kNamedCrossings = 3;
// Number of neighbours compared with a point; for noisy points, a wider ball is compared.
inline constexpr std::size_t kCrossingNeighbors = 48;

struct CrossingSearch {
  std::size_t n = 0;    // number of points of the whole cloud
  double diagonal = 0;  // diagonal of the whole cloud
  double noise = 0;     // standard deviation of the points across their surface

  // Least radius of the ball around a point. It is 0 if the ball that the noise requires is not
  // local; then find_crossings() finds nothing.
  double reach() const;
  bool is_local() const;
};

struct Crossings {
  double length = 0;        // estimated length of the lines along which sheets cross
  std::uint64_t found = 0;  // number of tested points that are near such a line
  // Some of these points, with their random numbers `rank`: those with the least ranks, in order.
  std::array<Vec3, kNamedCrossings> at = {};
  std::array<std::uint64_t, kNamedCrossings> rank = {};

  std::size_t named() const;
  void add(const Crossings& other);
};

// Finds crossings near points of the tree, in its order. `foreign` (may be empty) flags points of
// other tiles, which are used as neighbours only.
Crossings find_crossings(const PointTree& tree, std::span<const Vec3> points,
                         const SamplingGaps& gaps, std::span<const std::uint8_t> foreign,
                         const CrossingSearch& search, const Context& context);

}  // namespace rholm
