#include "reconstruct/cloud/tile_outliers.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "reconstruct/cloud/tile_removal.h"
#include "reconstruct/points/reconstruct_rules.h"
#include "shape/points/outliers.h"

namespace rholm {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::string name_of(std::size_t tile) { return "groups/" + std::to_string(tile); }

// Points of the cloud that belong to the halo, with their tiles and their places in them.
std::vector<std::pair<std::uint32_t, std::uint32_t>> names_of_halo(const TileScene& scene) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> names;
  for (const TileAndHalo::Part& part : scene.halo) {
    for (const std::uint32_t place : part.places) {
      names.emplace_back(static_cast<std::uint32_t>(part.tile), place);
    }
  }
  return names;
}

// Returns one flag per own point, in the order of the points in the store.
std::vector<std::uint8_t> of_own(const TileScene& scene, const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint8_t> own(scene.n_own, 0);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const std::uint32_t given = scene.tree->order()[i];
    if (given < scene.n_own) own[given] = flags[i];
  }
  return own;
}

}  // namespace

bool TileGroups::has(std::size_t tile) const { return store_.has(name_of(tile)); }

void TileGroups::remove(std::size_t tile) { store_.remove(name_of(tile)); }

void TileGroups::find(std::size_t tile, const TileScene& scene, const Context& context) {
  const auto halo = names_of_halo(scene);
  DisjointSets sets(scene.n_own);
  std::vector<Link> links;
  const auto visit = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t own = scene.tree->order()[i], other = scene.tree->order()[j];
    if (own >= scene.n_own) return;  // the other tile knows
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
  store_.write(name_of(tile), sections);
}

void TileGroups::join(std::uint64_t least) {
  std::vector<std::uint32_t> first(1, 0);
  std::vector<std::uint64_t> sizes;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    for (const std::uint32_t n : store_.open(name_of(tile)).values<std::uint32_t>(1)) {
      sizes.push_back(n);
    }
    first.push_back(static_cast<std::uint32_t>(sizes.size()));
  }
  DisjointSets sets(sizes.size());
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    std::uint32_t other = kNone;
    std::vector<std::uint32_t> groups;  // of its points
    for (const Link& link : store_.open(name_of(tile)).values<Link>(2)) {
      if (link.tile != other) {
        other = link.tile;
        groups = store_.open(name_of(other)).values<std::uint32_t>(0);
      }
      sets.unite(first[tile] + link.group, first[other] + groups.at(link.point));
    }
  }
  for (std::uint32_t g = 0; g < sizes.size(); ++g) {
    const std::uint32_t whole = sets.find(g);
    if (whole != g) sizes[whole] += sizes[g];
  }
  small_.assign(n_tiles_, {});
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    for (std::uint32_t g = first[tile]; g < first[tile + 1]; ++g) {
      small_[tile].push_back(sizes[sets.find(g)] < least ? 1 : 0);
    }
  }
}

std::vector<std::uint8_t> TileGroups::small(std::size_t tile) const {
  std::vector<std::uint8_t> flags;
  for (const std::uint32_t g : store_.open(name_of(tile)).values<std::uint32_t>(0)) {
    flags.push_back(small_[tile].at(g));
  }
  return flags;
}

std::uint64_t remove_tile_outliers(PieceStore& store, const TilePlan& plan,
                                   const OutlierSearch& search, Stages& stages) {
  const auto for_tiles = [&](const char* stage, const Stages::Body& body) {
    stages.each(stage, plan.n_tiles(), body);
  };
  std::uint64_t left = search.n_points;
  const auto take = [&](TileRemoval& found) {
    const std::uint64_t n = found.count();
    if (n == 0 || left < n + kFewestPoints) return false;
    for_tiles("outliers", [&](std::size_t tile) { found.remove(tile); });
    search.changed();
    left -= n;
    return true;
  };
  for (int pass = 0; pass < kOutlierPasses; ++pass) {
    TileRemoval look(store, plan, "outliers-" + std::to_string(pass));
    for_tiles("outliers", [&](std::size_t tile) {
      if (look.has_found(tile)) return;
      const auto scene = search.load(tile);
      look.put(tile, of_own(*scene, find_outliers(*scene->tree, scene->points, scene->normals,
                                                  search.noise, stages.context())));
    });
    if (pass == 0 && look.count() > search.most) {
      if (!search.suspects) return 0;
      TileRemoval both(store, plan, "suspects");
      for_tiles("outliers", [&](std::size_t tile) {
        if (both.has_found(tile)) return;
        const std::vector<std::uint8_t> all = look.flags(tile);
        std::vector<std::uint8_t> flags(all.size(), 0);
        for (const std::uint32_t i : search.suspects(tile)) flags.at(i) = all.at(i);
        both.put(tile, flags);
      });
      take(both);
      return search.n_points - left;
    }
    if (!take(look)) break;
  }
  TileRemoval small(store, plan, "groups");
  TileGroups groups(store, plan.n_tiles());
  for_tiles("groups", [&](std::size_t tile) {
    if (!small.has_found(tile) && !groups.has(tile)) {
      groups.find(tile, *search.load(tile), stages.context());
    }
  });
  bool joined = false;  // where it is needed: the groups of a run before may be gone
  for_tiles("groups", [&](std::size_t tile) {
    if (small.has_found(tile)) return;
    if (!joined) groups.join(least_group(left));
    joined = true;
    small.put(tile, groups.small(tile));
  });
  take(small);
  for_tiles("groups", [&](std::size_t tile) { groups.remove(tile); });
  return search.n_points - left;
}

}  // namespace rholm
