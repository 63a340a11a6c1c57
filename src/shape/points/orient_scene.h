// The points that normals are found for, put in order. Layer: shape.
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

// The distinct points in the order of a tree over them, moved and scaled to the size of 1.
struct OrientScene {
  UnitFrame frame;
  std::vector<std::uint32_t> place = {};  // per point of the scene: its input point
  std::vector<Vec3> points = {};
  std::optional<PointTree> tree = {};
  SamplingGaps gaps = {};
  // Per input point: the point of the scene whose normal it takes, its own, or that of the first at
  // its place, or the nearest one if it is a stray.
  std::vector<std::uint32_t> taken = {};
  std::vector<std::uint8_t> stray = {};  // per input point
  std::size_t duplicates = 0;            // input points at the place of an earlier one
};

// Throws InvalidInput for points on one line. Strays are left out on demand.
OrientScene make_orient_scene(const PointCloud& cloud, bool leave_out_strays,
                              const Context& context);

[[noreturn]] void refuse_line(std::size_t n_points);

}  // namespace rholm
