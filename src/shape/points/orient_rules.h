// When the field of all points is asked for signs, and when it is believed. Layer: shape.
#pragma once

namespace rholm {

// Share of the points where the winding number contradicts the graph. Measured
// (scripts/scan-figures) on twelve bodies, 1000 to 100 000 random points: at most 0.003 where fewer
// than one sign in a thousand is wrong, 0.02 ... 1 where more are.
inline constexpr double kDoubtfulGraph = 0.005;
inline constexpr int kCleanNeighbors = 10;
// Median residual of fits to one sheet, of their radius: up to 0.03 of clean points (twelve bodies,
// 1000 to 60 000 points), from 0.06 on with the least noise for which more neighbours are taken.
inline constexpr double kSheets = 0.04;
// That of directions with nothing to do with the points': a plane has a field along itself.
inline constexpr double kNoSheets = 0.5;
// Width of patches where the field is asked: half of the spacing tells thin sheets apart, of noisy
// points it has the signs of points off the surface wrong.
inline constexpr double kField = 0.5, kWideField = 1;
// What has no inside, a plane, is in doubt everywhere; there the graph is at least consistent.
inline constexpr double kClearly = 0.95;

}  // namespace rholm
