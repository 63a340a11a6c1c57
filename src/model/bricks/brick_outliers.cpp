#include "model/bricks/brick_outliers.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "model/bricks/brick_removal.h"
#include "model/points/reconstruct_rules.h"
#include "shape/points/outliers.h"

namespace rholm {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::string name_of(std::size_t brick) { return "groups/" + std::to_string(brick); }

// Points of the cloud that are of the halo: their bricks and places there.
std::vector<std::pair<std::uint32_t, std::uint32_t>> names_of_halo(const BrickScene& scene) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> names;
  for (const BrickAndHalo::Part& part : scene.halo) {
    for (const std::uint32_t place : part.places) {
      names.emplace_back(static_cast<std::uint32_t>(part.brick), place);
    }
  }
  return names;
}

// One flag per own point, in their order in the store.
std::vector<std::uint8_t> of_own(const BrickScene& scene, const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint8_t> own(scene.n_own, 0);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const std::uint32_t given = scene.tree->order()[i];
    if (given < scene.n_own) own[given] = flags[i];
  }
  return own;
}

}  // namespace

bool BrickGroups::has(std::size_t brick) const { return store_.has(name_of(brick)); }

void BrickGroups::remove(std::size_t brick) { store_.remove(name_of(brick)); }

void BrickGroups::find(std::size_t brick, const BrickScene& scene, const Context& context) {
  const auto halo = names_of_halo(scene);
  DisjointSets sets(scene.n_own);
  std::vector<Link> links;
  const auto visit = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t own = scene.tree->order()[i], other = scene.tree->order()[j];
    if (own >= scene.n_own) return;  // the other brick knows
    if (other < scene.n_own) {
      sets.unite(own, other);
    } else {
      const auto [of, place] = halo.at(other - scene.n_own);
      links.push_back({of, place, own});
    }
  };
  if (scene.n_own > 0) for_links_of_groups(*scene.tree, scene.normals, visit, context);
  std::vector<std::uint32_t> group(scene.n_own), sizes, number(scene.n_own, kNone);
  for (std::uint32_t i = 0; i < scene.n_own; ++i) {
    std::uint32_t& own = number[sets.find(i)];
    if (own == kNone) {
      own = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    }
    group[i] = own;
    ++sizes[own];
  }
  for (Link& link : links) link.group = group[link.group];
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  const std::span<const std::byte> sections[] = {bytes_of(group), bytes_of(sizes), bytes_of(links)};
  store_.write(name_of(brick), sections);
}

void BrickGroups::join(std::uint64_t least) {
  std::vector<std::uint32_t> first(1, 0);
  std::vector<std::uint64_t> sizes;
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    for (const std::uint32_t n : store_.open(name_of(brick)).values<std::uint32_t>(1)) {
      sizes.push_back(n);
    }
    first.push_back(static_cast<std::uint32_t>(sizes.size()));
  }
  DisjointSets sets(sizes.size());
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    std::uint32_t other = kNone;
    std::vector<std::uint32_t> groups;  // of its points
    for (const Link& link : store_.open(name_of(brick)).values<Link>(2)) {
      if (link.brick != other) {
        other = link.brick;
        groups = store_.open(name_of(other)).values<std::uint32_t>(0);
      }
      sets.unite(first[brick] + link.group, first[other] + groups.at(link.point));
    }
  }
  for (std::uint32_t g = 0; g < sizes.size(); ++g) {
    const std::uint32_t whole = sets.find(g);
    if (whole != g) sizes[whole] += sizes[g];
  }
  small_.assign(n_bricks_, {});
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    for (std::uint32_t g = first[brick]; g < first[brick + 1]; ++g) {
      small_[brick].push_back(sizes[sets.find(g)] < least ? 1 : 0);
    }
  }
}

std::vector<std::uint8_t> BrickGroups::small(std::size_t brick) const {
  std::vector<std::uint8_t> flags;
  for (const std::uint32_t g : store_.open(name_of(brick)).values<std::uint32_t>(0)) {
    flags.push_back(small_[brick].at(g));
  }
  return flags;
}

std::uint64_t remove_brick_outliers(PieceStore& store, const BrickPlan& plan,
                                    const OutlierSearch& search, BrickStages& stages) {
  const auto for_bricks = [&](const char* stage, const BrickCrew::Body& body) {
    stages.each(stage, plan.n_bricks(), body);
  };
  std::uint64_t left = search.n_points;
  const auto take = [&](BrickRemoval& found) {
    const std::uint64_t n = found.count();
    if (n == 0 || left < n + kFewestPoints) return false;
    for_bricks("outliers", [&](std::size_t brick) { found.remove(brick); });
    left -= n;
    return true;
  };
  for (int pass = 0; pass < kOutlierPasses; ++pass) {
    BrickRemoval look(store, plan, "outliers-" + std::to_string(pass));
    for_bricks("outliers", [&](std::size_t brick) {
      if (look.has_found(brick)) return;
      const BrickScene scene = search.load(brick);
      look.put(brick, of_own(scene, find_outliers(*scene.tree, scene.points, scene.normals,
                                                  search.noise, stages.context())));
    });
    if (pass == 0 && look.count() > search.most) {
      if (!search.suspects) return 0;
      BrickRemoval both(store, plan, "suspects");
      for_bricks("outliers", [&](std::size_t brick) {
        if (both.has_found(brick)) return;
        const std::vector<std::uint8_t> all = look.flags(brick);
        std::vector<std::uint8_t> flags(all.size(), 0);
        for (const std::uint32_t i : search.suspects(brick)) flags.at(i) = all.at(i);
        both.put(brick, flags);
      });
      take(both);
      return search.n_points - left;
    }
    if (!take(look)) break;
  }
  BrickRemoval small(store, plan, "groups");
  BrickGroups groups(store, plan.n_bricks());
  for_bricks("groups", [&](std::size_t brick) {
    if (!small.has_found(brick) && !groups.has(brick)) {
      groups.find(brick, search.load(brick), stages.context());
    }
  });
  bool joined = false;  // where it is needed: the groups of a run before may be gone
  for_bricks("groups", [&](std::size_t brick) {
    if (small.has_found(brick)) return;
    if (!joined) groups.join(least_group(left));
    joined = true;
    small.put(brick, groups.small(brick));
  });
  take(small);
  for_bricks("groups", [&](std::size_t brick) { groups.remove(brick); });
  return search.n_points - left;
}

}  // namespace rholm
