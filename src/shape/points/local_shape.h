// Decides whether the neighbourhoods of some points look like a curve, a surface or a
// volume. Layer: shape.
//
// Neighbourhoods grow until most of them are flat: the third principal axis is short against
// the second, and the second is not short against the first. On a clean surface they are flat
// at once, on a noisy one as soon as they are wider than the noise. In a volume they are
// never flat. Neighbourhoods on a curve are long. So are neighbourhoods in rows of a scanner
// until they reach other rows.
#pragma once

#include <cstddef>
#include <span>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

enum class LocalKind {
  kUnknown,  // too few points to decide
  kSurface,
  kCurve,
  kVolume
};

struct LocalShape {
  LocalKind kind = LocalKind::kUnknown;
  std::size_t neighbors = 0;  // size of the flattest neighbourhoods
  // Medians over the flattest neighbourhoods. `thickness` is the ratio of the standard deviations
  // along the third and the second axis, `width` along the second and the first.
  double thickness = 0, width = 0;
  // Fourth moment of the heights over the square of the second moment: 3 for Gaussian noise, 1.8
  // for points spread evenly between two sheets.
  double kurtosis = 0;
  double crooked = 0;  // share of flat neighbourhoods tilted more than 45 degrees from the normal
};

// Returns the median kurtosis of the heights of k neighbours over their plane, as in LocalShape.
double kurtosis_of_heights(const PointTree& tree, std::span<const Vec3> points, std::size_t k,
                           const Context& context);

// Takes points in the order of the tree, with unit normals or none. With normals, only neighbours
// on the same sheet count; points of the opposite wall of a thin body do not.
LocalShape look_at_shape(const PointTree& tree, std::span<const Vec3> points,
                         std::span<const Vec3> normals, const Context& context);

}  // namespace rholm
