// One surface of a comparison: its samples, and its closest points to the samples of the other.
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

// Samples whose closest points a thread looks for at a time; chosen: some 50 ms where the shapes
// are far apart.
inline constexpr std::size_t kQueriesOfChunk = 256;

// How many triangles a portion has, of meshes of so many vertices, in that many bytes.
std::size_t triangles_of_portion(std::size_t n_vertices, std::size_t memory);

struct SurfaceSamples {
  std::vector<Vec3> points, normals;  // normals have unit length
};

// Of samples: the distance to the other surface, and the angle between the normals here and there,
// in degrees; negative where the closest triangle is degenerate, it has no normal.
struct DistancesOut {
  std::span<double> distances, angles;
};

// A mesh in parts: one that is kept, or portions that are loaded whenever they are needed. Results
// have the same bits for any parts. Once prepared, any thread may ask.
class ComparedSurface {
 public:
  // Keeps a copy of a valid mesh, its coordinates times `scale`. Throws InvalidInput for a mesh
  // without triangles.
  ComparedSurface(const Mesh& mesh, double scale);
  // Portions of at most so many triangles of a valid mesh with these bounds, to which it keeps a
  // reference.
  ComparedSurface(const MeshInPlace& mesh, const Bounds& bounds, double scale,
                  std::size_t triangles);
  ~ComparedSurface();

  bool is_kept() const { return kept_ != nullptr; }
  const Bounds& bounds() const { return bounds_; }  // scaled

  // Make what draw() and measure() need, once. Any thread, but not within a loop if on several. The
  // first throws InvalidInput for a mesh without area.
  void prepare_to_draw();
  void prepare_to_measure(const Context& context);

  // Samples first ... first + n - 1 of those that the options tell.
  SurfaceSamples draw(const CompareOptions& options, std::size_t first, std::size_t n) const;
  // From each sample to this surface, on the threads of `context`.
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
  std::optional<MeshPortions> portions_;  // of a surface that is not kept
  std::vector<Bounds> boxes_;             // of parts, in the frame
  std::vector<AreaSum> sums_;             // before each part
  double twice_area_ = 0;                 // in the units of AreaSum
  std::once_flag to_draw_, to_measure_;
};

}  // namespace rholm
