// Traces rays against a triangle mesh or against balls. It uses Embree (ray_embree.cpp), or our own
// tree of triangles (ray_tree.cpp) if rholm is built without Embree.
//
// Results are exact to the rounding of float, in coordinates shifted to the mesh's centre.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/face.h"

namespace rholm {

struct RayHit {
  bool hit = false;
  std::uint32_t triangle = 0;  // or index of the ball
  float u = 0;                 // barycentric weight of the second corner
  float v = 0;                 // barycentric weight of the third corner
  double distance = 0;
};

struct Ray {
  Vec3 origin;
  Vec3 direction;  // of unit length
};

struct RayCrossing {
  std::uint32_t triangle = 0;
  double distance = 0;  // to the triangle's plane
};

// How the tree is built: with tight boxes, or in a third of the time.
enum class RayTree { kTight, kQuick };

// Returns the frame of a mesh, or of balls of this radius around its vertices.
inline UnitFrame ray_frame(const Mesh& mesh, double ball_radius) {
  const Bounds box = bounds(mesh.vertices);
  const Vec3 margin{ball_radius, ball_radius, ball_radius};
  return unit_frame({box.min - margin, box.max + margin});
}

// Answers queries about rays. It keeps a reference to `mesh`, which must outlive it. Several
// threads may call queries at once.
class RayScene {
 public:
  // If ball_radius > 0, rays meet balls around the vertices instead of triangles. Then only
  // first_hit() and occluded() may be used. The tree is built on the threads of `context`.
  explicit RayScene(const Mesh& mesh, const Context& context = {}, double ball_radius = 0,
                    RayTree tree = RayTree::kTight);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Returns the first hit along origin + t direction, near < t < far; direction has unit length.
  RayHit first_hit(const Vec3& origin, const Vec3& direction, double near, double far) const;
  bool occluded(const Vec3& origin, const Vec3& direction, double near, double far) const;
  // Does the same for many rays, from their origins to infinity. It takes half of the time if
  // neighbours in the list run side by side, and four fifths otherwise.
  std::vector<RayHit> first_hits(std::span<const Ray> rays) const;
  std::vector<bool> occluded(std::span<const Ray> rays) const;
  // Returns all triangles that the half line from `origin` meets, nearest first. A shared edge or
  // vertex is met once per triangle. The start is exact to 1e-7 of the mesh's size.
  std::vector<RayCrossing> crossings(const Vec3& origin, const Vec3& direction) const;
  // Counts how often the half line from `origin` meets the surface. Hits closer to each other than
  // 1e-6 of the distance count once, because edges and vertices are shared.
  int count_hits(const Vec3& origin, const Vec3& direction) const;

 private:
  // Returns the triangles of crossings(), in any order.
  std::vector<std::uint32_t> triangles_met(const Vec3& origin, const Vec3& direction) const;

  struct Impl;
  const Mesh& mesh_;
  UnitFrame frame_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rholm
