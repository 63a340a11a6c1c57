#include "reconstruct/cloud/tile_removal.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "reconstruct/normals/tile_mending.h"
#include "reconstruct/normals/tile_normals.h"
#include "reconstruct/points/tile_points.h"
#include "rholm/error.h"
#include "shape/points/isolated_points.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

TileRemoval::TileRemoval(PieceStore& store, const TilePlan& plan, std::string name)
    : store_(store), plan_(plan), name_(std::move(name)) {}

std::string TileRemoval::found(std::size_t tile) const {
  return "found-" + name_ + "/" + std::to_string(tile);
}

std::string TileRemoval::done(std::size_t tile) const {
  return "removed-" + name_ + "/" + std::to_string(tile);
}

bool TileRemoval::has_found(std::size_t tile) const {
  return store_.has(found(tile)) || store_.has(done(tile));
}

std::vector<std::uint8_t> TileRemoval::flags(std::size_t tile) const {
  return store_.open(found(tile)).values<std::uint8_t>(1);
}

void TileRemoval::put(std::size_t tile, const std::vector<std::uint8_t>& flags) {
  const auto n = static_cast<std::uint64_t>(std::count(flags.begin(), flags.end(), 1));
  const std::span<const std::byte> sections[] = {bytes_of(std::span(&n, 1)), bytes_of(flags)};
  store_.write(found(tile), sections);
}

// Other processes may remove points at the same time.
PieceReader TileRemoval::head(std::size_t tile) const {
  if (store_.has(done(tile))) return store_.open(done(tile));
  try {
    return store_.open(found(tile));
  } catch (const Error&) {
    if (!store_.has(done(tile))) throw;
  }
  return store_.open(done(tile));
}

std::uint64_t TileRemoval::count() const {
  std::uint64_t sum = 0;
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    sum += head(tile).values<std::uint64_t>(0).at(0);
  }
  return sum;
}

void TileRemoval::remove(std::size_t tile) {
  if (store_.has(done(tile))) return;
  const PieceReader piece = store_.open(found(tile));
  const std::vector<std::byte> n = piece.read(0);
  if (vector_of<std::uint64_t>(n).at(0) > 0) {
    // A run that was stopped may have done a part of it.
    const std::vector<std::uint8_t> gone = piece.values<std::uint8_t>(1);
    if (have_normals(store_) && read_normals(store_, tile).size() == gone.size()) {
      remove_normals(store_, tile, gone);
    }
    if (have_turned(store_) && read_turned(store_, tile).size() == gone.size()) {
      remove_turned(store_, tile, gone);
    }
    if (read_index(store_, tile).counts.points == gone.size()) remove_points(store_, tile, gone);
  }
  store_.write(done(tile), {n});
  store_.remove(found(tile));
}

std::vector<std::uint8_t> find_isolated_in_tile(const TileScene& scene, int looks,
                                                const Context& context,
                                                std::vector<std::uint32_t>* neighbors) {
  std::vector<std::uint8_t> flags(scene.n_own, 0);
  if (scene.points.empty()) return flags;
  const auto flag = [&](std::uint32_t i) {
    const std::uint32_t given = scene.tree->order()[i];
    if (given < scene.n_own) flags[given] = 1;
  };
  std::vector<std::uint8_t> found =
      find_isolated_points(*scene.tree, scene.points, scene.gaps, context, neighbors);
  std::vector<std::uint32_t> left(found.size());  // of the scene, after each look
  std::iota(left.begin(), left.end(), 0U);
  for (int pass = 1;; ++pass) {
    std::vector<std::uint32_t> rest;
    for (std::size_t k = 0; k < left.size(); ++k) {
      found[k] == 0 ? rest.push_back(left[k]) : flag(left[k]);
    }
    if (rest.size() == left.size() || rest.empty() || pass == looks) break;
    std::vector<Vec3> places, points, normals;
    for (const std::uint32_t i : rest) places.push_back(scene.points[i]);
    const PointTree tree(places, context);
    for (const std::uint32_t k : tree.order()) {
      points.push_back(places[k]);
      if (!scene.normals.empty()) normals.push_back(scene.normals[rest[k]]);
    }
    const SamplingGaps gaps = find_gaps(tree, points, normals, context);
    const std::vector<std::uint8_t> seen = find_isolated_points(tree, points, gaps, context);
    found.assign(rest.size(), 0);
    for (std::size_t k = 0; k < seen.size(); ++k) found[tree.order()[k]] = seen[k];
    left = std::move(rest);
  }
  return flags;
}

}  // namespace rholm
