// Gauss's integral over points that stand for patches of a surface, its adjoint and its gradient.
// Layer: shape.
//
// Points p_j with area normals a_j have at x the winding number
//   w(x) = 1/(4 pi) sum_j a_j . (p_j - x) / d^3,  d = max(|p_j - x|, s),
// s the width of a patch. WindingTree has w more exactly, at any places; this has the
// adjoint and the gradient too, for many passes over the points themselves: in single precision,
// places of a leaf together, and a set seen from more than twice its radius is replaced by the sum
// of its normals at its middle. The error is a few hundredths.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/gauss_kernels.h"
#include "shape/points/point_tree.h"

namespace rholm {

class GaussField {
 public:
  // Points of order 1, in the order of the tree, which is kept by reference; `areas` weigh the
  // middles of sets.
  GaussField(const PointTree& tree, std::span<const Vec3> points, std::span<const double> areas,
             const Context& context);

  std::size_t size() const { return points_.size(); }
  // One per point, positive.
  void set_widths(std::span<const double> widths);

  // w at every point; its own patch has no part in it.
  std::vector<double> winding(std::span<const Vec3> area_normals, const Context& context) const;
  // The adjoint of that: sum_i r_i (p_j - p_i) / d^3 / (4 pi) at every point j.
  std::vector<Vec3> adjoint(std::span<const double> r, const Context& context) const;
  // Minus the gradient of w at every point: it points outwards.
  std::vector<Vec3> fall(std::span<const Vec3> area_normals, const Context& context) const;
  // The same at other places, in the order of another tree over them, with their own widths.
  std::vector<Vec3> fall_at(const PointTree& tree, std::span<const Vec3> places,
                            std::span<const double> widths, std::span<const Vec3> area_normals,
                            const Context& context) const;

 private:
  // A set of leaves of the tree, by levels from leaves to the root.
  struct Node {
    std::array<float, 3> middle;
    float radius = 0;
  };
  struct Strengths;  // of points and nodes
  struct List;       // of the sources for one group of places
  Strengths strengths(std::span<const Vec3> a) const;
  void gather(const std::array<float, 3>& middle, float radius, const Strengths& strengths,
              List& list) const;
  template <typename Visit>
  void for_places(const PointTree& tree, std::span<const std::array<float, 3>> places,
                  const Strengths& strengths, const Context& context, const Visit& visit) const;

  const PointTree& tree_;
  std::vector<std::array<float, 3>> points_;
  std::vector<double> areas_;
  std::vector<float> width2_;
  std::vector<Node> nodes_;               // level by level, leaves first
  std::vector<std::size_t> level_begin_;  // in nodes_
};

}  // namespace rholm
