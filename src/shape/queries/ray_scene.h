// Rays on a triangle mesh, or on balls: by Embree (ray_embree.cpp), or by our own tree of triangles
// (ray_tree.cpp) where rholm is built without it.
//
// Good to the rounding of float, in coordinates shifted to the mesh's centre.
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
  std::uint32_t triangle = 0;  // or the ball
  float u = 0;                 // barycentric weight of the second corner
  float v = 0;                 // and of the third
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

// How the tree is built: tight boxes, or in a third of the time.
enum class RayTree { kTight, kQuick };

// The frame of a mesh, or of balls of that radius about its vertices.
inline UnitFrame ray_frame(const Mesh& mesh, double ball_radius) {
  const Bounds box = bounds(mesh.vertices);
  const Vec3 margin{ball_radius, ball_radius, ball_radius};
  return unit_frame({box.min - margin, box.max + margin});
}

// Keeps a reference to `mesh`, which must outlive it. All queries may be called from several
// threads at once.
class RayScene {
 public:
  // With a radius above 0: of a ball about each vertex, which rays meet in place of triangles;
  // there are first_hit() and occluded() then. The tree is made on the threads of `context`.
  explicit RayScene(const Mesh& mesh, const Context& context = {}, double ball_radius = 0,
                    RayTree tree = RayTree::kTight);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // First hit along origin + t direction, near < t < far; direction of unit length.
  RayHit first_hit(const Vec3& origin, const Vec3& direction, double near, double far) const;
  bool occluded(const Vec3& origin, const Vec3& direction, double near, double far) const;
  // The same for many rays at once, from their origins to infinity: in half of the time where
  // neighbours in the list go side by side, in four fifths of it anywhere.
  std::vector<RayHit> first_hits(std::span<const Ray> rays) const;
  std::vector<bool> occluded(std::span<const Ray> rays) const;
  // All triangles that the half line from `origin` meets, the nearest first. A shared edge or
  // vertex is met once per triangle; where it starts is good to 1e-7 of the mesh's size.
  std::vector<RayCrossing> crossings(const Vec3& origin, const Vec3& direction) const;
  // How often the half line from `origin` meets the surface: hits closer to each other than
  // 1e-6 of the distance count once (edges and vertices are shared).
  int count_hits(const Vec3& origin, const Vec3& direction) const;

 private:
  // The triangles of crossings(), in any order.
  std::vector<std::uint32_t> triangles_met(const Vec3& origin, const Vec3& direction) const;

  struct Impl;
  const Mesh& mesh_;
  UnitFrame frame_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rholm
