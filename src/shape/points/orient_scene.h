// Prepares the points whose normals are computed. Layer: shape.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/face.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// The distinct points in the order of a tree over them, moved and scaled to the size 1.
struct OrientScene {
  UnitFrame frame;
  std::vector<std::uint32_t> place = {};  // input point of each scene point
  std::vector<Vec3> points = {};
  std::optional<PointTree> tree = {};
  SamplingGaps gaps = {};
  // Scene point whose normal each input point takes: its own, the one of the first point at its
  // place, or for an isolated point the nearest one.
  std::vector<std::uint32_t> taken = {};
  std::vector<std::uint8_t> isolated = {};  // isolated points; per input point
  std::size_t duplicates = 0;               // number of input points at the place of an earlier one
};

// Builds the scene, optionally without isolated points. Throws InvalidInput for points on a line.
OrientScene make_orient_scene(const PointCloud& cloud, bool leave_out_isolated,
                              const Context& context);

[[noreturn]] void refuse_line(std::size_t n_points);

}  // namespace rholm
