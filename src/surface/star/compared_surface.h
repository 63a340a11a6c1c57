// One surface of a comparison: its samples, and its closest points to the other's samples.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "rholm/compare.h"
#include "rholm/mesh_view.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "surface/star/area_samples.h"
#include "surface/star/mesh_portions.h"

namespace rholm {

// Number of samples per task when searching closest points;
// chosen: some 50 ms where the shapes are far apart.
inline constexpr std::size_t kQueriesOfChunk = 256;

// Returns the triangles per portion of a mesh with `n_vertices` vertices, in `memory` bytes.
std::size_t triangles_of_portion(std::size_t n_vertices, std::size_t memory);

struct SurfaceSamples {
  std::vector<Vec3> points, normals;  // normals have unit length
};

// Per sample, the distance to the other surface, and the angle between both normals in degrees.
// The angle is negative where the closest triangle is degenerate, since it has no normal.
struct DistancesOut {
  std::span<double> distances, angles;
};

// Mesh in parts: it stays in memory, or its portions are loaded when needed. Results have
// the same bits for any parts. Once prepared, any thread may call the const functions.
class ComparedSurface {
 public:
  // Keeps a copy of a valid mesh, with coordinates times
  // `scale`. Throws InvalidInput for a mesh without triangles.
  ComparedSurface(const Mesh& mesh, double scale);
  // Uses portions of at most `triangles` triangles of a valid
  // mesh with these bounds. Keeps a reference to the mesh.
  ComparedSurface(const MeshInPlace& mesh, const Bounds& bounds, double scale,
                  std::size_t triangles);
  ~ComparedSurface();

  bool is_kept() const { return kept_ != nullptr; }
  const Bounds& bounds() const { return bounds_; }  // box of the scaled vertices

  // Prepare draw() and measure(), once. Any thread may call them; within a parallel loop `context`
  // must have one thread. prepare_to_draw() throws InvalidInput for a mesh without area.
  void prepare_to_draw();
  void prepare_to_measure(const Context& context);

  // Draws the samples first ... first + n - 1 of the samples defined by `options`.
  SurfaceSamples draw(const CompareOptions& options, std::size_t first, std::size_t n) const;
  // Measures from each sample to this surface, on the threads of `context`.
  void measure(const SurfaceSamples& samples, const DistancesOut& out, const Context& context,
               const ParallelStage& stage) const;

 private:
  struct Part;
  std::size_t n_parts() const { return kept_ ? 1 : portions_->size(); }
  std::shared_ptr<const Part> part_to_draw(std::size_t p) const;
  std::shared_ptr<const Part> part_to_search(std::size_t p) const;
  void survey_portions();

  Bounds bounds_;
  UnitFrame frame_;
  std::shared_ptr<Part> kept_;
  std::optional<MeshPortions> portions_;  // used if the surface is not kept in memory
  std::vector<Bounds> boxes_;             // boxes of the parts, in the frame
  std::vector<AreaSum> sums_;             // sum of the areas before each part
  double twice_area_ = 0;                 // value in the units of AreaSum
  std::once_flag to_draw_, to_measure_;
};

}  // namespace rholm
