// Parts of a mesh pass worked: triangles to lumps and nodes, and these to grids.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/aligned_array.h"
#include "base/progress.h"
#include "rholm/context.h"
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

// What of a part has not been spread yet.
template <typename T>
struct WorkedPart {
  MeshPart<T> part;
  PartMesh mesh;
  AlignedArray<VertexLump<LumpOf<T>>> lumps;  // of the mesh's vertices
};

// Parts may be worked by several threads at a time, and by several processes that have the ranges
// of all parts.
template <typename T>
class PartWorker {
 public:
  using Lump = LumpOf<T>;

  PartWorker(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
             const Division& division)
      : mesh_(mesh), options_(options), plan_(plan), division_(division) {}

  // Of the triangles of part p, for set_ranges(). Throws InvalidInput for an index out of range.
  IndexRange range_of(std::size_t p) const;
  void set_ranges(std::vector<IndexRange> ranges) { ranges_ = std::move(ranges); }
  const std::vector<IndexRange>& ranges() const { return ranges_; }
  std::size_t n_vertices() const { return mesh_.n_vertices; }

  // Nodes go to the grid; with none they are kept. Throws as mesh_pass() does.
  WorkedPart<T> work(std::size_t p, GridSources<T>* grid, SharedProgress& progress) const;
  // The same, lumps to those in common, without ranges of parts: what is left are the nodes kept.
  WorkedPart<T> work(std::size_t p, CommonLumps<Lump>& common, GridSources<T>* grid,
                     SharedProgress& progress) const;
  // Nodes that were kept, then the vertices that no other part has.
  void spread(const WorkedPart<T>& worked, GridSources<T>& grid) const;
  // Vertices begin ... end - 1 of those that several parts have.
  void spread(const BorderLumps<Lump>& border, std::size_t begin, std::size_t end,
              GridSources<T>& grid) const;

  // Vertices begin ... end - 1 of the mesh, whose lumps have been added up; begin is a multiple of
  // kVerticesPerBlock.
  void spread(const CommonLumps<Lump>& common, std::size_t begin, std::size_t end,
              GridSources<T>& grid) const;

  // Of n vertices; of all of the border's.
  LumpSums sums_of(const VertexLump<Lump>* lumps, std::size_t n) const;
  LumpSums sums_of(const BorderLumps<Lump>& border) const {
    return sums_of(border.lumps.data(), border.vertices.size());
  }
  // Says what is wrong with a mesh in which something is.
  [[noreturn]] void refuse_mesh() const;

 private:
  class Triangles;
  void take_border(std::size_t p, const std::uint32_t* fans, WorkedPart<T>& worked) const;
  // Calls visit(first, n, lumps) for blocks of vertices, `first` counted from the first of them.
  template <typename Visit>
  void visit_lumps(const VertexLump<Lump>* lumps, std::size_t n, const Visit& visit) const;

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  const MeshPlan& plan_;
  Division division_;
  std::vector<IndexRange> ranges_;
};

}  // namespace rholm
