// Distances between a mesh and the surface of an expansion by closest points, where distances to
// first order are not exact enough: method 5.
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
  // Returns the distances of points x from the surface. Makes `steps` steps along its tangent
  // planes, beginning at the directions `from`; each step is halved until it comes nearer. Near the
  // closest point one step is exact to second order. No result is too small except for rounding.
  std::vector<double> distances(const std::vector<Vec3>& x, std::vector<Vec3> from,
                                int steps) const;

 private:
  const RadialModel& model_;
  double scale_;
  const Context& context_;
};

struct SurfaceDistances {
  double rms = 0, max = 0;  // the larger one of mesh to model and model to mesh
};

// Keeps the tree of a mesh for several models. Memory: about 120 bytes per face of the mesh, and at
// most 40 MB for the model's tree.
class ClosestDistances {
 public:
  // Measures `n_points` points on each surface, and more to first order; see surface_pieces().
  ClosestDistances(const MeshView& mesh, const Vec3& center, std::size_t n_points);

  // Returns distances in the mesh's unit. The sizes of model and mesh must be comparable. The
  // maximum is over the pieces and over `extreme`, points of the mesh.
  SurfaceDistances measure(const Expansion& expansion, int degree, const ErrorPoints& extreme,
                           double precision, const Context& context);

 private:
  struct Model;
  struct Seen;
  const Mesh& sphere(int degree);
  // Measures at some pieces, then at extreme points that may be farther than the points before.
  // Then climbs from all of these points to the largest distance.
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
