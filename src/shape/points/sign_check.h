// Whether given normals agree with those around them, and which of them to turn. Layer: shape.
//
// An edge of the graph of neighbours says that its ends agree, or that they contradict each other,
// where the normal of one end, reflected in the plane that halves the edge, is nearly that of the
// other, or nearly its opposite (orient_graph.h), and where the edge lies within the surface: no
// point is above the other. Edges that agree hold pieces together; a piece is turned as a whole, to
// agree with a larger one. So what is turned depends on the signs that most points have.
//
// Two walls nearer to each other than their points contradict each other as well. They are told by
// heights: over all edges between two pieces the mean height of one above the other is zero for one
// sheet, and the distance of the walls for two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

struct SignCheck {
  std::vector<std::uint8_t> turned = {};  // per point: 1 if it should be turned
  std::vector<std::uint32_t> component =
      {};  // per point: the first point of what edges hold together
  std::size_t n_turned = 0;
  // Points that contradict many of their neighbours, and the same once the others are turned.
  std::size_t contradicting = 0, left = 0;
  std::uint32_t first = 0, first_left = 0;  // of these points
  double scatter = 0;  // median height of neighbours above the tangent planes of points
};

// A point of some that stand for all, and the area that it stands for.
struct PointArea {
  std::uint32_t point = 0;
  double area = 0;
};

// Points and unit normals (zero: of no say) in the order of the tree. Of points that are `foreign`,
// if there are any, none is counted. Pieces that bound bodies by themselves, as their samples tell,
// are not turned to agree with each other: they touch.
SignCheck check_signs(const PointTree& tree, std::span<const Vec3> points,
                      std::span<const Vec3> normals, const SamplingGaps& gaps,
                      std::span<const PointArea> samples, std::span<const std::uint8_t> foreign,
                      const Context& context);

// Whether signs that say nothing about each other point the right way.
struct SideCheck {
  std::vector<std::uint32_t> turned = {};  // first points of components to be turned
  double inward = 0;  // share of the points at which the winding number contradicts the normal
};

// Components and scatter as in SignCheck. Closed components are turned where the mean of the
// winding numbers behind and before their points says that they should be: it is 1/2 of what is
// right, -1/2 of a body that faces inwards, 3/2 of a wall inside a body that faces as the outer
// one.
SideCheck check_sides(std::span<const Vec3> points, std::span<const Vec3> normals,
                      std::span<const PointArea> samples, double scatter,
                      std::span<const std::uint32_t> component, const Context& context);

}  // namespace rholm
