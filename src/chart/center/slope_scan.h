// The derivative of the slope of the radius along a line, over the faces of a view. Layer: chart.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "chart/center/local_view.h"
#include "chart/center/view_scan.h"

namespace rholm {

// The points middle + t way, in the unit frame.
struct SlopeLine {
  Vec3 middle, way;
  double least = 0;  // positive; a plane nearer than this counts as so far
};

// Chosen: faces whose area is less than this part of the square of their distance from `middle`
// have one point. Of a sphere with more than 1820 equal faces that is all of them.
inline constexpr double kPieceSize = 4 * std::numbers::pi / 4096;
inline constexpr double kSmallFace = 2.25 * kPieceSize;

// One pass looks from at most so many places t of the line.
inline constexpr std::size_t kMostPlaces = 4;
using Places = std::array<double, kMostPlaces>;

struct Rises {
  Places sums = {};
  bool too_near = false;  // from the first or the last of several places a face is at d < least
};

// For each of the first `n` places, 1 or kMostPlaces, the sum over the faces of [begin, end) of
// d/dt of area (rho / d - d / rho), as seen from middle + t way, at the middle of the face; 0 for
// the others. Visits large faces, which are left out. Throws InvalidInput for an index out of
// range.
Rises sum_rises(const LocalView& view, std::size_t begin, std::size_t end, const SlopeLine& line,
                const Places& places, std::size_t n, const VisitTriangle& visit);

}  // namespace rholm
