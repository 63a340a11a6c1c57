// Exact closest points on a triangle mesh.
//
// A tree of float boxes around coordinates shifted to the mesh's centre tells which triangles can
// be nearest; these are then measured in double, on the mesh's own vertices.
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

// Of a mesh that is searched a portion at a time: the closest point of all portions so far.
struct ClosestSoFar {
  double square = std::numeric_limits<double>::infinity();  // of the distance, in the frame
  std::uint64_t triangle = std::numeric_limits<std::uint64_t>::max();  // its number in the whole
  double distance = std::numeric_limits<double>::infinity();
};

// What triangle k of a portion is in the whole mesh: number first + k step.
struct PortionNumbers {
  std::uint64_t first = 0, step = 1;
};

// Whether a portion whose vertices have that box, in the frame of the whole mesh, may have a closer
// point, or one as close: no other needs to be asked.
bool may_be_closer(const Bounds& box, const UnitFrame& whole, const Vec3& point,
                   const ClosestSoFar& so_far);

inline constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
struct FloatBox {
  std::array<float, 3> low = {kFloatInfinity, kFloatInfinity, kFloatInfinity};
  std::array<float, 3> high = {-kFloatInfinity, -kFloatInfinity, -kFloatInfinity};
};

// Keeps a reference to `mesh`, which must outlive it. Queries may come from several threads at
// once.
class TriangleTree {
 public:
  // Made on the threads of `context`; the same for any number of them.
  explicit TriangleTree(const Mesh& mesh, const Context& context = {.threads = 1});
  // Of a portion of a mesh, with vertices in the order that they have there, and that mesh's frame.
  TriangleTree(const Mesh& portion, const UnitFrame& whole, const PortionNumbers& numbers,
               const Context& context = {.threads = 1});

  // Takes the closest point of the portion if it is closer than what was found, or as close and of
  // a triangle with a smaller number, and says so. Whatever the portions and their order, in the
  // end there is what closest() has of the whole mesh. The mesh is no farther away than `at_most`.
  bool improve(const Vec3& point, double at_most, ClosestSoFar& so_far) const;

  // The mesh must have a triangle. Ties go to the triangle with the smaller index.
  ClosestPoint closest(const Vec3& point) const;
  // The same of each: faster where neighbours in the list are near each other.
  std::vector<ClosestPoint> closest(std::span<const Vec3> points) const;

  // For walks of other kinds: boxes in the frame, good to the rounding of float, of which the leaf
  // k has triangles order()[8 k] ... order()[8 k + 7]; the last leaf may have its last one again.
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
  std::vector<std::uint32_t> order_;  // of the triangles in the leaves
  TriangleTreeNodes nodes_;
};

// Calls visit(i, closest point of points[i]) for each point, on the threads of `context`, each of
// which asks for points that follow each other.
void visit_closest(const TriangleTree& tree, std::span<const Vec3> points,
                   const ParallelStage& stage, const Context& context,
                   const std::function<void(std::size_t, const ClosestPoint&)>& visit);
// How far each point is from the mesh.
std::vector<double> distances_to(const TriangleTree& tree, std::span<const Vec3> points,
                                 const ParallelStage& stage, const Context& context);

}  // namespace rholm
