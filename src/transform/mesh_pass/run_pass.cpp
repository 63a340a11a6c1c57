#include "transform/mesh_pass/run_pass.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "harmonic/coefficients/laplacian.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/error.h"
#include "transform/mesh_pass/grid_sources.h"
#include "transform/mesh_pass/hermite_nodes.h"
#include "transform/mesh_pass/own_nodes.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/scatter.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {
namespace {

constexpr std::size_t kBlockSize = kTrianglesPerBlock;
// Blocks between two reports of progress: about 1 ms.
constexpr std::size_t kBlocksPerStep = 512;
constexpr std::size_t kVerticesPerStep = 256 * kVerticesPerBlock;
// Below so many nodes per triangle these are kept until the sums of squares are known
// exactly; above, they are spread as they come, to a window chosen from the sample.
constexpr double kFewNodes = 0.05;

// Windows that are chosen before the squares of sources are known take them for this many times
// what the sample says: of steep surfaces it misses up to six times (Igea and Ryugu to degree 128
// and more, which `analyze --json` said took two passes). The price is a point of width, a
// twentieth of the pass.
constexpr double kUnseen2 = 8;

// One way through the triangles with a given plan; windows in T.
template <typename T>
class Pass {
 public:
  using Lump = LumpOf<T>;

  Pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
       const Context& context)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        context_(context),
        arrays_(mesh.n_vertices, plan.block.hessians),
        n_blocks_((mesh.n_triangles + kBlockSize - 1) / kBlockSize) {}

  Outcome run(MeshPassResult& result) {
    const bool upfront = plan_.nodes > kFewNodes;
    if (upfront) {
      choose_window(kUnseen2 * plan_.source2, kUnseen2 * plan_.hessian2, estimated_sources());
      make_grids();
    }
    parts_ = std::vector<MeshPart>(upfront ? grids_.size() : part_count());
    {
      const StageTimer timer(result.times, "triangles");
      work_triangles();
    }
    BlockSums sums = no_triangles();
    double kept2 = 0, node_weight = 0;
    std::size_t kept = 0;
    for (const MeshPart& part : parts_) {
      if (part.too_many) return Outcome::kTooManyNodes;
      sums.add(part.sums);
      kept2 += part.source2;
      node_weight += part.weight;
      kept += part.kept.size() + part.kept_gradients.size();
      result.report.nodes += part.nodes;
    }
    check_sums(sums);
    const LumpSums lumps = sum_all_lumps();
    // The weights of each triangle add up to nothing.
    const double whole_weight = lumps.weight + plan_.block.per_weight * node_weight;
    if (sizeof(T) == 4 && std::abs(whole_weight) > 0x1p31) return Outcome::kOutOfRange;
    const double lumps2 = squares_of(lumps);
    const double hessian2 =
        plan_.block.hessians
            ? std::pow(std::pow(plan_.divided.degree, 2) / plan_.block.per_hessian, 2) *
                  lumps.hessian2
            : 0;
    if (!upfront) {
      choose_window(kept2 + lumps2, hessian2, mesh_.n_vertices + kept);
      make_grids();
    }
    {
      const StageTimer timer(result.times, "spread");
      spread_vertices();
    }
    {
      const StageTimer timer(result.times, "fourier");
      transform_grids(result);
    }
    set_result(sums, plan_.block.hessians ? 0 : lumps2, result);
    return Outcome::kDone;
  }

 private:
  std::size_t estimated_sources() const {
    return mesh_.n_vertices +
           static_cast<std::size_t>(plan_.nodes * static_cast<double>(mesh_.n_triangles));
  }

  // Parts of the triangles when they need no grids: as many as pay, whatever the number of threads.
  std::size_t part_count() const {
    return std::clamp<std::size_t>(mesh_.n_triangles / 20000, 1, 8);
  }

  // `hessian2`: L^2 times Hessians, whose part in the error depends on the grid.
  void choose_window(double source2, double hessian2, std::size_t sources) {
    const double allowed = options_.window_share * allowed_window_error(plan_, source2);
    NonuniformNeeds needs{.degree = plan_.divided.degree,
                          .allowed = std::clamp(allowed, 1e-15, 1e-2),
                          .sources = sources,
                          .derivatives = plan_.block.hessians ? 2 : 1,
                          .forbid_single = sizeof(T) == 8,
                          // The sum of squares has gradients in it already.
                          .gradient_size = 0,
                          .hessian_size = std::sqrt(hessian2 / std::max(source2, 1e-300)),
                          .spread_out = mesh_.n_vertices};
    transform_ = plan_nonuniform(needs);
    transform_.single = sizeof(T) == 4;
    kernel_ = grid_kernel<T>(transform_.fourier);
  }

  void make_grids() {
    const std::size_t n = grid_count(transform_, estimated_sources());
    for (std::size_t i = 0; i < n; ++i) {
      grids_.push_back(std::make_unique<GridSources<T>>(transform_, kernel_));
    }
  }

