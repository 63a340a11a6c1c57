// Computes exact closest points on a triangle mesh.
//
// A tree of float boxes, in coordinates shifted to the mesh's centre, finds the triangles that can
// be nearest. These are then measured in double precision with the mesh's own vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/face.h"
#include "shape/queries/closest_kernels.h"

namespace rholm {

struct ClosestPoint {
  Vec3 point;
  std::uint32_t triangle = 0;
  double distance = 0;
};

// The closest point so far, if a mesh is searched one portion at a time.
struct ClosestSoFar {
  double square = std::numeric_limits<double>::infinity();  // of the distance, in the frame
  std::uint64_t triangle = std::numeric_limits<std::uint64_t>::max();  // number in the whole mesh
  double distance = std::numeric_limits<double>::infinity();
};

// Triangle k of a portion has the number first + k step in the whole mesh.
struct PortionNumbers {
  std::uint64_t first = 0, step = 1;
};

// Returns true if a portion may have a closer or equally close point; other portions need no query.
// `box` bounds the portion's vertices in the frame of the whole mesh.
bool may_be_closer(const Bounds& box, const UnitFrame& whole, const Vec3& point,
                   const ClosestSoFar& so_far);

inline constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
struct FloatBox {
  std::array<float, 3> low = {kFloatInfinity, kFloatInfinity, kFloatInfinity};
  std::array<float, 3> high = {-kFloatInfinity, -kFloatInfinity, -kFloatInfinity};
};

// Searches closest points. It keeps a reference to `mesh`, which must outlive it. Several threads
// may call queries at once.
class TriangleTree {
 public:
  // Builds the tree on the threads of `context`; the result does not depend on their number.
  explicit TriangleTree(const Mesh& mesh, const Context& context = {.threads = 1});
  // Builds a tree of a portion; vertices are in the whole mesh's order, and `whole` is its frame.
  TriangleTree(const Mesh& portion, const UnitFrame& whole, const PortionNumbers& numbers,
               const Context& context = {.threads = 1});

  // Takes the portion's closest point if it is closer than `so_far`, or equally close with a
  // smaller triangle number. Returns true if it is taken. After all portions, in any order,
  // `so_far` equals closest() of the whole mesh. The mesh is no farther away than `at_most`.
  bool improve(const Vec3& point, double at_most, ClosestSoFar& so_far) const;

  // Needs a mesh with a triangle. For ties, returns the triangle with the smaller index.
  ClosestPoint closest(const Vec3& point) const;
  // Does the same for each point; faster if neighbours in the list are near each other.
  std::vector<ClosestPoint> closest(std::span<const Vec3> points) const;

  // Give access for other walks. Boxes are in the frame, exact to the rounding of float. Leaf k has
  // triangles order()[8 k] ... order()[8 k + 7]; the last leaf may repeat its last one.
  const TriangleTreeNodes& nodes() const { return nodes_; }
  std::span<const std::uint32_t> order() const { return order_; }

 private:
  ClosestPoint closest_within(const Vec3& point, double at_most) const;
  void sort_triangles(const Context& context);
  void build(const Context& context);
  FloatBox make_leaf(std::size_t leaf, PlaneGroup& planes) const;

  const Mesh& mesh_;
  UnitFrame frame_;
  PortionNumbers numbers_;
  std::vector<std::uint32_t> order_;  // order of the triangles in the leaves
  TriangleTreeNodes nodes_;
};

// Calls visit(i, closest point of points[i]) for each point, on the threads of `context`. Each
// thread takes ranges of consecutive points.
void visit_closest(const TriangleTree& tree, std::span<const Vec3> points,
                   const ParallelStage& stage, const Context& context,
                   const std::function<void(std::size_t, const ClosestPoint&)>& visit);
// Returns the distance of each point from the mesh.
std::vector<double> distances_to(const TriangleTree& tree, std::span<const Vec3> points,
                                 const ParallelStage& stage, const Context& context);

}  // namespace rholm
