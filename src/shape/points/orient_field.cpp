#include "shape/points/orient_field.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "shape/points/gauss_field.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {
namespace {

// Largest number of points of the first sample; a finer sample has up to four times
// as many. Chosen: a second.
constexpr std::size_t kFirst = 6000;
// Least spacing: nearer points are one place in single precision, and each coarser sample must
// be smaller than the last.
constexpr double kLeastSpacing = 1e-5;
// Numbers of steps, and first and last widths of patches in spacings. Twice as many steps change
// nothing visible. From 4 spacings, thin sheets are lost; down to 0.3, the points' pattern shows.
constexpr int kSteps = 40, kStepsFiner = 10;
constexpr double kWidest = 2, kWidestFiner = 1, kNarrowest = 0.4;

double length2(std::span<const double> v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return sum;
}

}  // namespace

// The points of one level with their area normals.
class FieldSample {
 public:
  FieldSample(const std::vector<Vec3>& points, const Context& context)
      : tree_(points, context), points_(points.size()), spacing_(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) points_[i] = points[tree_.order()[i]];
    parallel_for(points.size(), 256, context, {}, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> near;
      for (std::size_t i = begin; i < end; ++i) {
        tree_.nearest_to(i, kCircle + 1, near);
        spacing_[i] = spacing_of_circle(near.back().distance2);
      }
    });
    std::vector<double> areas(points.size());
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = spacing_[i] * spacing_[i];
    area_normals_.resize(points.size());
    field_.emplace(tree_, points_, areas, context);
  }
  FieldSample(const FieldSample&) = delete;
  FieldSample& operator=(const FieldSample&) = delete;

  // Starts with the directions of a coarser sample.
  void begin_with(const FieldSample& coarser, const Context& context) {
    area_normals_ = coarser.fall_at(tree_, points_, spacing_, context);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      area_normals_[i] = spacing_[i] * spacing_[i] * normalized(area_normals_[i]);
    }
  }

  void improve(double from, double to, int steps, const Context& context) {
    std::vector<double> widths(points_.size());
    for (int k = 0; k < steps; ++k) {
      const double width = from * std::pow(to / from, k / (steps - 1.0));
      for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = width * spacing_[i];
      field_->set_widths(widths);
      descend(context);
      follow(context);
    }
  }

  std::vector<Vec3> fall_at(const PointTree& tree, std::span<const Vec3> places,
                            std::span<const double> widths, const Context& context) const {
    return field_->fall_at(tree, places, widths, area_normals_, context);
  }

 private:
  // Makes a step of steepest descent of sum (w - 1/2)^2 over the points.
  void descend(const Context& context) {
    std::vector<double> rest = field_->winding(area_normals_, context);
    for (double& r : rest) r = 0.5 - r;
    const std::vector<Vec3> step = field_->adjoint(rest, context);
    const std::vector<double> change = field_->winding(step, context);
    double gain = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) gain += rest[i] * change[i];
    const double size = length2(change);
    if (!(size > 0)) return;
    for (std::size_t i = 0; i < rest.size(); ++i) area_normals_[i] += gain / size * step[i];
  }

  // Turns every normal into the direction of the gradient.
  void follow(const Context& context) {
    const std::vector<Vec3> fall = field_->fall(area_normals_, context);
    for (std::size_t i = 0; i < fall.size(); ++i) {
      if (norm(fall[i]) > 0) area_normals_[i] = norm(area_normals_[i]) * normalized(fall[i]);
    }
  }

  PointTree tree_;
  std::vector<Vec3> points_;  // in the order of the tree
  std::vector<double> spacing_;
  std::vector<Vec3> area_normals_;
  std::optional<GaussField> field_;
};

namespace {

std::vector<std::vector<std::uint32_t>> make_levels(const PointTree& tree,
                                                    std::span<const Vec3> points,
                                                    std::span<const double> spacing, double first) {
  std::vector<std::vector<std::uint32_t>> levels;
  std::vector<double> reach(points.size());
  for (double part = first;; part *= kFiner) {
    for (std::size_t i = 0; i < reach.size(); ++i) {
      reach[i] = part * std::max(spacing[i], kLeastSpacing);
    }
    std::vector<std::uint32_t> level = thin_out(tree, points, reach);
    const std::size_t n = level.size();
    if (n <= kMostOfField) levels.push_back(std::move(level));
    if (n <= kFirst) return levels;
  }
}

}  // namespace

std::vector<std::uint32_t> thin_out(const PointTree& tree, std::span<const Vec3> points,
                                    std::span<const double> reach) {
  std::vector<std::uint8_t> gone(points.size(), 0);
  std::vector<std::uint32_t> kept;
  std::vector<Neighbor> near;
  CancelPoll poll;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    poll();
    if (gone[i] != 0) continue;
    kept.push_back(i);
    tree.within(points[i], reach[i], near);
    for (const Neighbor& other : near) gone[other.index] = 1;
  }
  return kept;
}

SolvedField::SolvedField(const PointTree& tree, std::span<const Vec3> points,
                         std::span<const double> spacing, double part, const Context& context) {
  const std::vector<std::vector<std::uint32_t>> levels = make_levels(tree, points, spacing, part);
  for (std::size_t level = levels.size(); level-- > 0;) {
    const double done = static_cast<double>(level) / static_cast<double>(levels.size());
    report_progress(context, "signs", 0.9 - 0.4 * done);
    std::vector<Vec3> chosen;
    for (const std::uint32_t i : levels[level]) chosen.push_back(points[i]);
    auto sample = std::make_unique<FieldSample>(chosen, context);
    if (sample_) sample->begin_with(*sample_, context);
    sample->improve(sample_ ? kWidestFiner : kWidest, kNarrowest, sample_ ? kStepsFiner : kSteps,
                    context);
    sample_ = std::move(sample);
  }
}

SolvedField::~SolvedField() = default;
SolvedField::SolvedField(SolvedField&&) noexcept = default;
SolvedField& SolvedField::operator=(SolvedField&&) noexcept = default;

std::vector<Vec3> SolvedField::normals_at(const PointTree& tree, std::span<const Vec3> points,
                                          std::span<const double> spacing, double width,
                                          const Context& context) const {
  std::vector<double> widths(spacing.begin(), spacing.end());
  for (double& w : widths) w *= width;
  return sample_->fall_at(tree, points, widths, context);
}

std::vector<Vec3> field_normals(const PointTree& tree, std::span<const Vec3> points,
                                std::span<const double> spacing, double width,
                                const Context& context) {
  return SolvedField(tree, points, spacing, kThinned, context)
      .normals_at(tree, points, spacing, width, context);
}

}  // namespace rholm
