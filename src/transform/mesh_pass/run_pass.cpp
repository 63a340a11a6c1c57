#include "transform/mesh_pass/run_pass.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "harmonic/coefficients/laplacian.h"
#include "rholm/error.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/grid_sources.h"
#include "transform/mesh_pass/part_worker.h"
#include "transform/mesh_pass/pass_sums.h"
#include "transform/mesh_pass/shared_parts.h"

namespace rholm {
namespace {

// Number of parts, with their grids, in memory at a time (chosen).
constexpr std::size_t kPartsAtATime = 8;
// Number of vertices whose lumps in common are added up at a time (chosen: some 100 us).
constexpr std::size_t kCommonGrain = 64 * kVerticesPerBlock;
// Number of vertices that are spread one after the other, in file order. Chosen among 4 to 64
// blocks: rows of 1000 need the most, subdivided bodies the least, a tenth of the time of spreading
// either way.
constexpr std::size_t kRun = 16 * kVerticesPerBlock;
// The window is chosen before the squares of sources are known. They are assumed to be this many
// times the sample's value. On steep surfaces the sample misses up to six times (Igea and Ryugu to
// degree 128 and more, where `expand --json` reported two passes). The price is a point of width,
// a twentieth of the pass.
constexpr double kUnseen2 = 8;

// One pass through the faces with a given plan; T is the type of the windows.
template <typename T>
class Pass {
 public:
  Pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
       const Context& context)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        context_(context),
        sums_(plan_),
        transform_(window_plan()),
        division_(divide_triangles(mesh.n_faces, wanted_parts())),
        worker_(mesh, options, plan, division_, transform_) {}

  Outcome run(MeshPassResult& result) {
    // Without lumps in common `expand()` of subdivided bodies (1.3 and 5.2 million faces, degrees
    // 64 and 480) takes 1.08 to 1.14 times as long. Sorting costs more: where the faces of these
    // files are shuffled, and sorted first, it takes 2.2 times as long.
    if (division_.count > 1 && has_few_parts() && parts_overlap(mesh_, division_)) {
      common_.emplace(mesh_.n_vertices, lumps_per_vertex(plan_.block.hessians));
    }
    {
      const StageTimer timer(result.times, "faces");
      if (options_.executor != nullptr && division_.count > 1) {
        share_parts();
      } else {
        work_parts();
      }
      if (common_) add_up_common();
    }
    if (const Outcome outcome = sums_.finish(worker_); outcome != Outcome::kDone) return outcome;
    {
      const StageTimer timer(result.times, "spread");
      common_ ? spread_common() : spread_border();
    }
    {
      const StageTimer timer(result.times, "fourier");
      transform_grids(result);
    }
    return Outcome::kDone;
  }

 private:
  std::size_t estimated_sources() const {
    return mesh_.n_vertices +
           static_cast<std::size_t>(plan_.nodes * static_cast<double>(mesh_.n_faces));
  }

  std::size_t wanted_parts() const {
    if (options_.parts > 0) return options_.parts;
    return part_count(mesh_.n_faces, plan_.divided.degree,
                      grid_count(transform_, estimated_sources()));
  }

  NonuniformPlan window_plan() const {
    const double source2 = kUnseen2 * plan_.source2;
    const double allowed = options_.window_share * allowed_window_error(plan_, source2);
    NonuniformNeeds needs{
        .degree = plan_.divided.degree,
        .allowed = std::clamp(allowed, 1e-15, 1e-2),
        .sources = estimated_sources(),
        .derivatives = plan_.block.hessians ? 2 : 1,
        .forbid_single = sizeof(T) == 8,
        // The sum of squares contains gradients already.
        .gradient_size = 0,
        // L^2 times Hessians; their part in the error depends on the grid.
        .hessian_size = std::sqrt(kUnseen2 * plan_.hessian2 / std::max(source2, 1e-300)),
        .spread_out = mesh_.n_vertices};
    NonuniformPlan plan = plan_nonuniform(needs);
    plan.single = sizeof(T) == 4;
    return plan;
  }

  // Grids of few parts are kept until the end; grids of more parts are added up.
  bool has_few_parts() const { return division_.count <= kPartsAtATime; }

