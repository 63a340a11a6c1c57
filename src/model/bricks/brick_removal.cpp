#include "model/bricks/brick_removal.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/bricks/brick_halo.h"
#include "model/bricks/brick_mending.h"
#include "model/bricks/brick_normals.h"
#include "model/bricks/brick_points.h"
#include "rholm/error.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"
#include "shape/points/strays.h"

namespace rholm {

BrickRemoval::BrickRemoval(PieceStore& store, const BrickPlan& plan, std::string name)
    : store_(store), plan_(plan), name_(std::move(name)) {}

std::string BrickRemoval::found(std::size_t brick) const {
  return "found-" + name_ + "/" + std::to_string(brick);
}

std::string BrickRemoval::done(std::size_t brick) const {
  return "removed-" + name_ + "/" + std::to_string(brick);
}

bool BrickRemoval::has_found(std::size_t brick) const {
  return store_.has(found(brick)) || store_.has(done(brick));
}

std::vector<std::uint8_t> BrickRemoval::flags(std::size_t brick) const {
  return store_.open(found(brick)).values<std::uint8_t>(1);
}

void BrickRemoval::put(std::size_t brick, const std::vector<std::uint8_t>& flags) {
  const auto n = static_cast<std::uint64_t>(std::count(flags.begin(), flags.end(), 1));
  const std::span<const std::byte> sections[] = {bytes_of(std::span(&n, 1)), bytes_of(flags)};
  store_.write(found(brick), sections);
}

// Others of the crew may remove points at the same time.
PieceReader BrickRemoval::head(std::size_t brick) const {
  if (store_.has(done(brick))) return store_.open(done(brick));
  try {
    return store_.open(found(brick));
  } catch (const Error&) {
    if (!store_.has(done(brick))) throw;
  }
  return store_.open(done(brick));
}

std::uint64_t BrickRemoval::count() const {
  std::uint64_t sum = 0;
  for (std::size_t brick = 0; brick < plan_.n_bricks(); ++brick) {
    sum += head(brick).values<std::uint64_t>(0).at(0);
  }
  return sum;
}

void BrickRemoval::remove(std::size_t brick) {
  if (store_.has(done(brick))) return;
  const PieceReader piece = store_.open(found(brick));
  const std::vector<std::byte> n = piece.read(0);
  if (vector_of<std::uint64_t>(n).at(0) > 0) {
    // A run that was stopped may have done a part of it.
    const std::vector<std::uint8_t> gone = piece.values<std::uint8_t>(1);
    if (have_normals(store_) && read_normals(store_, brick).size() == gone.size()) {
      remove_normals(store_, brick, gone);
    }
    if (have_turned(store_) && read_turned(store_, brick).size() == gone.size()) {
      remove_turned(store_, brick, gone);
    }
    if (read_index(store_, brick).counts.points == gone.size()) remove_points(store_, brick, gone);
  }
  store_.write(done(brick), {n});
  store_.remove(found(brick));
}

std::vector<std::uint8_t> find_brick_strays(const PieceStore& store, const BrickPlan& plan,
                                            std::size_t brick, double halo,
                                            const Context& context) {
  const BrickAndHalo read = read_with_halo(store, plan, brick, halo);
  std::vector<std::uint8_t> flags(read.n_own, 0);
  std::vector<std::uint32_t> left(read.cloud.points.size());  // of the cloud, after each look
  std::iota(left.begin(), left.end(), 0U);
  for (int pass = 0; pass < kStrayPasses && !left.empty(); ++pass) {
    std::vector<Vec3> places, points;
    for (const std::uint32_t i : left) places.push_back(read.cloud.points[i]);
    const PointTree tree(places, context);
    for (const std::uint32_t i : tree.order()) points.push_back(places[i]);
    const SamplingGaps gaps = find_gaps(tree, points, {}, context);
    const std::vector<std::uint8_t> found = find_strays(tree, points, gaps, context);
    if (std::find(found.begin(), found.end(), 1) == found.end()) break;
    std::vector<std::uint8_t> gone(left.size(), 0);
    for (std::size_t i = 0; i < found.size(); ++i) gone[tree.order()[i]] = found[i];
    std::vector<std::uint32_t> rest;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (gone[k] == 0) rest.push_back(left[k]);
      if (gone[k] != 0 && left[k] < read.n_own) flags[left[k]] = 1;
    }
    left = std::move(rest);
  }
  return flags;
}

}  // namespace rholm
