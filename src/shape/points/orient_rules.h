// Decides when the winding-number field is used for signs, and when it is accepted. Layer: shape.
#pragma once

namespace rholm {

// Share of points where the winding number contradicts the graph, above which the field is used.
// Measured (scripts/scan-figures) on twelve bodies of 1000 to 100 000 random points: at most 0.003
// if fewer than one sign in a thousand is wrong, 0.02 ... 1 otherwise.
inline constexpr double kDoubtfulGraph = 0.005;
inline constexpr int kCleanNeighbors = 10;
// Median residual of fits to one sheet, relative to the radius: up to 0.03 for clean points (twelve
// bodies, 1000 to 60 000 points), from 0.06 for the least noise that takes more neighbours.
inline constexpr double kSheets = 0.04;
// Median residual if directions are unrelated to points: a plane's field lies in the plane.
inline constexpr double kNoSheets = 0.5;
// Width of patches in the field, in spacings. A width of half a spacing separates thin sheets; for
// noisy points it gives wrong signs to points off the surface.
inline constexpr double kField = 0.5, kWideField = 1;
// The field must contradict fewer points: on an open plane, the graph is more consistent.
inline constexpr double kClearly = 0.95;

}  // namespace rholm
