#include "model/encode/as_it_lies.h"

#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "chart/center/view_center.h"
#include "model/encode/encoded_parts.h"
#include "rholm/error.h"
#include "shape/vertex_range.h"
#include "transform/analyze.h"
#include "transform/mesh_pass/verify.h"
#include "transform/norms/exact_norms.h"
#include "transform/tolerance/search.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {
namespace {

StarReport star_report(const MeshPassResult& pass, const Vec3& center) {
  StarReport report;
  report.center = center;
  report.min_d = pass.min_d;
  report.min_cos_gamma = pass.min_cos_gamma;
  report.bad_triangles = pass.bad_triangles;
  report.star_shaped = pass.bad_triangles == 0;
  report.once_share = report.star_shaped ? 1 : 0;
  return report;
}

bool may_fold(const EncodeOptions& options) {
  return options.chart.allow_signed && !options.tolerance;
}

// What a pass finds wrong with the mesh.
std::optional<NotAsItLies> fault_in(const MeshPassResult& pass, const EncodeOptions& options) {
  if (!pass.closed) return NotAsItLies::kNotClosed;
  if (!(pass.volume > 0)) return NotAsItLies::kInsideOut;
  if (pass.bad_triangles > 0 && !may_fold(options)) return NotAsItLies::kFolded;
  return std::nullopt;
}

// One mesh on its way.
class AsItLies {
 public:
  AsItLies(const MeshView& mesh, const EncodeOptions& options, const MeshPassOptions& hooks,
           const Context& context)
      : mesh_(mesh),
        options_(options),
        pass_options_(hooks),
        share_(hooks.share),
        context_(context) {
    pass_options_.share = with_tag(share_, kPassTag);
  }

  std::variant<Encoded, NotAsItLies> run() {
    if (!find_center()) return NotAsItLies::kNoCenter;
    const std::optional<ToleranceProblem> problem = tolerance_problem();
    const TransformTarget first =
        problem ? first_pilot(*problem, *options_.tolerance)
                : TransformTarget{options_.analyze.degree, options_.analyze.precision};
    MeshPassResult pass = timed(encoded_.times, "transform", [&] { return pass_to(first); });
    if (const std::optional<NotAsItLies> fault = fault_in(pass, options_)) return *fault;
    // Faces that all turn outwards cover every direction equally often: a second sheet may have
    // few.
    const bool star_shaped = pass.bad_triangles == 0;
    if (star_shaped && !covers_once(norms())) return NotAsItLies::kCoveredTwice;
    if (!problem) {
      timed(encoded_.times, "transform",
            [&] { verify_pass(mesh_, pass_options_, context_, pass); });
    }
    encoded_.star = star_report(pass, center());
    encoded_.star.center_fell_back = folded_.has_value();
    set_pass(pass, analysis());
    analysis().precision = first.precision;
    if (problem) search(*problem);
    if (star_shaped) {
      finish_star();
    } else {
      finish_signed();
    }
    set_counts();
    return std::move(encoded_);
  }

 private:
  Analysis& analysis() { return encoded_.analysis; }
  const Vec3& center() const { return pass_options_.center; }

  // Whether there is one.
  bool find_center() {
    report_progress(context_, "center", 0);
    const StageTimer timer(encoded_.times, "center");
    const CenterOptions& wanted = options_.chart.center;
    if (wanted.kind == CenterKind::kNone) return true;
    if (wanted.kind == CenterKind::kGiven) {
      pass_options_.center = wanted.point;
      return true;
    }
    const LocalView view = local_view(mesh_, context_);
    const FoundCenter found = search_center(view, wanted, context_);
    pass_options_.center = found.point;
    if (!found.kernel_empty) return true;
    if (!may_fold(options_) || !view.closed()) return false;
    const StarReport program = check_star(view, found.point, wanted.rays, context_);
    folded_ = better_center(view, program, wanted.rays, context_);
    pass_options_.center = folded_->center;
    return true;
  }

  // A tolerance needs them before the first pass, all else after it.
  const ExactNorms& norms() {
    if (!norms_) {
      norms_ = timed(analysis().times, "norms", [&] {
        return exact_norms(mesh_, center(), context_, options_.errors ? &sizes_ : nullptr,
                           with_tag(share_, kNormsTag));
      });
    }
    return *norms_;
  }

