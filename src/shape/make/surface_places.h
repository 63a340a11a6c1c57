// Computes places on a surface, and the random numbers that choose them. Layer: shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rholm/mesh.h"
#include "shape/face.h"

namespace rholm {

// The random numbers of a point, or of another item with a number.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t number);
  double uniform();  // [0, 1)
  std::pair<double, double> gaussian_pair();
  Vec3 gaussian();
  Vec3 direction();

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

// A point of a surface, in the surface's unit frame.
struct SurfacePlace {
  Vec3 point;
  Vec3 normal;                         // unit normal of the triangle
  std::size_t triangle = 0;            // triangle that determines the attributes
  std::array<double, 3> weights = {};  // weights of the triangle's corners
};

// A mesh in its unit frame, prepared for random draws.
class SampledSurface {
 public:
  // The density falls along the longest axis, to 1 / density_ratio. Keeps a reference to the mesh.
  SampledSurface(const Mesh& mesh, double density_ratio);

  const Mesh& mesh() const { return mesh_; }
  const UnitFrame& frame() const { return frame_; }
  double diagonal() const { return norm(size_); }
  Vec3 middle() const { return low_ + 0.5 * size_; }
  bool has_area() const { return !sums_.empty() && sums_.back() > 0; }
  double area() const { return sums_.back() / 2; }

  std::array<Vec3, 3> corners(std::size_t triangle) const;
  // Returns zero where the triangle has no direction, and therefore no points.
  Vec3 twice_area(std::size_t triangle) const;
  SurfacePlace place(std::size_t triangle, const std::array<double, 3>& weights) const;

  // Draws a place, uniform by area.
  SurfacePlace draw_uniform(RandomStream& random) const;
  // Draws a place, thinned by the law of density: on average at most density_ratio tries.
  SurfacePlace draw(RandomStream& random) const;
  // Returns true if the law of density keeps a place.
  bool keeps(const SurfacePlace& place, RandomStream& random) const;
  // Draws a place uniformly in the box, grown by a tenth, with a random normal.
  SurfacePlace draw_outlier(RandomStream& random) const;

 private:
  const Mesh& mesh_;
  UnitFrame frame_;
  Vec3 low_, size_;
  Vec3 falloff_;
  std::vector<double> sums_;  // for each triangle: twice the area of all triangles up to it
};

}  // namespace rholm
