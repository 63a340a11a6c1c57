// Survey of points before they are cut into tiles. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/point_rows.h"
#include "reconstruct/points/point_source.h"
#include "rholm/context.h"
#include "rholm/topology.h"
#include "shape/points/isolated_points.h"

namespace rholm {

struct SurveyOptions {
  std::uint64_t points_per_tile = std::uint64_t{1} << 20;  // for the size of the sample
  std::uint64_t least_sample = std::uint64_t{1} << 17;     // chosen: 4 MB
  bool drop_far_isolated = true;
};

// Results that do not depend on the order of the points. Only layout.columns are in the order of
// the file.
struct Survey {
  std::uint64_t points = 0;        // that are kept: finite, and not far from all others
  std::uint64_t not_finite = 0;    // a coordinate is NaN or infinite
  std::uint64_t far_isolated = 0;  // see shape/points/isolated_points.h; by the box of the sample
  std::uint64_t dropped = 0;       // by the reader of the file, as they are not finite
  FarBall ball = {};               // outside of it points are far from all others
  Bounds bounds = {};              // of the points that are kept
  PointLayout layout = {};         // of all; normals: one of a kept point is finite and not zero
  double n_different = 0;          // points, about
  std::vector<Vec3> sample = {};   // of kept points, see PointSample; at least 64 for each tile
};

// Goes through the points once, and twice if some are far from all others. Throws InvalidInput if
// no point is finite, what the source throws, and Cancelled.
Survey survey(PointSource& source, const SurveyOptions& options = {}, const Context& context = {});

// Writes the store's piece "survey".
void write_survey(const Survey& survey, PieceStore& store);
// Returns nullopt if it is not there. Throws InvalidInput if it is damaged.
std::optional<Survey> read_survey(const PieceStore& store);

}  // namespace rholm
