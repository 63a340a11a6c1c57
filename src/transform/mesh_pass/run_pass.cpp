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

// Parts, and grids with them, that are there at a time: as many as are held.
constexpr std::size_t kPartsAtATime = 8;
// Vertices whose lumps in common are added up at a time (chosen: some 100 us).
constexpr std::size_t kCommonGrain = 64 * kVerticesPerBlock;
// Vertices that are spread one after the other, as they lie (chosen: of 4 to 64 blocks rows of
// 1000 want the most, subdivided bodies the least, a tenth of the time of spreading either way).
constexpr std::size_t kRun = 16 * kVerticesPerBlock;
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
  Pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
       const Context& context)
      : mesh_(mesh),
        options_(options),
        plan_(plan),
        context_(context),
        streamed_(mesh.n_triangles > options.most_held),
        upfront_(streamed_ || plan.nodes > kFewNodes),
        sums_(plan_) {}

  Outcome run(MeshPassResult& result) {
    if (upfront_) {
      choose_window(kUnseen2 * plan_.source2, kUnseen2 * plan_.hessian2, estimated_sources());
    }
    division_ = divide_triangles(mesh_.n_triangles, part_count());
    worker_.emplace(mesh_, options_, plan_, division_);
    if (division_.count > 1 && division_.count <= kPartsAtATime && !streamed_ &&
        parts_overlap(mesh_, division_)) {
      common_.emplace(mesh_.n_vertices, lumps_per_vertex(plan_.block.hessians));
    }
    if (options_.executor != nullptr) groups_ = group_count();
    if (groups_ > 1) shared_.emplace(mesh_, options_, plan_, division_);
    {
      const StageTimer timer(result.times, "triangles");
      if (shared_ || !common_) find_ranges();
      if (shared_) {
        share_parts();
      } else {
        work_parts();
      }
      if (common_) add_up_common();
    }
    if (const Outcome outcome = sums_.finish(*worker_); outcome != Outcome::kDone) return outcome;
    {
      const StageTimer timer(result.times, "spread");
      if (!upfront_) spread_held();
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
           static_cast<std::size_t>(plan_.nodes * static_cast<double>(mesh_.n_triangles));
  }

  std::size_t part_count() const {
    if (!streamed_) {
      return upfront_ ? grid_count(transform_, estimated_sources()) : held_parts(mesh_.n_triangles);
    }
    if (options_.streamed_parts > 0) return options_.streamed_parts;
    return streamed_parts(mesh_.n_triangles, plan_.divided.degree);
  }

  // Tasks of other processes: what is held goes from a process as whole grids.
  std::size_t group_count() const {
    if (upfront_) return division_.count;
    const std::size_t sources = estimated_sources();
    const NonuniformPlan likely =
        window_plan(kUnseen2 * plan_.source2, kUnseen2 * plan_.hessian2, sources);
    return std::min(division_.count, grid_count(likely, sources));
  }

  void choose_window(double source2, double hessian2, std::size_t sources) {
    transform_ = window_plan(source2, hessian2, sources);
    kernel_ = grid_kernel<T>(transform_.fourier);
  }

  // `hessian2`: L^2 times Hessians, whose part in the error depends on the grid.
  NonuniformPlan window_plan(double source2, double hessian2, std::size_t sources) const {
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
    NonuniformPlan plan = plan_nonuniform(needs);
    plan.single = sizeof(T) == 4;
    return plan;
  }

  std::unique_ptr<GridSources<T>> new_grid() const {
    return std::make_unique<GridSources<T>>(transform_, kernel_);
  }

  void find_ranges() {
    std::vector<IndexRange> ranges(division_.count);
    if (shared_) {
      options_.executor->run(
          {.count = ranges.size(), .job = kPassJob, .input = ranges_job(plan_, division_)},
          [&](std::size_t p, int) { return shared_->range_of(p); },
          [&](std::size_t p, const std::string& bytes) { ByteReader(bytes).value(ranges[p]); });
      shared_->set_ranges(ranges, groups_, common_.has_value());
      if (upfront_) shared_->set_transform(transform_);
      return worker_->set_ranges(std::move(ranges));
    }
    parallel_for(ranges.size(), 1, {.threads = context_.threads}, {},
                 [&](std::size_t p, std::size_t) { ranges[p] = worker_->range_of(p); });
    worker_->set_ranges(std::move(ranges));
  }

  // A few parts at a time: what they leave is added up in their order before the next begin.
  void work_parts() {
    SharedProgress progress(context_, "triangles", 0, before_spread(),
                            static_cast<double>(mesh_.n_triangles));
    for (std::size_t first = 0; first < division_.count; first += kPartsAtATime) {
      const std::size_t n = std::min(kPartsAtATime, division_.count - first);
      std::vector<WorkedPart<T>> worked(n);
      std::vector<std::unique_ptr<GridSources<T>>> grids(upfront_ ? n : 0);
      parallel_for(n, 1, {.threads = threads_for_parts()}, {}, [&](std::size_t i, std::size_t) {
        if (upfront_) grids[i] = new_grid();
        worked[i] = common_ ? worker_->work(first + i, *common_, grids_of(grids, i), progress)
                            : worker_->work(first + i, grids_of(grids, i), progress);
        if (!upfront_) return;
        if (!common_) worker_->spread(worked[i], *grids[i]);
        grids[i]->flush();
        worked[i].mesh = {};
        worked[i].lumps = {};
      });
      for (const WorkedPart<T>& one : worked) sums_.add(one.part, common_.has_value());
      if (!upfront_) {
        held_ = std::move(worked);
      } else if (division_.count <= kPartsAtATime) {
        grids_ = std::move(grids);
      } else {
        add_to_whole(grids);
        spread_done_border(first + n);
      }
    }
  }

  static GridSources<T>* grids_of(const std::vector<std::unique_ptr<GridSources<T>>>& grids,
                                  std::size_t i) {
    return grids.empty() ? nullptr : grids[i].get();
  }

  // What of the whole is done when spreading begins; that of vertices in common is by itself.
  static constexpr double kBeforeSpread = 0.6;
  double before_spread() const {
    if (common_) return upfront_ ? kBeforeSpread : 0.5;
    return upfront_ ? 0.9 : 0.5;
  }

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
                       worker_->sums_of(common_->add_up(begin, end - begin), end - begin);
                 });
    for (const LumpSums& one : sums) sums_.add_common(one);
  }

  // Runs of vertices from pole to pole, as many to each grid: files may have the vertices of all of
  // the sphere once and again, level by level, and rows of a grid that are left stay behind.
  void spread_common() {
    const std::vector<std::size_t> runs = runs_by_height();
    const std::size_t n = grids_.size();
    SharedProgress progress(context_, "spread", kBeforeSpread, 0.9,
                            static_cast<double>(mesh_.n_vertices));
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      for (std::size_t k = g * runs.size() / n; k < (g + 1) * runs.size() / n; ++k) {
        const std::size_t begin = runs[k], end = std::min(mesh_.n_vertices, begin + kRun);
        worker_->spread(*common_, begin, end, *grids_[g]);
        progress.add(end - begin);
      }
      grids_[g]->flush();
    });
    common_.reset();
    if (options_.release_vertices) options_.release_vertices(0, mesh_.n_vertices);
  }

  // The first vertices of runs, by where the sphere has the one in their middle.
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

  // The same by several processes: what they leave is added up in the order of the parts.
  void share_parts() {
    SharedProgress progress(context_, "triangles", 0, before_spread(),
                            static_cast<double>(mesh_.n_triangles));
    options_.executor->run(
        {.count = groups_,
         .dealt = !upfront_ && !common_,
         .job = kPassJob,
         .input = parts_job(worker_->ranges(), groups_, common_.has_value(),
                            upfront_ ? &transform_ : nullptr)},
        [&](std::size_t group, int) { return shared_->work(group); },
        [&](std::size_t group, const std::string& bytes) {
          ByteReader reader(bytes);
          const std::size_t first = shared_->first(group, groups_);
          const std::size_t end = shared_->first(group + 1, groups_);
          for (std::size_t p = first; p < end; ++p) {
            sums_.add(read_part<T>(reader), common_.has_value());
            if (upfront_) {
              take_grid(p, reader);
            } else if (common_) {
              MeshPart<T>& part = held_.emplace_back().part;
              reader.array(part.kept);
              reader.array(part.kept_gradients);
            }
            progress.add(division_.n(p));
          }
          if (common_) common_->add_written(reader);
          reader.finish();
        });
  }

  void take_grid(std::size_t p, ByteReader& reader) {
    if (division_.count <= kPartsAtATime || grids_.empty()) grids_.push_back(new_grid());
    grids_.back()->add_written(reader);
    if (division_.count <= kPartsAtATime) return;
    if ((p + 1) % kPartsAtATime == 0 || p + 1 == division_.count) spread_done_border(p + 1);
  }

  // Of the parts before p: else what parts share would grow with the mesh.
  void spread_done_border(std::size_t p) {
    const auto done = sums_.take_border(ranges_from(worker_->ranges(), p), *worker_);
    worker_->spread(done, 0, done.vertices.size(), *grids_[0]);
  }

  void add_to_whole(const std::vector<std::unique_ptr<GridSources<T>>>& grids) {
    if (grids_.empty()) grids_.push_back(new_grid());
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

  // Parts that were held, to as many grids as pay.
  void spread_held() {
    choose_window(sums_.source2(), sums_.hessian2(), mesh_.n_vertices + sums_.n_kept());
    const std::size_t parts = division_.count;
    const std::size_t n = std::min(parts, grid_count(transform_, estimated_sources()));
    for (std::size_t g = 0; g < n; ++g) grids_.push_back(new_grid());
    SharedProgress progress(context_, "spread", before_spread(), common_ ? kBeforeSpread : 0.9,
                            static_cast<double>(parts));
    if (shared_ && !common_) {
      shared_->set_transform(transform_);
      return options_.executor->run(
          {.count = n, .dealt = true, .job = kPassJob, .input = grids_job(n, transform_)},
          [&](std::size_t g, int) { return shared_->spread(g, n); },
          [&](std::size_t g, const std::string& bytes) {
            ByteReader reader(bytes);
            grids_[g]->add_written(reader);
            reader.finish();
            progress.add(shared_->first(g + 1, n) - shared_->first(g, n));
          });
    }
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      for (std::size_t p = g * parts / n; p < (g + 1) * parts / n; ++p) {
        worker_->spread(held_[p], *grids_[g]);
        progress.add(1);
      }
      grids_[g]->flush();
    });
    held_.clear();
  }

  void spread_border() {
    const std::size_t n = grids_.size(), vertices = sums_.border().vertices.size();
    parallel_for(n, 1, {.threads = context_.threads}, {}, [&](std::size_t g, std::size_t) {
      worker_->spread(sums_.border(), g * vertices / n, (g + 1) * vertices / n, *grids_[g]);
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
  MeshPlan plan_;
  const Context& context_;
  bool streamed_;  // what parts leave is not held: see kMostHeld
  bool upfront_;   // the window is chosen before the triangles are worked
  PassSums<T> sums_;
  Division division_;
  std::optional<PartWorker<T>> worker_;
  std::optional<CommonLumps<LumpOf<T>>> common_;  // where the vertices of parts lie scattered
  std::size_t groups_ = 0;                        // of parts, see group_count()
  std::optional<SharedParts<T>> shared_;          // with other processes, if there are any
  std::vector<WorkedPart<T>> held_;
  NonuniformPlan transform_;
  GridKernel<T> kernel_;
  std::vector<std::unique_ptr<GridSources<T>>> grids_;
};

}  // namespace

Outcome run_pass(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
                 const Context& context, MeshPassResult& result) {
  if (plan.single) return Pass<float>(mesh, options, plan, context).run(result);
  return Pass<double>(mesh, options, plan, context).run(result);
}

}  // namespace rholm
