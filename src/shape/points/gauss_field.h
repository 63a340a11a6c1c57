// Computes Gauss's integral over points that stand for patches of a surface, its adjoint and its
// gradient. Layer: shape.
//
// Points p_j with area normals a_j have the winding number
//   w(x) = 1/(4 pi) sum_j a_j . (p_j - x) / d^3,  d = max(|p_j - x|, s),
// where s is the width of a patch. WindingTree computes w more exactly, at any places. This class
// is made for many passes over the points, in single precision, and evaluates all places of a leaf
// together. A set seen from more than twice its radius is replaced by the sum of its normals at its
// middle. The error is a few hundredths.
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
  // `points`: coordinates of order 1, in the order of the tree. The tree is kept by reference.
  // `areas`: weights of the points for the middle of a set.
  GaussField(const PointTree& tree, std::span<const Vec3> points, std::span<const double> areas,
             const Context& context);

  std::size_t size() const { return points_.size(); }
  // Sets the width of each point's patch; `widths` are positive.
  void set_widths(std::span<const double> widths);

  // Returns w at every point, without the part of the point's own patch.
  std::vector<double> winding(std::span<const Vec3> area_normals, const Context& context) const;
  // Returns the adjoint of winding(): sum_i r_i (p_j - p_i) / d^3 / (4 pi) at every point j.
  std::vector<Vec3> adjoint(std::span<const double> r, const Context& context) const;
  // Returns minus the gradient of w at every point, a vector that points outwards.
  std::vector<Vec3> fall(std::span<const Vec3> area_normals, const Context& context) const;
  // Returns fall() at other places, given in the order of another tree, with their own widths.
  std::vector<Vec3> fall_at(const PointTree& tree, std::span<const Vec3> places,
                            std::span<const double> widths, std::span<const Vec3> area_normals,
                            const Context& context) const;

 private:
  // A set of leaves of the tree. Levels of nodes go from the leaves to the root.
  struct Node {
    std::array<float, 3> middle;
    float radius = 0;
  };
  struct Strengths;  // vectors of points and nodes
  struct List;       // sources for one group of places
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
  std::vector<std::size_t> level_begin_;  // begin of each level in nodes_
};

}  // namespace rholm