  std::vector<IndexRange> find_ranges() const {
    std::vector<IndexRange> ranges(division_.count);
    parallel_for(ranges.size(), 1, {.threads = context_.threads}, {},
                 [&](std::size_t p, std::size_t) { ranges[p] = worker_.range_of(p); });
    return ranges;
  }

  // Computes a few parts at a time. Their results are added up in their order before the next parts
  // begin.
  void work_parts() {
    if (!common_) worker_.set_ranges(find_ranges());
    SharedProgress progress(context_, "faces", 0, before_spread(),
                            static_cast<double>(mesh_.n_faces));
    for (std::size_t first = 0; first < division_.count; first += kPartsAtATime) {
      const std::size_t n = std::min(kPartsAtATime, division_.count - first);
      std::vector<MeshPart<T>> parts(n);
      std::vector<std::unique_ptr<GridSources<T>>> grids(n);
      parallel_for(n, 1, {.threads = threads_for_parts()}, {}, [&](std::size_t i, std::size_t) {
        grids[i] = worker_.new_grid();
        parts[i] = common_ ? worker_.work(first + i, *common_, *grids[i], progress)
                           : worker_.work(first + i, *grids[i], progress);
      });
      for (const MeshPart<T>& part : parts) sums_.add(part, common_.has_value());
      if (has_few_parts()) {
        grids_ = std::move(grids);
      } else {
        add_to_whole(grids);
        spread_done_border(first + n);
      }
    }
  }

  // Progress when spreading begins. Spreading vertices in common has its own part.
  static constexpr double kBeforeCommon = 0.6;
  double before_spread() const { return common_ ? kBeforeCommon : 0.9; }

  int threads_for_parts() const {
    if (!common_) return context_.threads;
    return static_cast<int>(
        std::min<std::size_t>(thread_count(context_), common_->most_borrowed()));
  }

  void add_up_common() {
    const std::size_t n = mesh_.n_vertices;
    std::vector<LumpSums> sums((n + kCommonGrain - 1) / kCommonGrain);
    parallel_for(n, kCommonGrain, {.threads = context_.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   sums[begin / kCommonGrain] =
                       worker_.sums_of(common_->add_up(begin, end - begin), end - begin);
                 });
    for (const LumpSums& one : sums) sums_.add_common(one);
  }

