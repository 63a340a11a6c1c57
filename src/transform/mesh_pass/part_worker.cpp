#include "transform/mesh_pass/part_worker.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/cancel.h"
#include "rholm/error.h"
#include "transform/mesh_pass/hermite_nodes.h"
#include "transform/mesh_pass/scatter.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {
namespace {

constexpr std::size_t kBlockSize = kTrianglesPerBlock;
// Number of blocks between two reports of progress: about 1 ms.
constexpr std::size_t kBlocksPerStep = 512;

}  // namespace

// Processes the faces of one part.
template <typename T>
class PartWorker<T>::Triangles {
 public:
  // Adds to `lumps`, the lumps of the part's vertices. `fans`: see link_fans(); null: nothing is
  // linked.
  Triangles(const PartWorker& worker, const PartMesh& part_mesh, VertexLump<Lump>* lumps,
            GridSources<T>& grid, std::uint32_t* fans, MeshPart<T>& part)
      : worker_(worker),
        part_mesh_(part_mesh),
        lumps_(lumps),
        mesh_(worker.mesh_),
        parameters_(worker.plan_.block),
        fans_(fans),
        part_(part),
        sink_(part, grid, worker.plan_),
        vertices_{.mesh = mesh_,
                  .center = parameters_.scale * parameters_.center,
                  .scale = parameters_.scale},
        writer_({worker.plan_.divided, worker.plan_.face_rounding}, vertices_, sink_),
        between_(vertices_, sink_),
        lumping2_(std::pow(lumping_error(worker.plan_.divided.degree), 2)) {}

  void run(SharedProgress& progress) {
    const std::size_t first = part_mesh_.first_triangle, n = part_mesh_.n_faces;
    const auto& release = worker_.options_.release;
    part_.block_errors.reserve((n + kBlockSize - 1) / kBlockSize);
    look_at(0);
    for (std::size_t at = 0; at < n; at += kBlockSize) {
      ask_cancel();
      std::swap(here_, next_);
      if (at + kBlockSize < n) look_at(at + kBlockSize);
      work(first + at, std::min(kBlockSize, n - at));
      constexpr std::size_t kStep = kBlocksPerStep * kBlockSize;
      const std::size_t end = at + kBlockSize;
      if (end % kStep != 0 || end > n) continue;
      if (release) release(first + end - kStep, kStep);
      progress.add(kStep);
    }
    writer_.flush();
    part_.node_error2 = writer_.error2();
    between_.flush();
    sink_.sum_undivided();
  }

 private:
  // Data of a block that are needed before it is processed.
  struct Ahead {
    std::uint32_t largest = 0;
    CornerPlaces places;
    BlockPlaces room;
  };

  void look_at(std::size_t at) {
    const std::size_t first = part_mesh_.first_triangle + at;
    const std::size_t n = std::min(kBlockSize, part_mesh_.n_faces - at);
    if (part_mesh_.names.empty()) check_triangles(worker_.options_, first, n);
    next_->largest = largest_index(mesh_, first, n);
    if (next_->largest >= mesh_.n_vertices) worker_.refuse_mesh();
    next_->places = part_mesh_.corners(mesh_, first, n, next_->room);
    ask_for_lumps(next_->places, n, parameters_.hessians, lumps_);
  }

  void work(std::size_t first, std::size_t n) {
    parameters_.largest_index = here_->largest;
    const double mean_reach2 = std::max(parameters_.mean_reach2, parameters_.mean_nodes_reach2);
    const std::size_t before = part_.sums.nodes;
    work_block(mesh_, first, n, parameters_, *block_, part_.sums);
    scatter_lumps(here_->places, n, parameters_.hessians, *block_, lumps_);
    if (fans_ != nullptr) link_fans(here_->places, n, *block_, fans_);
    if (block_->has_nodes_between) between_.add(mesh_, first, n, *block_);
    sample_half_edges(*block_, n, part_.half_edges);
    const double written = writer_.error2();
    if (part_.sums.nodes != before || part_.sums.max_edge2 > mean_reach2) write_nodes(first, n);
    const double error2 = lumping2_ * lumped_error2(n) + writer_.error2() - written;
    part_.block_errors.push_back(static_cast<float>(std::sqrt(error2)));
  }

