// Finds nearest neighbours among points. Layer: shape.
//
// Each node has 16 children. Points are in the order of median splits, so that neighbours in space
// are close in memory. Boxes of children and points of leaves are compared a vector at a time.
// Distances use single-precision coordinates relative to the middle of the points; they are exact
// to about 1e-7 of the largest extent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned_array.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

struct Neighbor {
  float distance2;      // squared
  std::uint32_t index;  // index in the order of the tree
};

class PointTree {
 public:
  // Takes finite points, fewer than 2^31. Keeps no reference to them.
  explicit PointTree(std::span<const Vec3> points, const Context& context = {});

  std::size_t size() const { return order_.size(); }
  // Returns the index in `points` of the i-th point in the order of the tree. All other indices of
  // this class refer to the order of the tree.
  std::span<const std::uint32_t> order() const { return order_; }
  // Returns a point in the precision of the tree.
  Vec3 point(std::size_t i) const;

  // Finds the `k` nearest points to x, or all if there are fewer; nearest first, ties by index. A
  // point of the tree at x is among them. `found` is reused memory.
  void nearest(const Vec3& x, std::size_t k, std::vector<Neighbor>& found) const;
  // Does the same as nearest() around the i-th point, but faster.
  void nearest_to(std::size_t i, std::size_t k, std::vector<Neighbor>& found) const;
  // Finds the nearest point within `radius` of x, ties by index; false if none. Takes no memory.
  bool nearest_within(const Vec3& x, double radius, Neighbor& found) const;
  // Finds all points within `radius` of x, in the order of the tree.
  void within(const Vec3& x, double radius, std::vector<Neighbor>& found) const;

  // Leaf j has the points leaf_begin(j) ... leaf_begin(j + 1) - 1.
  std::size_t n_leaves() const { return leaf_begin_.size() - 1; }
  std::size_t leaf_begin(std::size_t leaf) const { return leaf_begin_[leaf]; }

  // The data of the tree for its kernels only.
  struct View {
    // Most neighbours sorted in vectors; the work grows with the square of their number.
    static constexpr std::size_t kMostRanked = 64;
    const float* x;
    const float* y;
    const float* z;
    const std::uint32_t* leaf_begin;
    const float* boxes;  // of a wide node: lower x of its 16 children, lower y, z, upper x, y, z
    int levels;          // of wide nodes; node j of a level has children 16 j ... of the next
    const std::uint32_t* level_begin;  // the first node of each level
  };

 private:
  struct Item {
    std::array<float, 3> at;
    std::uint32_t index;
  };
  void split(std::vector<Item>& items, const Context& context);
  void store(const std::vector<Item>& items, const Context& context);
  void make_boxes(std::vector<float> below);
  std::array<float, 3> local(const Vec3& x) const;
  void search(const std::array<float, 3>& at, float radius2, std::size_t k,
              std::vector<Neighbor>& found) const;
  View view() const;

  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> leaf_begin_;
  std::vector<std::uint32_t> leaf_of_;  // leaf of each point
  std::vector<float> leaf_density_;     // points per area of the leaf's two largest extents
  AlignedArray<float> coordinates_;     // x of all points, then y, z; padded
  std::size_t stride_ = 0;              // from x to y
  AlignedArray<float> boxes_;
  int levels_ = 0;
  std::array<std::uint32_t, 9> level_begin_{};
  Vec3 middle_;
  double scale_ = 1;
};

}  // namespace rholm
