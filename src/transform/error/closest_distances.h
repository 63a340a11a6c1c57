// Distances between a mesh and the surface of an expansion by closest points, where those to first
// order are not enough: method 5.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "shape/queries/triangle_tree.h"
#include "transform/error/error_points.h"
#include "transform/error/radial_model.h"
#include "transform/error/surface_pieces.h"

namespace rholm {

// Points on rays and the outward unit normals there.
struct RadialPoints {
  std::vector<Vec3> points, normals;
};

// The surface of the first degrees of an expansion, about its centre, lengths times `scale`. The
// model and the context must outlive it.
class RadialSurface {
 public:
  RadialSurface(const RadialModel& model, double scale, const Context& context)
      : model_(model), scale_(scale), context_(context) {}

  std::vector<Vec3> points(const std::vector<Vec3>& directions) const;
  RadialPoints at(const std::vector<Vec3>& directions) const;
  // How far points x are from the surface, beginning at the directions `from`: so many steps along
  // its tangent planes, each halved until it comes nearer. From near the closest point to second
  // order after one step; never too small but for the rounding.
  std::vector<double> distances(const std::vector<Vec3>& x, std::vector<Vec3> from,
                                int steps) const;

 private:
  const RadialModel& model_;
  double scale_;
  const Context& context_;
};

struct SurfaceDistances {
  double rms = 0, max = 0;  // the larger of both ways
};

// Keeps the tree of a mesh for several models. Memory: about 120 bytes per face of the mesh, and
// 40 MB for the model's tree at most.
class ClosestDistances {
 public:
  // `n_points`: so many on each surface, and to first order more; see surface_pieces().
  ClosestDistances(const MeshView& mesh, const Vec3& center, std::size_t n_points);

  // In the mesh's unit. Model and mesh must have sizes that compare. The largest is one over the
  // pieces and over `extreme`, points of the mesh.
  SurfaceDistances measure(const Expansion& expansion, int degree, const ErrorPoints& extreme,
                           double precision, const Context& context);

 private:
  struct Model;
  struct Seen;
  const Mesh& sphere(int degree);
  // At some pieces; then at extreme points, those that may be farther than what has been seen; then
  // the largest distance uphill from there.
  Seen see_pieces(const Model& model, const RadialPoints& opposite,
                  const std::vector<std::size_t>& indices, const Context& context) const;
  void see_extreme(const Model& model, const ErrorPoints& extreme, const Context& context,
                   Seen& seen) const;
  double highest(const Model& model, const RadialSurface& surface, int degree,
                 const Seen& seen) const;

  std::size_t n_points_;
  SurfacePieces pieces_;
  Mesh shape_;  // about the centre, scaled
  std::unique_ptr<TriangleTree> tree_;
  int level_ = -1;
  Mesh sphere_;
};

}  // namespace rholm
