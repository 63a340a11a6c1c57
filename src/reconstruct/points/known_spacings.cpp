#include "reconstruct/points/known_spacings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "rholm/error.h"

namespace rholm {
namespace {

bool lies_before(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace

void keep_spacings(std::vector<PlaceAndSpacing> found, SurfaceRules& rules) {
  std::sort(found.begin(), found.end(), [](const PlaceAndSpacing& a, const PlaceAndSpacing& b) {
    return lies_before(a.place, b.place);
  });
  const auto same = [](const PlaceAndSpacing& a, const PlaceAndSpacing& b) {
    return a.place == b.place;
  };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  rules.spacing_places.clear(), rules.spacings.clear();
  rules.spacing_places.reserve(found.size()), rules.spacings.reserve(found.size());
  for (const auto& [place, spacing] : found) {
    rules.spacing_places.push_back(place);
    rules.spacings.push_back(spacing);
  }
}

void NotedSpacings::note(const Vec3& place, double spacing) {
  const std::lock_guard lock(mutex_);
  noted_.push_back({place, spacing});
}

KnownSpacings::KnownSpacings(const SurfaceRules& rules, double typical, const Context& context)
    : typical_(typical) {
  const std::size_t n = rules.spacings.size();
  if (n != rules.spacing_places.size()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("a surface's rules have {} spacings at {} places", n,
                            rules.spacing_places.size()));
  }
  std::vector<PlaceAndSpacing> found;
  found.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    found.push_back({rules.spacing_places[i], rules.spacings[i]});
  }
  keep_spacings(std::move(found), rules_);
  if (n > 0) tree_.emplace(rules_.spacing_places, context);
}

double KnownSpacings::at(const Vec3& place) const {
  const std::vector<Vec3>& places = rules_.spacing_places;
  const auto same = std::lower_bound(places.begin(), places.end(), place, lies_before);
  if (same != places.end() && *same == place) {
    return rules_.spacings[static_cast<std::size_t>(same - places.begin())];
  }
  Neighbor near{};
  if (!tree_ || !tree_->nearest_within(place, kReach * typical_, near)) return typical_;
  return rules_.spacings[tree_->order()[near.index]];
}

}  // namespace rholm
