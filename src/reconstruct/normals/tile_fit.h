// Sample of a tile's points, spacings, and medians over tiles. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <vector>

#include "atlas/cover/cap_size.h"
#include "reconstruct/points/point_survey.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/side_balance.h"

namespace rholm {

// One of some own points of a tile, evenly spread, that stand for all points.
struct SamplePoint {
  double spacing = 0;     // between neighbours or in rows: spacing_of_circle()
  double area = 0;        // that a point stands for, from its neighbours
  double disc = 0;        // as balance_sides() has it
  double points = 0;      // number of points that it stands for
  std::size_t place = 0;  // in the order of the tree
  Vec3 at, normal;        // no normal: zero
  double wrong = 0;       // 1: has_wrong_normal()
};
// `around` is the number of neighbours that tell the area.
std::vector<SamplePoint> sample_tile(const TileScene& scene, std::size_t n, std::size_t around,
                                     const Context& context);

// Returns the spacing around each place: of its nearest points, or of their rows.
std::vector<double> spacings_at(const TileScene& scene, const std::vector<Vec3>& places);

// Measures of the points of all tiles together.
struct WholeSample {
  double median = 0;  // spacing
  double fine = 0;    // only a tenth of the points lie clearly closer
  double area = 0;
  double wrong = 0;  // share of normals
  SideBalance sides;
};
WholeSample join(const std::vector<SamplePoint>& samples);

// Returns the spacing in each tile, from the sample of the survey, for `points` in all. Nine of ten
// of the tile's points lie closer.
std::vector<double> spacings_of_sample(const Survey& survey, const TilePlan& plan, double points);
// Returns twice the radius of a disc with k neighbours, in spacings; one in thousands needs more.
double reach_of(std::size_t k);

// Returns the median of each number.
CapSize median_of(const std::vector<CapSize>& sizes);

}  // namespace rholm
