// Distances between neighbouring points at the places where handles are looked for, as a model
// keeps them (SurfaceRules). Layer: reconstruct, private.
#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/surface_rules.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

struct PlaceAndSpacing {
  Vec3 place;
  double spacing = 0;
};

// Into the rules, each place once, in an order that does not depend on the given one.
void keep_spacings(std::vector<PlaceAndSpacing> found, SurfaceRules& rules);

// Notes what is asked for, by several threads.
class NotedSpacings {
 public:
  void note(const Vec3& place, double spacing);
  std::vector<PlaceAndSpacing> take() { return std::move(noted_); }

 private:
  std::mutex mutex_;
  std::vector<PlaceAndSpacing> noted_;
};

// The spacing at any place, as rules have it: exact where it is kept, else that of the nearest
// place within kReach typical spacings, else the typical one.
class KnownSpacings {
 public:
  // Throws InvalidInput for rules with other numbers of spacings than of places.
  KnownSpacings(const SurfaceRules& rules, double typical, const Context& context);
  // May be asked by several threads.
  double at(const Vec3& place) const;

  static constexpr double kReach = 5;  // chosen: loops of handles are at most so long

 private:
  SurfaceRules rules_;  // the spacings alone, in order
  double typical_;
  std::optional<PointTree> tree_;  // none without places
};

}  // namespace rholm
