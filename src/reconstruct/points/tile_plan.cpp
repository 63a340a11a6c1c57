#include "reconstruct/points/tile_plan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::array<double Vec3::*, 3> kAxes = {&Vec3::x, &Vec3::y, &Vec3::z};
// Divisor of the number of points: the smaller side of a cut has this share of them at least. Where
// many points have one coordinate, another axis is better.
constexpr std::size_t kLeastShare = 4;

Bounds box_of(std::span<const Vec3> points) {
  Bounds box{.min = points[0], .max = points[0]};
  for (const Vec3& p : points) {
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  return box;
}

}  // namespace

class PlanMaker {
 public:
  PlanMaker(std::vector<Vec3> sample, const PlaceLattice& lattice, double most)
      : sample_(std::move(sample)), lattice_(lattice), most_(most) {}

  // `most` is the number of sampled points that stand for a full tile.
  TilePlan make() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const Vec3 far{kInfinity, kInfinity, kInfinity};
    plan_.root_ = split(sample_, {.min = -far, .max = far});
    return std::move(plan_);
  }

 private:
  struct Place {
    std::size_t axis = 0;
    double at = 0;
    std::size_t smaller = 0;  // points on the smaller side
  };

  std::uint32_t split(std::span<Vec3> points, const Bounds& cell) {
    Place best;
    if (static_cast<double>(points.size()) > most_ && points.size() > 1) best = find_cut(points);
    if (best.smaller == 0) {
      plan_.cells_.push_back(cell);
      return TilePlan::kLeaf | static_cast<std::uint32_t>(plan_.cells_.size() - 1);
    }
    double Vec3::*const axis = kAxes[best.axis];
    const auto middle = std::partition(points.begin(), points.end(),
                                       [&](const Vec3& p) { return p.*axis < best.at; });
    const auto below = static_cast<std::size_t>(middle - points.begin());
    const auto index = static_cast<std::uint32_t>(plan_.cuts_.size());
    plan_.cuts_.push_back({.place = best.at, .axis = axis});
    Bounds lower = cell, upper = cell;
    lower.max.*axis = upper.min.*axis = best.at;
    const std::uint32_t first = split(points.first(below), lower);
    const std::uint32_t second = split(points.subspan(below), upper);
    plan_.cuts_[index].sides[0] = first;
    plan_.cuts_[index].sides[1] = second;
    return index;
  }

  // Returns the median across the longest side, or across the next one, or the best of all.
  Place find_cut(std::span<const Vec3> points) {
    const Vec3 size = [&] {
      const Bounds box = box_of(points);
      return box.max - box.min;
    }();
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return size.*kAxes[a] > size.*kAxes[b]; });
    Place best;
    for (const std::size_t axis : order) {
      const Place found = find_cut_across(points, axis);
      if (found.smaller > best.smaller) best = found;
      if (best.smaller >= points.size() / kLeastShare) break;
    }
    return best;
  }

  // Cuts before the cell of the median or behind it, whichever is more even.
  Place find_cut_across(std::span<const Vec3> points, std::size_t axis) {
    values_.clear();
    for (const Vec3& p : points) values_.push_back(p.*kAxes[axis]);
    const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
    std::nth_element(values_.begin(), middle, values_.end());
    const double before = lattice_.begin_of_cell(*middle, kAxes[axis]);
    const double cell = lattice_.cell_of(*middle, kAxes[axis]);
    double behind = std::numeric_limits<double>::infinity();
    for (const double value : values_) {
      const bool beyond =
          lattice_.has_cells() ? lattice_.cell_of(value, kAxes[axis]) > cell : value > *middle;
      if (beyond) behind = std::min(behind, value);
    }
    Place best;
    for (double at : {before, behind}) {
      if (at == behind && behind < std::numeric_limits<double>::infinity()) {
        at = lattice_.begin_of_cell(behind, kAxes[axis]);
      }
      const auto below = static_cast<std::size_t>(
          std::count_if(values_.begin(), values_.end(), [&](double v) { return v < at; }));
      const std::size_t smaller = std::min(below, values_.size() - below);
      if (smaller > best.smaller) best = {.axis = axis, .at = at, .smaller = smaller};
    }
    return best;
  }

  std::vector<Vec3> sample_;
  const PlaceLattice& lattice_;
  double most_;
  std::vector<double> values_;
  TilePlan plan_;
};

std::vector<std::size_t> TilePlan::tiles_meeting(const Bounds& box) const {
  std::vector<std::size_t> found;
  std::vector<std::uint32_t> left = {root_};
  while (!left.empty()) {
    const std::uint32_t at = left.back();
    left.pop_back();
    if ((at & kLeaf) != 0) {
      found.push_back(at & ~kLeaf);
      continue;
    }
    const Cut& cut = cuts_[at];
    if (box.max.*cut.axis >= cut.place) left.push_back(cut.sides[1]);
    if (box.min.*cut.axis < cut.place) left.push_back(cut.sides[0]);
  }
  return found;
}

TilePlan make_plan(std::span<const Vec3> sample, const PlaceLattice& lattice, double n_points,
                   double points_per_tile) {
  if (!(points_per_tile >= 1)) {
    throw Error(ErrorCode::kInvalidInput, "a tile needs room for one point at least");
  }
  const double share = points_per_tile / n_points;
  return PlanMaker({sample.begin(), sample.end()}, lattice,
                   share * static_cast<double>(sample.size()))
      .make();
}

TilePlan make_plan(const Survey& survey, std::uint64_t points_per_tile) {
  const auto all = static_cast<double>(survey.points);
  const auto most = static_cast<double>(points_per_tile);
  return make_plan(survey.sample, PlaceLattice(survey.bounds),
                   all <= most ? all : std::min(all, survey.n_different), most);
}

}  // namespace rholm
