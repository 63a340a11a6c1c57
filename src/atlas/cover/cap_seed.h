// The points of one cap: what covering, choosing a size and removing outliers share.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "atlas/cap/cap_fit.h"
#include "atlas/cover/ordered_points.h"
#include "shape/points/point_tree.h"

namespace rholm {

inline constexpr double kHalfAngle = 15 * std::numbers::pi / 180;  // method 7.2
inline constexpr double kOpened = 60 * std::numbers::pi / 180;

// Memory of one thread.
struct CapWorker {
  Vec3 middle;                 // of the cap: its seed, or where settle() moves it
  std::vector<Neighbor> near;  // around it, nearest first
  CapPoints points;
  CapFitScratch scratch;
  CapFit fit;
};

// Which of a seed's neighbours belong to its cap.
enum class CapSide {
  kSheet,  // those that do not face away from it: the far side of a thin part does
  kFace,   // those that face as it does: of a crease one side
};

// Moves worker.middle from the seed across the sheet, to the mean of the nearest points there, and
// sorts worker.near anew. A noisy seed that lies off the surface has neighbours that do so too, and
// its cap would pass through it.
void settle(const OrderedPoints& all, std::size_t seed, CapWorker& worker);

// How many of worker.near, from the nearest on, hold so many points of the seed's sheet; 0 if all
// do not.
std::size_t reach_of(const OrderedPoints& all, std::size_t seed, std::size_t wanted,
                     const CapWorker& worker);

// Fills worker.points with those among the k nearest (worker.near), and returns their mean normal,
// weighted. The seed itself is left out if `leave_out`.
Vec3 take_points(const OrderedPoints& all, std::size_t seed, std::size_t k, double support,
                 CapSide side, bool leave_out, CapWorker& worker);

}  // namespace rholm
