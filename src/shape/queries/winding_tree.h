// Computes the generalised winding number of oriented points. Layer: shape.
//
// Points p_j stand for patches of a surface, with area normals a_j (unit outward normal times
// area). They have at x the winding number (Barill, Dickson, Schmidt, Levin, Jacobson 2018)
//   w(x) = 1/(4 pi) sum_j a_j . (p_j - x) / |p_j - x|^3,
// near 1 inside a closed surface, near 0 outside, and between 0 and 1 where the surface has holes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/queries/winding_kernels.h"

namespace rholm {

// Returns w at each of x, as WindingTree::winding() does.
using WindingNumbers = std::function<std::vector<double>(std::span<const Vec3> x, double opening)>;
// The opening to use if the required precision is not known.
inline constexpr double kWindingOpening = 2;

// A ball that contains some points with their patches.
struct WindingBall {
  Vec3 center;
  double radius = 0;
};

class WindingTree {
 public:
  // Takes one area normal per point. Throws InvalidInput if one is not finite or numbers differ.
  WindingTree(std::span<const Vec3> points, std::span<const Vec3> area_normals);

  // Sets other normals for the same points: a pass over the tree, cheaper than a new tree.
  void set_area_normals(std::span<const Vec3> area_normals);

  // Returns w at each of x. A set of points seen from more than `opening` times its radius
  // is replaced by its dipole, first and second moments; the error falls with the cube of
  // `opening`. Closer to a point than its patch's radius e = sqrt(area / pi), the
  // denominator is e^3. So w changes over an even sheet by the smooth step 1/2 - (3 t - t^3)
  // / 4, t = height / e, and is exact beyond. It is fastest for many x near each other, in
  // any order. Each result depends neither on the other x nor on the number of threads.
  // `opening` must be at least 1.
  std::vector<double> winding(std::span<const Vec3> x, const Context& context = {},
                              double opening = kWindingOpening) const;
  // Returns the first levels of the tree, without points; equal results where has_all() is true.
  WindingTree top(int levels) const;
  // Returns true if x is so far from all nodes left out by top() that they are not needed.
  bool has_all(const Vec3& x, double opening) const;
  // Returns winding() as a function, which is valid as long as the tree.
  WindingNumbers numbers(const Context& context = {}) const;

 private:
  WindingTree() = default;
  struct Key {
    std::uint64_t morton;
    std::uint32_t index;
  };
  static std::vector<Key> sorted_keys(std::span<const Vec3> local, const Context& context);
  void split(std::span<const Key> keys, std::uint32_t begin, std::uint32_t end, int level);
  void sum_moments();

  Vec3 middle_;
  double scale_ = 1;                   // the points lie in -1 ... 1
  std::vector<std::uint32_t> order_;   // original index of each of points_
  std::vector<WindingPoint> points_;   // along a Morton curve
  std::vector<WindingNode> nodes_;     // parents before children
  std::vector<WindingBall> left_out_;  // in top(): around left-out subtrees and leaves
};

}  // namespace rholm