  // Returns the squared error of lumped faces among the block's first n, in units of
  // lumping_error(L).
  double lumped_error2(std::size_t n) const {
    double sum = 0;
    for (std::size_t t = 0; t < n; ++t) {
      sum += (block_->flag[t] & kNodes) == 0 ? block_->error2[t] : 0;
    }
    return sum;
  }

  void write_nodes(std::size_t first, std::size_t n) {
    const TriangleBlock<Lump>& block = *block_;
    for (std::size_t t = 0; t < n; ++t) {
      if (block.flag[t] == kLumped) continue;
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = {block.corner[i][0][t], block.corner[i][1][t], block.corner[i][2][t]};
      }
      if ((block.flag[t] & kNodes) != 0) {
        writer_.add_triangle(p, mesh_.triangle(first + t));
      }
      if ((block.flag[t] & kMeanNodes) != 0) {
        part_.mean += radius_integral(p, worker_.plan_.allowed.mean);
      }
    }
  }

  const PartWorker& worker_;
  const PartMesh& part_mesh_;
  VertexLump<Lump>* lumps_;
  const MeshView& mesh_;
  BlockParameters parameters_;
  std::uint32_t* fans_;
  MeshPart<T>& part_;
  std::unique_ptr<Ahead> here_ = std::make_unique<Ahead>(), next_ = std::make_unique<Ahead>();
  std::unique_ptr<TriangleBlock<Lump>> block_ = std::make_unique<TriangleBlock<Lump>>();
  PartSink<T> sink_;
  ScaledVertices vertices_;
  NodeWriter writer_;
  NodesBetween between_;
  double lumping2_;
};

template <typename T>
IndexRange PartWorker<T>::range_of(std::size_t p) const {
  const IndexRange range = index_range(mesh_, division_.first(p), division_.n(p));
  if (range.high >= mesh_.n_vertices) refuse_mesh();
  return range;
}

template <typename T>
MeshPart<T> PartWorker<T>::work(std::size_t p, GridSources<T>& grid,
                                SharedProgress& progress) const {
  const std::size_t per_vertex = lumps_per_vertex(plan_.block.hessians);
  PartMesh mesh =
      part_mesh(mesh_, division_.first(p), division_.n(p), ranges_[p],
                [&](std::size_t first, std::size_t n) { check_triangles(options_, first, n); });
  auto lumps = AlignedArray<VertexLump<Lump>>::zeros(per_vertex * mesh.n_vertices);
  AlignedArray<std::uint32_t> fans;
  if (!shared_ranges(ranges_, p).empty()) {
    fans = AlignedArray<std::uint32_t>::zeros(mesh.n_vertices);
  }
  MeshPart<T> part;
  part.border.per_vertex = per_vertex;
  Triangles(*this, mesh, lumps.data(), grid, fans.data(), part).run(progress);
  mesh.ranks.reset();
  if (fans.size() > 0) take_border(p, mesh, fans.data(), lumps.data(), part);
  fans = {};
  part.lumps = sums_of(lumps.data(), mesh.n_vertices);
  spread(mesh, lumps.data(), grid);
  grid.flush();
  return part;
}

template <typename T>
MeshPart<T> PartWorker<T>::work(std::size_t p, CommonLumps<Lump>& common, GridSources<T>& grid,
                                SharedProgress& progress) const {
  MeshPart<T> part;
  PartMesh mesh;
  mesh.first_triangle = division_.first(p);
  mesh.n_faces = division_.n(p);
  const typename CommonLumps<Lump>::Loan loan(common);
  Triangles(*this, mesh, loan.lumps(), grid, nullptr, part).run(progress);
  grid.flush();
  return part;
}

