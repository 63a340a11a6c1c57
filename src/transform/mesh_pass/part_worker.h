// Computes parts of a mesh pass: from faces to lumps and nodes, and from these to grids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/common_lumps.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/grid_sources.h"
#include "transform/mesh_pass/mesh_part.h"
#include "transform/mesh_pass/own_nodes.h"
#include "transform/mesh_pass/part_mesh.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// Several threads may compute parts at a time, and several processes that have the ranges of all
// parts.
template <typename T>
class PartWorker {
 public:
  using Lump = LumpOf<T>;

  // `transform` has the window that was chosen.
  PartWorker(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
             const Division& division, const NonuniformPlan& transform)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        division_(division),
        transform_(transform),
        kernel_(grid_kernel<T>(transform_.fourier)) {}
  PartWorker(const PartWorker&) = delete;
  PartWorker& operator=(const PartWorker&) = delete;

  // Returns the range of part p for set_ranges(). Throws InvalidInput for an index out of range.
  IndexRange range_of(std::size_t p) const;
  void set_ranges(std::vector<IndexRange> ranges) { ranges_ = std::move(ranges); }
  const std::vector<IndexRange>& ranges() const { return ranges_; }

  // Returns an empty grid, valid as long as this object.
  std::unique_ptr<GridSources<T>> new_grid() const {
    return std::make_unique<GridSources<T>>(transform_, kernel_);
  }

  // Returns lumps in common that are all zero.
  CommonLumps<Lump> no_lumps() const {
    return {mesh_.n_vertices, lumps_per_vertex(plan_.block.hessians)};
  }

  // Spreads nodes, and vertices that no other part has, to the grid. Throws like mesh_pass().
  MeshPart<T> work(std::size_t p, GridSources<T>& grid, SharedProgress& progress) const;
  // Does the same with lumps in common, without ranges of parts: only nodes are spread.
  MeshPart<T> work(std::size_t p, CommonLumps<Lump>& common, GridSources<T>& grid,
                   SharedProgress& progress) const;
  // Spreads vertices begin ... end - 1 of the vertices that several parts have.
  void spread(const BorderLumps<Lump>& border, std::size_t begin, std::size_t end,
              GridSources<T>& grid) const;

  // Spreads vertices begin ... end - 1 of the mesh, whose lumps have been added up. `begin` is a
  // multiple of kVerticesPerBlock.
  void spread(const CommonLumps<Lump>& common, std::size_t begin, std::size_t end,
              GridSources<T>& grid) const;

  // Return sums over the lumps of n vertices, and of all vertices of the border.
  LumpSums sums_of(const VertexLump<Lump>* lumps, std::size_t n) const;
  LumpSums sums_of(const BorderLumps<Lump>& border) const {
    return sums_of(border.lumps.data(), border.vertices.size());
  }
  // Throws an error that describes what is wrong with the mesh.
  [[noreturn]] void refuse_mesh() const;

 private:
  class Triangles;
  void take_border(std::size_t p, const PartMesh& mesh, const std::uint32_t* fans,
                   VertexLump<Lump>* lumps, MeshPart<T>& part) const;
  // Spreads the vertices of the part.
  void spread(const PartMesh& mesh, const VertexLump<Lump>* all, GridSources<T>& grid) const;
  // Calls visit(first, n, lumps) for blocks of vertices; `first` counts from the first vertex.
  template <typename Visit>
  void visit_lumps(const VertexLump<Lump>* lumps, std::size_t n, const Visit& visit) const;

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  const MeshPlan plan_;
  const Division division_;
  const NonuniformPlan transform_;
  const GridKernel<T> kernel_;
  std::vector<IndexRange> ranges_;
};

}  // namespace rholm
