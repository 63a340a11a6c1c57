// Normals from the field of all points at once. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Vectors that point out of what the points bound, one for each, of any length: minus the gradient
// of a winding number that is 1/2 at the points. Area normals are found as the least ones that make
// it so (the parametric Gauss reconstruction of Lin, Xiao, Shi, Wang 2022), by steps of steepest
// descent, between which every normal takes the direction of the gradient there (the fixed point of
// Lin, Shi, Liu 2024), while the widths of the patches fall. No normal has to be known.
//
// The first solution is that of an even sample; finer ones begin with it. Points of order 1 in the
// order of the tree; `spacing`: the side of the square that a point would have if they were even,
// between rows where they lie in rows. The gradient is that of patches of `width` times that, which
// is to be more where points are noisy.
std::vector<Vec3> field_normals(const PointTree& tree, std::span<const Vec3> points,
                                std::span<const double> spacing, double width,
                                const Context& context);

// The field of a sample of points, solved once, asked at any places.
class FieldSample;
class SolvedField {
 public:
  // Of points of which none is nearer to another than `part` of its spacing, or that are thinned
  // out so far; at most kMostOfField of them. Otherwise as field_normals() does.
  SolvedField(const PointTree& tree, std::span<const Vec3> points, std::span<const double> spacing,
              double part, const Context& context);
  ~SolvedField();
  SolvedField(SolvedField&&) noexcept;
  SolvedField& operator=(SolvedField&&) noexcept;

  // At points in the order of another tree, which may be another frame's; patches are `width` times
  // their spacing.
  std::vector<Vec3> normals_at(const PointTree& tree, std::span<const Vec3> points,
                               std::span<const double> spacing, double width,
                               const Context& context) const;

 private:
  std::unique_ptr<FieldSample> sample_;
};

// A finer sample has at most so many points; beyond the field of one is asked at all (chosen: half
// a minute).
inline constexpr std::size_t kMostOfField = 200000;
// Points nearer than this part of the spacing say nothing new: points of one row. Of 0, 0.3, 0.5
// and 0.7 this has most signs right.
inline constexpr double kThinned = 0.3;
inline constexpr double kFiner = 2;  // times as far apart in a coarser sample

// Indices of points, rising, none of which is nearer to another than `reach` of the one that
// comes first, and all others are.
std::vector<std::uint32_t> thin_out(const PointTree& tree, std::span<const Vec3> points,
                                    std::span<const double> reach);

}  // namespace rholm
