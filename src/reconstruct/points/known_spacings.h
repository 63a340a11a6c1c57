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

// Puts each place once into the rules, in an order that does not depend on the given one.
void keep_spacings(std::vector<PlaceAndSpacing> found, SurfaceRules& rules);

// Records the spacings that several threads ask for.
class NotedSpacings {
 public:
  void note(const Vec3& place, double spacing);
  std::vector<PlaceAndSpacing> take() { return std::move(noted_); }

 private:
  std::mutex mutex_;
  std::vector<PlaceAndSpacing> noted_;
};

// Spacing at any place by the rules of a model: exact at a kept place. Otherwise it is the spacing
// of the nearest place within kReach typical spacings, or else the typical spacing.
class KnownSpacings {
 public:
  // Throws InvalidInput for rules whose numbers of spacings and places differ.
  KnownSpacings(const SurfaceRules& rules, double typical, const Context& context);
  // May be asked by several threads.
  double at(const Vec3& place) const;

  static constexpr double kReach = 5;  // chosen: loops of handles are at most this long

 private:
  SurfaceRules rules_;  // the spacings alone, in order
  double typical_;
  std::optional<PointTree> tree_;  // none without places
};

}  // namespace rholm
