// The points of a brick and those around it. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_points.h"

namespace rholm {

struct BrickAndHalo {
  // Of one other brick.
  struct Part {
    std::size_t brick = 0;
    std::vector<std::uint32_t> places = {};  // of its points, in their order
  };
  PointCloud cloud = {};  // the brick's own points, in their order, and those of each part
  std::size_t n_own = 0;
  std::vector<Part> halo = {};  // by bricks
};

// With the points of others in the box around its own that is wider by `halo` on all sides.
BrickAndHalo read_with_halo(const PieceStore& store, const BrickPlan& plan, std::size_t brick,
                            double halo);

// One value for each point of the cloud: `values_of(brick)` has those of one brick.
template <typename T, typename ValuesOf>
std::vector<T> gather(const BrickAndHalo& points, std::size_t brick, const ValuesOf& values_of) {
  std::vector<T> values = values_of(brick);
  values.reserve(points.cloud.points.size());
  for (const BrickAndHalo::Part& part : points.halo) {
    const std::vector<T> others = values_of(part.brick);
    for (const std::uint32_t i : part.places) values.push_back(others.at(i));
  }
  return values;
}

}  // namespace rholm
