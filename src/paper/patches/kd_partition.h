// Divides points into patches that do not fold, the paper's way (section 5.1). Layer: chart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "paper/patches/sphere_fit.h"
#include "rholm/context.h"

namespace rholm {

struct PartitionOptions {
  double min_cosine = 0.5;  // delta_a of (P36), 0 ... 1
  double star = 0.1;        // least cosine between a normal and the ray from the centre, 0 ... 1
  std::size_t min_points = 16;  // smallest size of a split patch; at least 1
};

// The points order[begin] ... order[end - 1] of a partition.
struct KdPatch {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  PatchSphere seen;          // in the coordinates of the points
  double normal_cosine = 1;  // least between a normal and the mean normal
  bool holds = false;        // both conditions; otherwise there are too few points to split
};

struct KdPartition {
  std::vector<std::uint32_t> order;  // each point once
  std::vector<KdPatch> patches;      // sorted by `begin`; together they have all of `order`
  std::size_t n_failed = 0;          // patches that do not hold
};

// Splits the bounding box of the points across its longest axis at the median, until each patch
// holds or its halves would have too few points. A patch holds if all normals are in the cone about
// the mean normal (P36), and if it is star-shaped about its sphere's centre. The cone alone does
// not ensure this (method 7.2). Normals have any length. Same bits for any number of threads.
// Throws InvalidInput for non-finite points or normals, normals of length 0, a wrong number of
// normals, and options out of range.
KdPartition kd_partition(std::span<const Vec3> points, std::span<const Vec3> normals,
                         const PartitionOptions& options = {}, const Context& context = {});

}  // namespace rholm