  void work_triangles() {
    const std::size_t n = parts_.size(), size = (n_blocks_ + n - 1) / n;
    SharedProgress progress(context_, "triangles", 0, 0.5, static_cast<double>(n_blocks_));
    const Context silent{.threads = context_.threads};
    parallel_for(n_blocks_, size, silent, {}, [&](std::size_t begin, std::size_t end) {
      work_part(begin / size, begin, end, progress);
    });
  }

  void work_part(std::size_t p, std::size_t begin, std::size_t end, SharedProgress& progress) {
    MeshPart& part = parts_[p];
    BlockParameters parameters = plan_.block;
    auto lumps = arrays_.take();
    auto block = std::make_unique<TriangleBlock<Lump>>();
    PartSink<T> sink(part, grids_.empty() ? nullptr : grids_[p].get(), plan_);
    const ScaledVertices vertices{
        .mesh = mesh_, .center = parameters.scale * parameters.center, .scale = parameters.scale};
    NodeWriter writer({plan_.divided, plan_.undivided}, vertices, sink);
    NodesBetween between(vertices, sink);
    const auto look_at = [&](std::size_t b) {
      const std::size_t first = b * kBlockSize;
      const std::size_t n = std::min(kBlockSize, mesh_.n_triangles - first);
      check_triangles(options_, first, n);
      const std::uint32_t largest = largest_index(mesh_, first, n);
      if (largest >= mesh_.n_vertices) refuse_mesh();
      ask_for_lumps(mesh_, first, n, parameters.hessians, lumps->data());
      return largest;
    };
    const double mean_reach2 = std::max(parameters.mean_reach2, parameters.mean_nodes_reach2);
    std::uint32_t next_largest = look_at(begin);
    for (std::size_t b = begin; b < end; ++b) {
      ask_cancel();
      const std::size_t first = b * kBlockSize;
      const std::size_t n = std::min(kBlockSize, mesh_.n_triangles - first);
      parameters.largest_index = next_largest;
      if (b + 1 < end) next_largest = look_at(b + 1);
      const std::size_t before = part.sums.nodes;
      work_block(mesh_, first, n, parameters, *block, part.sums);
      scatter_lumps(mesh_, first, n, parameters.hessians, *block, lumps->data());
      if (block->has_nodes_between) between.add(mesh_, first, n, *block);
      sample_half_edges(*block, n, part.half_edges);
      if (part.sums.nodes != before || part.sums.max_edge2 > mean_reach2) {
        write_nodes(*block, first, n, writer, part);
      }
      if ((b - begin) % kBlocksPerStep == kBlocksPerStep - 1) {
        if (options_.release) {
          options_.release(first + n - kBlocksPerStep * kBlockSize, kBlocksPerStep * kBlockSize);
        }
        progress.add(kBlocksPerStep);
      }
    }
    writer.flush();
    part.node_error2 = writer.error2();
    between.flush();
    sink.sum_undivided();
    arrays_.give_back(std::move(lumps));
  }

