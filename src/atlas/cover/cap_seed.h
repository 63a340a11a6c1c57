// Selects a cap's points, for covering, choosing a size and removing outliers. Layer: atlas.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_fit.h"
#include "atlas/cover/ordered_points.h"
#include "shape/points/point_tree.h"

namespace rholm {

inline constexpr double kHalfAngle = 15 * std::numbers::pi / 180;  // see method 7.2
inline constexpr double kOpened = 60 * std::numbers::pi / 180;

// Memory of one thread.
struct CapWorker {
  Vec3 middle;                 // middle of the cap: its seed, or the position after settle()
  std::vector<Neighbor> near;  // points around `middle`, nearest first
  CapPoints points;
  CapFitScratch scratch;
  CapFit fit;
};

// Selects which of a seed's neighbours belong to its cap.
enum class CapSide {
  kSheet,  // neighbours without opposite normals, as the far side of a thin part has
  kFace,   // neighbours with similar normals: one face of a crease
};

// Moves worker.middle from the seed across the sheet to the mean of the nearest
// points, and sorts worker.near again. The neighbours of a noisy seed off the surface
// are off the surface too, and without the move its cap would pass through the seed.
void settle(const OrderedPoints& all, std::size_t seed, CapWorker& worker);

// Returns how many of worker.near, from the nearest on, contain
// `wanted` points of the seed's sheet; 0 if there are too few.
std::size_t reach_of(const OrderedPoints& all, std::size_t seed, std::size_t wanted,
                     const CapWorker& worker);

// Fills worker.points with the selected ones of the k nearest points (worker.near),
// and returns their weighted mean normal. The seed is left out if `leave_out`.
Vec3 take_points(const OrderedPoints& all, std::size_t seed, std::size_t k, double support,
                 CapSide side, bool leave_out, CapWorker& worker);

}  // namespace rholm