// A vertex is complete in this part if the faces around it are closed. Other parts may have the
// vertex, but no face next to these faces.
template <typename T>
void PartWorker<T>::take_border(std::size_t p, const PartMesh& mesh, const std::uint32_t* fans,
                                VertexLump<Lump>* lumps, MeshPart<T>& part) const {
  const std::size_t per_vertex = part.border.per_vertex;
  for (const IndexRange& shared : shared_ranges(ranges_, p)) {
    const PartMesh::Places places = mesh.places(shared);
    for (std::size_t i = places.begin; i < places.end; ++i) {
      if (fans[i] == 0) continue;
      VertexLump<Lump>* const own = lumps + per_vertex * i;
      part.border.add(mesh.name(i), own);
      part.border_weight += static_cast<double>(own->value[0]);
      std::fill(own, own + per_vertex, VertexLump<Lump>{});
    }
  }
}

template <typename T>
template <typename Visit>
void PartWorker<T>::visit_lumps(const VertexLump<Lump>* lumps, std::size_t n,
                                const Visit& visit) const {
  const bool hessians = plan_.block.hessians;
  alignas(64) VertexLump<Lump> room[kLumpsPerBlock];
  for (std::size_t first = 0; first < n; first += kVerticesPerBlock) {
    const std::size_t count = std::min(kVerticesPerBlock, n - first);
    visit(first, count,
          arranged(lumps + lumps_per_vertex(hessians) * first, count, hessians, room));
  }
}

template <typename T>
void PartWorker<T>::spread(const PartMesh& mesh, const VertexLump<Lump>* all,
                           GridSources<T>& grid) const {
  std::uint32_t names[kVerticesPerBlock];
  visit_lumps(
      all, mesh.n_vertices, [&](std::size_t first, std::size_t n, const VertexLump<Lump>* lumps) {
        if (first % (256 * kVerticesPerBlock) == 0) ask_cancel();
        for (std::size_t i = 0; i < n; ++i) names[i] = mesh.name(first + i);
        // The vertices of the next block may be far apart in memory.
        for (std::size_t i = first + n; i < std::min(first + 2 * n, mesh.names.size()); ++i) {
          hwy::Prefetch(mesh_.vertices + mesh.names[i] * mesh_.vertex_stride);
        }
        grid.add_vertices(mesh_, names, n, plan_.block, lumps);
      });
  if (options_.release_vertices && mesh.names.empty() && mesh.n_vertices > 0) {
    options_.release_vertices(mesh.first_vertex, mesh.n_vertices);
  }
}

template <typename T>
void PartWorker<T>::spread(const CommonLumps<Lump>& common, std::size_t begin, std::size_t end,
                           GridSources<T>& grid) const {
  if (begin >= end) return;
  std::uint32_t names[kVerticesPerBlock];
  visit_lumps(common.lumps(begin), end - begin,
              [&](std::size_t first, std::size_t n, const VertexLump<Lump>* lumps) {
                if (first % (256 * kVerticesPerBlock) == 0) ask_cancel();
                for (std::size_t i = 0; i < n; ++i) {
                  names[i] = static_cast<std::uint32_t>(begin + first + i);
                }
                grid.add_vertices(mesh_, names, n, plan_.block, lumps);
              });
}

template <typename T>
void PartWorker<T>::spread(const BorderLumps<Lump>& border, std::size_t begin, std::size_t end,
                           GridSources<T>& grid) const {
  if (begin >= end) return;
  visit_lumps(border.lumps.data() + border.per_vertex * begin, end - begin,
              [&](std::size_t first, std::size_t n, const VertexLump<Lump>* lumps) {
                grid.add_vertices(mesh_, border.vertices.data() + begin + first, n, plan_.block,
                                  lumps);
              });
}

template <typename T>
LumpSums PartWorker<T>::sums_of(const VertexLump<Lump>* lumps, std::size_t n) const {
  LumpSums sums;
  visit_lumps(lumps, n, [&](std::size_t, std::size_t count, const VertexLump<Lump>* block) {
    sums.add(sum_lumps(block, count));
  });
  return sums;
}

template <typename T>
void PartWorker<T>::refuse_mesh() const {
  validate(mesh_);
  throw Error(ErrorCode::kInvalidInput, "the coordinates are too large to be multiplied");
}

template class PartWorker<float>;
template class PartWorker<double>;

}  // namespace rholm
