// Sums many queries over a tree of dipoles, in the tree's frame; the inner loop of WindingTree.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rholm/vec3.h"

namespace rholm {

struct WindingPoint {
  Vec3 at;
  Vec3 area_normal;
  double least2 = 0;  // squared radius of the patch
};

// Coefficients of forms in r = (x, y, z).
using QuadraticForm = std::array<double, 6>;  // xx yy zz xy xz yz
using CubicForm = std::array<double, 10>;     // xxx yyy zzz xxy xxz xyy yyz xzz yzz xyz

// A node; parents precede their children. Sums are over the node's points, with area normals a and
// offsets o from the centre.
struct WindingNode {
  Vec3 center;
  Vec3 area_normal;                  // sum a
  QuadraticForm first{};             // sum (a . r) (o . r)
  CubicForm second{};                // sum (a . r) (o . r)^2
  Vec3 second_laplacian;             // the Laplacian of `second` is this . r
  double radius = 0;                 // radius of a ball around the centre with all patches
  std::uint32_t skip = 0;            // next node that is not below this one
  std::uint32_t begin = 0, end = 0;  // range of points
  bool leaf = false;
};

// Computes sums[i] = sum_j a_j . (p_j - x_i) / |p_j - x_i|^3; see WindingTree::winding().
void sum_winding(std::span<const WindingNode> nodes, std::span<const WindingPoint> points,
                 std::span<const Vec3> x, double opening, double* sums);

}  // namespace rholm
