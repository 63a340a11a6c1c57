// The generalised winding number of oriented points. Layer: shape.
//
// Points p_j that stand for patches of a surface, with area normals a_j (unit outward normal times
// area), have at x the winding number (Barill, Dickson, Schmidt, Levin, Jacobson 2018)
//   w(x) = 1/(4 pi) sum_j a_j . (p_j - x) / |p_j - x|^3:
// near 1 inside a closed surface, near 0 outside, and between the two where the surface has holes.
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

// w at each of x, as WindingTree::winding() has it.
using WindingNumbers = std::function<std::vector<double>(std::span<const Vec3> x, double opening)>;
// Where nothing is known of the precision that is needed.
inline constexpr double kWindingOpening = 2;

// Holds the points with their patches.
struct WindingBall {
  Vec3 center;
  double radius = 0;
};

class WindingTree {
 public:
  // One area normal per point. Throws InvalidInput if one is not finite, or their numbers differ.
  WindingTree(std::span<const Vec3> points, std::span<const Vec3> area_normals);

  // Other normals for the same points: a pass over the tree, cheaper than a new one.
  void set_area_normals(std::span<const Vec3> area_normals);

  // w at each of x. A set of points is replaced by its dipole, first and second moments where it
  // is seen from more than `opening` times its radius: the error falls with its cube. Closer to a
  // point than its patch's radius e = sqrt(area / pi) the denominator is e^3: over an even sheet w
  // then changes from 0 to 1 by the smooth step 1/2 - (3 t - t^3) / 4, t = height / e, and is the
  // sheet's own beyond.
  // Fastest where x are many near each other, in any order; the result at one of them does not
  // depend on the others, nor on the number of threads. `opening` must be at least 1.
  std::vector<double> winding(std::span<const Vec3> x, const Context& context = {},
                              double opening = kWindingOpening) const;
  // The first levels of the tree, without points: the same numbers where has_all().
  WindingTree top(int levels) const;
  // Whether a place is so far from all that top() has left out that it is not asked there.
  bool has_all(const Vec3& x, double opening) const;
  // The same as a function; good as long as the tree.
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
  std::vector<std::uint32_t> order_;   // index of each of points_
  std::vector<WindingPoint> points_;   // along a Morton curve
  std::vector<WindingNode> nodes_;     // parents before children
  std::vector<WindingBall> left_out_;  // what is below nodes of top(), and on leaves, there
};

}  // namespace rholm