  // Spreads runs of vertices from pole to pole, an equal number to each grid. Files may have
  // vertices of the whole sphere again and again, level by level. In the order of heights, rows of
  // a grid that have been left are not needed again.
  void spread_common() {
    const std::vector<std::size_t> runs = runs_by_height();
    const std::size_t n = grids_.size();
    SharedProgress progress(context_, "spread", kBeforeCommon, 0.9,
                            static_cast<double>(mesh_.n_vertices));
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      for (std::size_t k = g * runs.size() / n; k < (g + 1) * runs.size() / n; ++k) {
        const std::size_t begin = runs[k], end = std::min(mesh_.n_vertices, begin + kRun);
        worker_.spread(*common_, begin, end, *grids_[g]);
        progress.add(end - begin);
      }
      grids_[g]->flush();
    });
    common_.reset();
    if (options_.release_vertices) options_.release_vertices(0, mesh_.n_vertices);
  }

  // Returns the first vertices of runs, ordered by the height of the run's middle vertex on the
  // sphere.
  std::vector<std::size_t> runs_by_height() const {
    struct Run {
      double height;
      std::size_t first;
    };
    std::vector<Run> runs;
    for (std::size_t first = 0; first < mesh_.n_vertices; first += kRun) {
      const std::size_t middle = std::min(first + kRun / 2, mesh_.n_vertices - 1);
      const Vec3 x = plan_.block.scale * (mesh_.vertex(middle) - options_.center);
      const double r = norm(x);
      runs.push_back({r > 0 && std::isfinite(r) ? x.z / r : 0, first});
    }
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
      return a.height != b.height ? a.height < b.height : a.first < b.first;
    });
    std::vector<std::size_t> firsts;
    firsts.reserve(runs.size());
    for (const Run& run : runs) firsts.push_back(run.first);
    return firsts;
  }

  // Lets several processes compute the parts. Their results are added up in the order of the parts.
  void share_parts() {
    std::vector<IndexRange> ranges(division_.count);
    options_.executor->run(
        {.count = division_.count,
         .job = kPassJob,
         .input = ranges_job(plan_, transform_, division_)},
        [&](std::size_t p, int) { return range_task(worker_, p); },
        [&](std::size_t p, const std::string& bytes) { ByteReader(bytes).value(ranges[p]); });
    const std::string input = parts_job(ranges, common_.has_value());
    worker_.set_ranges(std::move(ranges));
    SharedProgress progress(context_, "faces", 0, before_spread(),
                            static_cast<double>(mesh_.n_faces));
    options_.executor->run(
        {.count = division_.count, .job = kPassJob, .input = input},
        [&](std::size_t p, int) { return part_task(worker_, common_.has_value(), p); },
        [&](std::size_t p, const std::string& bytes) {
          ByteReader reader(bytes);
          take_part(p, reader);
          progress.add(division_.n(p));
        });
  }

  void take_part(std::size_t p, ByteReader& reader) {
    sums_.add(read_part<T>(reader), common_.has_value());
    if (has_few_parts() || grids_.empty()) grids_.push_back(worker_.new_grid());
    grids_.back()->add_written(reader);
    if (common_) common_->add_written(reader);
    reader.finish();
    if (has_few_parts()) return;
    if ((p + 1) % kPartsAtATime == 0 || p + 1 == division_.count) spread_done_border(p + 1);
  }

  // Spreads the complete border of the parts before p. Otherwise shared data would grow with the
  // mesh.
  void spread_done_border(std::size_t p) {
    const auto done = sums_.take_border(ranges_from(worker_.ranges(), p), worker_);
    worker_.spread(done, 0, done.vertices.size(), *grids_[0]);
  }

  void add_to_whole(const std::vector<std::unique_ptr<GridSources<T>>>& grids) {
    if (grids_.empty()) grids_.push_back(worker_.new_grid());
    double* const whole = grids_[0]->cells();
    constexpr std::size_t kCells = std::size_t{1} << 16;  // chosen: some 100 us
    parallel_for(transform_.fourier.layout.cells(), kCells, {.threads = context_.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   for (const auto& grid : grids) {
                     const double* cells = grid->cells();
                     for (std::size_t i = begin; i < end; ++i) whole[i] += cells[i];
                   }
                 });
    for (const auto& grid : grids) grids_[0]->count_as_own(*grid);
  }

  void spread_border() {
    const std::size_t n = grids_.size(), vertices = sums_.border().vertices.size();
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      worker_.spread(sums_.border(), g * vertices / n, (g + 1) * vertices / n, *grids_[g]);
      grids_[g]->flush();
    });
  }

  void transform_grids(MeshPassResult& result) {
    Coefficients sum(plan_.divided.degree);
    std::vector<GridSpreader<T>> spreaders;
    double source2 = 0, hessian2 = 0;
    for (auto& grid : grids_) {
      source2 += grid->source2();
      hessian2 += grid->hessian2();
      spreaders.push_back(grid->take_spreader());
    }
    finish_adjoint<T>(transform_, spreaders, sum, context_, {"transform", 0.9, 1});
    divide_by_eigenvalue(sum);
    sums_.set_result(mesh_, std::move(sum), source2, hessian2, transform_, result);
  }

  const MeshView& mesh_;
  const MeshPassOptions& options_;
  const MeshPlan plan_;
  const Context& context_;
  PassSums<T> sums_;
  const NonuniformPlan transform_;
  const Division division_;
  PartWorker<T> worker_;
  std::optional<CommonLumps<LumpOf<T>>> common_;  // if the vertices of parts are scattered
  std::vector<std::unique_ptr<GridSources<T>>> grids_;
};

}  // namespace

Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result) {
  if (plan.single) return Pass<float>(mesh, options, plan, context).run(result);
  return Pass<double>(mesh, options, plan, context).run(result);
}

}  // namespace rholm
