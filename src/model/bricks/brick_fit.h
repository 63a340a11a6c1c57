// Caps for the points of one brick. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "atlas/cover/cap_size.h"
#include "io/spill/piece_store.h"
#include "model/bricks/brick_halo.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/point_survey.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"
#include "shape/points/side_balance.h"

namespace rholm {

// The points of a brick and those of others near it, its halo, in the order of a tree.
struct BrickScene {
  PointCloud cloud;  // the brick's own first
  std::size_t n_own = 0;
  std::vector<BrickAndHalo::Part> halo =
      {};  // where the others are from, unless some were left out
  std::unique_ptr<PointTree> tree;
  std::vector<Vec3> points, normals;  // in the order of the tree; unit normals, or none
  std::vector<std::uint8_t> foreign;  // likewise: 1 of the halo
  std::vector<float> confidence;      // likewise, of computed normals: see OrientReport
  SamplingGaps gaps;
  bool computed_normals = false;

  OrderedPoints ordered() const { return {*tree, points, normals, &gaps, computed_normals}; }
};

// With the points of others in the box around its own that is wider by `halo` on all sides. Normals
// are turned as mend_bricks() says.
BrickScene load_brick(const PieceStore& store, const BrickPlan& plan, std::size_t brick,
                      double halo, const Context& context);

// What some own points of a brick, evenly spread, tell of all.
struct SamplePoint {
  double spacing = 0;     // to its neighbours: spacing_of_circle()
  double area = 0;        // that a point stands for, by those around
  double disc = 0;        // as balance_sides() has it
  double points = 0;      // for so many it speaks
  std::size_t place = 0;  // in the order of the tree
  Vec3 at, normal;        // no normal: zero
  double wrong = 0;       // 1: has_wrong_normal()
};
// `around`: neighbours that tell the area.
std::vector<SamplePoint> sample_brick(const BrickScene& scene, std::size_t n, std::size_t around,
                                      const Context& context);

// Around each place, between its nearest points or between their rows: see
// WorkingPoints::spacing_at().
std::vector<double> spacings_at(const BrickScene& scene, const std::vector<Vec3>& places);

// Of all bricks together.
struct WholeSample {
  double median = 0;  // spacing
  double fine = 0;    // only a tenth of the points lie clearly closer
  double area = 0;
  double wrong = 0;  // share of normals
  SideBalance sides;
};
WholeSample join(const std::vector<SamplePoint>& samples);

// The spacing in each brick by the sample of the survey: the points are as much denser as they are
// more; nine of ten of the brick's points lie closer.
std::vector<double> spacings_of_sample(const Survey& survey, const BrickPlan& plan, double points);
// Spacings to the farthest of k neighbours, and as far again: of one point in thousands it is more.
double reach_of(std::size_t k);

// The median of each.
CapSize median_of(const std::vector<CapSize>& sizes);

}  // namespace rholm