  void write_nodes(const TriangleBlock<Lump>& block, std::size_t first, std::size_t n,
                   NodeWriter& writer, MeshPart& part) {
    for (std::size_t t = 0; t < n; ++t) {
      if (block.flag[t] == kLumped) continue;
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = {block.corner[i][0][t], block.corner[i][1][t], block.corner[i][2][t]};
      }
      if ((block.flag[t] & kNodes) != 0) {
        writer.add_triangle(p, mesh_.triangle(first + t));
      }
      if ((block.flag[t] & kMeanNodes) != 0) part.mean += radius_integral(p, plan_.allowed.mean);
    }
  }

  void check_sums(const BlockSums& sums) const {
    if (!std::isfinite(sums.probe)) refuse_mesh();
  }

  // Says what is wrong with a mesh in which something is.
  [[noreturn]] void refuse_mesh() const {
    validate(mesh_);
    throw Error(ErrorCode::kInvalidInput, "the coordinates are too large to be multiplied");
  }

  LumpSums sum_all_lumps() const {
    std::vector<LumpSums> steps((mesh_.n_vertices + kVerticesPerStep - 1) / kVerticesPerStep);
    parallel_for(mesh_.n_vertices, kVerticesPerStep, {.threads = context_.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   LumpSums& step = steps[begin / kVerticesPerStep];
                   visit_lumps(begin, end, [&](std::size_t, std::size_t n, const auto* lumps) {
                     step.add(sum_lumps(lumps, n, plan_.block.hessians));
                   });
                 });
    LumpSums sums;
    for (const LumpSums& step : steps) sums.add(step);
    return sums;
  }

  // Calls visit(first, n, lumps) for blocks of vertices.
  template <typename Visit>
  void visit_lumps(std::size_t begin, std::size_t end, const Visit& visit) const {
    alignas(64) VertexLump<Lump> room[kLumpsPerBlock];
    for (std::size_t first = begin; first < end; first += kVerticesPerBlock) {
      const std::size_t n = std::min(kVerticesPerBlock, end - first);
      visit(first, n, arrays_.sums(first, n, room));
    }
  }

  // Gradients as much as they count in a window's error.
  double squares_of(const LumpSums& lumps) const {
    const double weight = 1 / plan_.block.per_weight,
                 slope = gradient_as_weight(plan_.divided.degree) / plan_.block.per_gradient;
    return weight * weight * lumps.weight2 + slope * slope * lumps.gradient2;
  }

  void spread_vertices() {
    const std::size_t n = grids_.size();
    // In whole blocks.
    const std::size_t blocks = (mesh_.n_vertices + kVerticesPerBlock - 1) / kVerticesPerBlock;
    const std::size_t size = (blocks + n - 1) / n * kVerticesPerBlock;
    SharedProgress progress(context_, "spread", 0.5, 0.9, static_cast<double>(mesh_.n_vertices));
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      GridSources<T>& grid = *grids_[g];
      for (std::size_t p = g; p < parts_.size(); p += n) {
        grid.add(parts_[p].kept);
        for (const GradientNode& node : parts_[p].kept_gradients) grid.add(node);
      }
      const std::size_t end = std::min(mesh_.n_vertices, (g + 1) * size);
      for (std::size_t from = g * size; from < end; from += kVerticesPerStep) {
        const std::size_t to = std::min(end, from + kVerticesPerStep);
        visit_lumps(from, to, [&](std::size_t first, std::size_t count, const auto* lumps) {
          grid.add_vertices(mesh_, first, count, plan_.block, lumps);
        });
        progress.add(to - from);
      }
      grid.flush();
    });
  }

  void transform_grids(MeshPassResult& result) {
    Coefficients sum(plan_.divided.degree);
    std::vector<GridSpreader<T>> spreaders;
    for (auto& grid : grids_) {
      source2_ += grid->source2();
      hessian2_ += grid->hessian2();
      spreaders.push_back(grid->take_spreader());
    }
    finish_adjoint<T>(transform_, spreaders, sum, context_, {"transform", 0.9, 1});
    divide_by_eigenvalue(sum);
    for (const MeshPart& part : parts_) {
      if (part.undivided.degree() != sum.degree()) continue;
      for (std::size_t i = 0; i < sum.values().size(); ++i) {
        sum.values()[i] += part.undivided.values()[i];
      }
    }
    result.coefficients = std::move(sum);
  }

  void set_result(const BlockSums& sums, double lumps2, MeshPassResult& result) {
    double mean = sums.mean;
    for (const MeshPart& part : parts_) mean += part.mean;
    Coefficients& c = result.coefficients;
    c.c(0, 0) = mean / std::sqrt(4 * std::numbers::pi);
    const double unscale = 1 / plan_.block.scale;
    for (double& value : c.values()) value *= unscale;
    result.volume = sums.volume6 / 6 * unscale * unscale * unscale;
    result.closed = sums.hash1 == 0 && sums.hash2 == 0;
    const auto root = [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); };
    result.min_d = root(sums.min_d2) * unscale;
    result.min_cos_gamma = root(sums.min_cos2);
    result.bad_triangles = sums.bad;
    FastReport& report = result.report;
    report.single = sizeof(T) == 4;
    report.width = transform_.fourier.layout.width;
    report.oversampling = static_cast<double>(transform_.fourier.layout.n_phi) /
                          (2.0 * std::max(plan_.divided.degree, 1));
    report.lumped_triangles = mesh_.n_triangles - sums.nodes;
    report.vertices = mesh_.n_vertices;
    set_error(sums, lumps2, result);
  }

  void set_error(const BlockSums& sums, double lumps2, MeshPassResult& result) {
    PassFacts facts{.face_error2 = sums.face_error2,
                    .half_edges = {},
                    .source2 = source2_ + lumps2,
                    .hessian2 = hessian2_,
                    .vertices = mesh_.n_vertices,
                    .transform = transform_};
    for (const MeshPart& part : parts_) {
      facts.node_error2 += part.node_error2;
      facts.node_modulus += part.modulus;
      facts.half_edges.insert(facts.half_edges.end(), part.half_edges.begin(),
                              part.half_edges.end());
    }
    const PassError error = error_of_pass(plan_, facts, result.coefficients);
    const int degree = plan_.divided.degree;
    const auto relative = [&](double absolute, int first) {
      const double norm = norm_of_degrees(result.coefficients, first, degree);
      return norm > 0 ? absolute / norm : 0.0;
    };
    result.report.error = relative(error.whole, 1);
    result.report.band_error = relative(error.band, 3 * degree / 4 + 1);
  }

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  MeshPlan plan_;
  const Context& context_;
  LumpArrays<Lump> arrays_;
  std::size_t n_blocks_;
  std::vector<MeshPart> parts_;
  NonuniformPlan transform_;
  GridKernel<T> kernel_;
  std::vector<std::unique_ptr<GridSources<T>>> grids_;
  double source2_ = 0;  // of nodes; of vertices as well if they have Hessians
  double hessian2_ = 0;
};

}  // namespace

Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result) {
  if (plan.single) return Pass<float>(mesh, options, plan, context).run(result);
  return Pass<double>(mesh, options, plan, context).run(result);
}

void check_triangles(const MeshPassOptions& options, std::size_t first, std::size_t n) {
  if (options.check && !options.check(first, n)) {
    throw Error(ErrorCode::kInvalidInput, "a face is not a triangle");
  }
}

}  // namespace rholm
