// Selects the triangles of a view that matter for a search. Layer: chart.
//
// Vectors of triangles are tested in double precision without square root or division. Triangles
// that may matter go in order to a visitor, which does the exact work. Nothing is kept per
// triangle. Vectors differ between machines, but results of the visitors do not.
#pragma once

#include <cstddef>
#include <limits>

#include "chart/center/local_view.h"

namespace rholm {

// Limits as seen from a point of the unit frame.
struct ScanLimits {
  double distance = -std::numeric_limits<double>::infinity();  // d_T
  double cosine = -std::numeric_limits<double>::infinity();    // smallest cos gamma of a corner
};

// Visits every triangle of [begin, end) below one of the limits, and some others. These have almost
// no area, or are above a limit by a rounding (1e-12 of the size, and of a cosine). The visitor may
// change the limits. Throws InvalidInput for an index out of range.
void scan_below(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
                const ScanLimits& limits, const VisitTriangle& visit);

// Visits every triangle of [begin, end) whose cone, seen from the centre, may contain the direction
// (a unit vector) or the opposite direction.
void scan_lines(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
                const Vec3& direction, const VisitTriangle& visit);

}  // namespace rholm
