// What points look like in the neighbourhoods of some of them: curve, surface, volume. Layer:
// shape.
//
// Neighbourhoods grow until most of them are flat: their third principal axis is short against the
// second, and the second is not short against the first. Those of a clean surface are flat at once,
// those of a noisy one as soon as they are wider than the noise, and those of points that fill a
// volume never. Points on a curve have neighbourhoods that are long, as have the rows of a scanner,
// until they reach other rows.
#pragma once

#include <cstddef>
#include <span>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

enum class LocalKind {
  kUnknown,  // too few points to say
  kSurface,
  kCurve,
  kVolume
};

struct LocalShape {
  LocalKind kind = LocalKind::kUnknown;
  std::size_t neighbors = 0;  // of the flattest neighbourhoods
  // Medians over these: the ratio of the standard deviations along the third and the second axis,
  // and along the second and the first.
  double thickness = 0, width = 0;
  // Fourth moment of the heights over the square of the second: 3 of Gaussian noise, 1.8 of points
  // spread evenly between two sheets.
  double kurtosis = 0;
  double crooked = 0;  // share of the flat ones whose plane is not across the point's normal
};

// Points in the order of the tree, and unit normals, or none. Where there are normals only
// neighbours on the same side count, so that the other wall of a thin body does not.
LocalShape look_at_shape(const PointTree& tree, std::span<const Vec3> points,
                         std::span<const Vec3> normals, const Context& context);

}  // namespace rholm
