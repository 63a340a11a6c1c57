// A tile's points and its halo, with normals. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "atlas/cover/ordered_points.h"
#include "reconstruct/points/tile_halo.h"
#include "rholm/mesh.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// The points of a tile and its halo (near points of other tiles), in the order of a tree.
struct TileScene {
  std::size_t n_own = 0;                     // points of the tile, which come before the halo
  std::vector<Attribute> attributes;         // in that order, which the tree has as order()
  std::vector<TileAndHalo::Part> halo = {};  // tiles of the halo, unless points were left out
  std::unique_ptr<PointTree> tree;
  std::vector<Vec3> points, normals;  // in the order of the tree; unit normals, or none
  std::vector<std::uint8_t> foreign;  // in the order of the tree: 1 of the halo
  std::vector<float> confidence;      // in this order, of computed normals: see OrientReport
  SamplingGaps gaps;
  std::size_t normal_neighbors = 0;  // see OrderedPoints

  OrderedPoints ordered() const { return {*tree, points, normals, &gaps, normal_neighbors}; }
};

}  // namespace rholm