  MeshPassResult pass_to(const TransformTarget& target) {
    pass_options_.degree = target.degree;
    pass_options_.precision = target.precision;
    return mesh_pass(mesh_, pass_options_, context_);
  }

  std::optional<ToleranceProblem> tolerance_problem() {
    if (!options_.tolerance) return std::nullopt;
    ToleranceProblem problem =
        rholm::tolerance_problem(mesh_, center(), norms(), options_.analyze.precision, context_);
    problem.pilot = [this](const TransformTarget& target) {
      return analysis_of(pass_to(target), target.precision);
    };
    problem.transform = [this](const TransformTarget& target) {
      MeshPassResult pass = pass_to(target);
      verify_pass(mesh_, pass_options_, context_, pass);
      return analysis_of(std::move(pass), target.precision);
    };
    return problem;
  }

  void search(const ToleranceProblem& problem) {
    timed(encoded_.times, "transform", [&] {
      set_found(search_tolerance(problem, *options_.tolerance, analysis(), context_), options_,
                encoded_);
    });
  }

  void finish_star() {
    Expansion& expansion = analysis().expansion;
    expansion.norm_squared = norms().radius_squared;
    const bool paired = mesh_.n_triangles <= kMostPredicted;
    if (paired) {
      expansion.tail_strength = timed(analysis().times, "norms",
                                      [&] { return tail_strength(mesh_, center(), context_); });
    }
    finish_analysis(options_.analyze, center(), analysis());
    ErrorSites sites(mesh_, center(), std::move(sizes_), context_.threads);
    add_errors(sites, paired, options_, context_, encoded_);
  }

  // The signed sum of a surface some of whose faces turn their backs: no norms, no errors, but
  // how many directions meet it more than once.
  void finish_signed() {
    const int rays = options_.chart.center.rays;
    if (folded_) {
      encoded_.star = *folded_;
    } else if (rays > 0) {
      encoded_.star = timed(encoded_.times, "rays",
                            [&] { return check_star(mesh_, center(), rays, context_); });
    }
    analysis().expansion.signed_sum = true;
    finish_analysis(options_.analyze, center(), analysis());
  }

  void set_counts() {
    encoded_.diagonal = diagonal_of(mesh_, context_);
    encoded_.vertices = mesh_.n_vertices;
    encoded_.faces = mesh_.n_triangles;
    encoded_.edges = mesh_.n_triangles / 2 * 3;
  }

  const MeshView& mesh_;
  const EncodeOptions& options_;
  MeshPassOptions pass_options_;  // with the centre, once it is found
  ShareTasks share_;
  const Context& context_;
  std::optional<StarReport> folded_;  // of a surface without a kernel
  std::optional<ExactNorms> norms_;
  FaceSizes sizes_;  // with the norms, if errors are wanted
  Encoded encoded_;
};

}  // namespace

ShareTasks with_tag(const ShareTasks& share, char tag) {
  if (!share) return {};
  return [share, tag](const SharedTasks& tasks, const DoSharedTask& here,
                      const TakeSharedResult& take) {
    SharedTasks tagged = tasks;
    tagged.job.insert(tagged.job.begin(), tag);
    share(tagged, here, take);
  };
}

std::variant<Encoded, NotAsItLies> encode_as_it_lies(const MeshView& mesh,
                                                     const EncodeOptions& options,
                                                     const MeshPassOptions& hooks,
                                                     const Context& context) {
  check(options.analyze);
  if (options.tolerance) check(*options.tolerance);
  if (!uses_mesh_pass(options.analyze) || options.weld_tolerance != 0) return NotAsItLies::kOptions;
  if (mesh.n_triangles == 0) return NotAsItLies::kUnusable;
  try {
    return AsItLies(mesh, options, hooks, context).run();
  } catch (const Error& error) {
    // The loops over triangles cannot go on where one makes no sense, and end by an exception in
    // whatever thread it is. With all checks of options done, that is what InvalidInput means here.
    if (error.code() != ErrorCode::kInvalidInput) throw;
    return NotAsItLies::kUnusable;
  }
}

}  // namespace rholm
