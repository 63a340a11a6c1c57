// Computes normals from the winding-number field of all points. Layer: shape.
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

// Returns outward vectors of any length, one per point: minus the gradient of a winding number
// that is 1/2 at the points. The least area normals with this property are found (parametric
// Gauss reconstruction of Lin, Xiao, Shi, Wang 2022) by steepest descent. Between its steps
// every normal takes the direction of the gradient (fixed point of Lin, Shi, Liu 2024), while
// the patches' widths fall.
//
// The first solution is for an even sample; finer samples start from it. `points`: of order 1,
// in the order of the tree. `spacing`: side of the square of a point in an even sampling, or
// the distance between rows. The gradient is computed for patches of `width` * spacing; noisy
// points need a larger width.
std::vector<Vec3> field_normals(const PointTree& tree, std::span<const Vec3> points,
                                std::span<const double> spacing, double width,
                                const Context& context);

// Solves the field of a sample of points once, and evaluates it at any places.
class FieldSample;
class SolvedField {
 public:
  // Solves as field_normals() does, for at most kMostOfField points. Points closer to another than
  // `part` of the spacing are thinned out.
  SolvedField(const PointTree& tree, std::span<const Vec3> points, std::span<const double> spacing,
              double part, const Context& context);
  ~SolvedField();
  SolvedField(SolvedField&&) noexcept;
  SolvedField& operator=(SolvedField&&) noexcept;

  // Returns vectors as field_normals(), at points of another tree, possibly in another frame.
  // Patches have the width `width` * spacing.
  std::vector<Vec3> normals_at(const PointTree& tree, std::span<const Vec3> points,
                               std::span<const double> spacing, double width,
                               const Context& context) const;

 private:
  std::unique_ptr<FieldSample> sample_;
};

// Largest number of points of a finer sample. For more points, only the field of a sample is
// evaluated (chosen: half a minute).
inline constexpr std::size_t kMostOfField = 200000;
// Points closer than this part of the spacing, for example in a row, add no information. Among 0,
// 0.3, 0.5 and 0.7, this value gives the most correct signs.
inline constexpr double kThinned = 0.3;
inline constexpr double kFiner = 2;  // ratio of the distances in a coarser and a finer sample

// Returns ascending indices of kept points. No kept point is within the `reach` of an earlier kept
// point, and every removed point is within the reach of one.
std::vector<std::uint32_t> thin_out(const PointTree& tree, std::span<const Vec3> points,
                                    std::span<const double> reach);

}  // namespace rholm
