// Computes the derivative of the radius's slope along a line, summed over faces. Layer: chart.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "chart/center/local_view.h"
#include "chart/center/view_scan.h"

namespace rholm {

// The line of points middle + t way, in the unit frame.
struct SlopeLine {
  Vec3 middle, way;
  double least = 0;  // positive; a plane nearer than this counts as at this distance
};

// Chosen: faces with an area below kSmallFace times the square of their distance from `middle` have
// one point. On a sphere of more than 1820 equal faces, every face has one point.
inline constexpr double kPieceSize = 4 * std::numbers::pi / 4096;
inline constexpr double kSmallFace = 2.25 * kPieceSize;

// Largest number of places t on the line that one pass evaluates.
inline constexpr std::size_t kMostPlaces = 4;
using Places = std::array<double, kMostPlaces>;

struct Rises {
  Places sums = {};
  bool too_near = false;  // true if a face has d < least from the first or last of several
};

// Computes one sum over the faces of [begin, end) for each of the first `n` places, 1 or
// kMostPlaces. Terms are d/dt of area (rho / d - d / rho), seen from middle + t way, at the middle
// of the face. Sums of other places are 0. Large faces are left out and visited instead. Throws
// InvalidInput for an index out of range.
Rises sum_rises(const LocalView& view, std::size_t begin, std::size_t end, const SlopeLine& line,
                const Places& places, std::size_t n, const VisitTriangle& visit);

}  // namespace rholm
