// The comparison of surfaces that need not fit in memory: samples and closest points of one portion
// of triangles after the other, with the bits of CompareSamples.
#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "rholm/compare.h"
#include "rholm/mesh_view.h"
#include "rholm/topology.h"
#include "surface/star/compare_samples.h"
#include "surface/star/mesh_portions.h"

namespace rholm {

// Of a chunk: some 50 ms where the shapes are far apart.
inline constexpr std::size_t kQueriesOfChunk = 256;

// How many triangles a portion has, of meshes of so many vertices, in that many bytes.
std::size_t triangles_of_portion(std::size_t n_vertices, std::size_t memory);

// And what one pass says of a mesh in portions.
struct SurveyedMesh {
  // Throws InvalidInput for a surface without area.
  explicit SurveyedMesh(const MeshPortions& mesh);

  MeshPortions portions;
  std::vector<Bounds> boxes;  // of portions, in the frame of the whole
  double twice_area = 0;      // in the units of AreaSum
  std::size_t last = 0;       // triangle with an area
};

// From samples of one surface to the other.
SampleDistances measure_in_portions(const SurveyedMesh& here, const SurveyedMesh& there,
                                    const CompareOptions& options, const ParallelStage& stage,
                                    const Context& context);

// As compare(), in portions of so many triangles.
Comparison compare_in_portions(const MeshInPlace& a, const MeshInPlace& b, std::size_t triangles,
                               const CompareOptions& options, const Context& context);

}  // namespace rholm
