#include "model/expand/expand.h"

#include <optional>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "chart/center/view_center.h"
#include "rholm/error.h"
#include "rholm/star.h"
#include "shape/repair/thin_faces.h"
#include "shape/vertex_range.h"
#include "transform/error/error_sites.h"
#include "transform/mesh_pass/verify.h"
#include "transform/norms/exact_norms.h"
#include "transform/tolerance/search.h"
#include "transform/tolerance/tolerance.h"
#include "transform/transform.h"

namespace rholm {
namespace {

StarReport star_report(const MeshPassResult& pass, const Vec3& center) {
  StarReport report;
  report.center = center;
  report.min_d = pass.min_d;
  report.min_cos_gamma = pass.min_cos_gamma;
  report.bad_faces = pass.bad_faces;
  report.star_shaped = pass.bad_faces == 0;
  report.once_share = report.star_shaped ? 1 : 0;
  return report;
}

bool may_fold(const ExpandOptions& options) {
  return options.chart.allow_signed && !options.tolerance;
}

// Returns the fault that a pass finds in the mesh, if there is one.
std::optional<NotInPlace> fault_in(const MeshPassResult& pass, const ExpandOptions& options) {
  if (!pass.closed) return NotInPlace::kNotClosed;
  if (!(pass.volume > 0)) return NotInPlace::kInsideOut;
  if (pass.bad_faces > 0 && !may_fold(options)) return NotInPlace::kFolded;
  return std::nullopt;
}

// Stores the result of a search for a degree; `expanded` keeps its times.
void set_found(ToleranceTransform found, const ExpandOptions& options, Expanded& expanded) {
  expanded.tolerance = ToleranceReport{.allowed = found.allowed,
                                       .reached = found.reached,
                                       .met = found.met,
                                       .degrees = std::move(found.degrees)};
  const StageTimes times = std::move(expanded.transform.times);
  expanded.transform = std::move(found.transform);
  expanded.transform.times.insert(times.begin(), times.end());
  if (!options.errors) expanded.transform.expansion.errors.reset();
}

// Measures the errors of the surface, unless they are not wanted or a search has done so. `sites`
// belong to the mesh about the centre of its expansion. If `predict`, the largest errors are also
// predicted from the edges.
void add_errors(ErrorSites& sites, bool predict, const ExpandOptions& options,
                const Context& context, Expanded& expanded) {
  Transform& transform = expanded.transform;
  if (!options.errors || transform.expansion.errors) return;
  const double precision = known_error(transform);
  transform.expansion.errors = timed(expanded.times, "errors", [&] {
    return truncation_errors(transform.expansion, {.precision = precision, .predict = predict},
                             sites, context);
  });
}

// Expands one mesh, from its centre to the errors of its coefficients. `prepared` has the centre
// of a closed, outward mesh and its star report. Without it, a pass checks all of these
// properties.
class Expand {
 public:
  Expand(const MeshView& mesh, const ExpandOptions& options, const MeshPassOptions& hooks,
         const Context& context, const std::optional<StarReport>& prepared = {})
      : mesh_(mesh),
        options_(options),
        pass_options_(hooks),
        context_(context),
        prepared_(prepared.has_value()),
        seen_(prepared) {
    if (seen_) pass_options_.center = seen_->center;
  }

  std::variant<Expanded, NotInPlace> run() {
    if (!prepared_ && !find_center()) return NotInPlace::kNoCenter;
    const std::optional<ToleranceProblem> problem = tolerance_problem();
    const TransformTarget first = problem ? first_pilot(*problem, *options_.tolerance)
                                          : TransformTarget{options_.degree, options_.precision};
    MeshPassResult pass = timed(expanded_.times, "transform", [&] { return pass_to(first); });
    const bool star_shaped = prepared_ ? seen_->star_shaped : pass.bad_faces == 0;
    if (!prepared_) {
      if (const std::optional<NotInPlace> fault = fault_in(pass, options_)) return *fault;
      // If all faces turn outwards, all directions are covered equally often: a second sheet may
      // have few faces.
      if (star_shaped && !covers_once(norms())) return NotInPlace::kCoveredTwice;
    }
    if (!problem) {
      timed(expanded_.times, "transform",
            [&] { verify_pass(mesh_, pass_options_, context_, pass); });
    }
    if (seen_ && (prepared_ || !star_shaped)) {
      expanded_.star = *seen_;
    } else {
      expanded_.star = star_report(pass, center());
      expanded_.star.center_fell_back = seen_.has_value();
    }
    set_pass(pass, transform());
    transform().precision = first.precision;
    if (problem) search(*problem);
    if (star_shaped) {
      finish_star();
    } else {
      finish_signed();
    }
    set_counts();
    return std::move(expanded_);
  }

 private:
  Transform& transform() { return expanded_.transform; }
  const Vec3& center() const { return pass_options_.center; }

  // Returns true if there is a centre.
  bool find_center() {
    report_progress(context_, "center", 0);
    const StageTimer timer(expanded_.times, "center");
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
    seen_ = better_center(view, program, wanted.rays, context_);
    pass_options_.center = seen_->center;
    return true;
  }

  // A tolerance needs the norms before the first pass, everything else after it.
  const ExactNorms& norms() {
    if (!norms_) {
      norms_ = timed(transform().times, "norms", [&] {
        return exact_norms(mesh_, center(), context_, options_.errors ? &sizes_ : nullptr,
                           pass_options_.executor);
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
        rholm::tolerance_problem(mesh_, center(), norms(), options_.precision, context_);
    problem.pilot = [this](const TransformTarget& target) {
      return transform_of(pass_to(target), target.precision);
    };
    problem.transform = [this](const TransformTarget& target) {
      MeshPassResult pass = pass_to(target);
      verify_pass(mesh_, pass_options_, context_, pass);
      return transform_of(std::move(pass), target.precision);
    };
    return problem;
  }

  void search(const ToleranceProblem& problem) {
    timed(expanded_.times, "transform", [&] {
      set_found(search_tolerance(problem, *options_.tolerance, transform(), context_), options_,
                expanded_);
    });
  }

  void finish_star() {
    Expansion& expansion = transform().expansion;
    expansion.norm_squared = norms().radius_squared;
    const bool paired = mesh_.n_faces <= kMostPredicted;
    if (paired) {
      expansion.tail_strength = timed(transform().times, "norms",
                                      [&] { return tail_strength(mesh_, center(), context_); });
    }
    finish_transform(transform_options(options_), center(), transform());
    ErrorSites sites(mesh_, center(), std::move(sizes_), context_.threads);
    add_errors(sites, paired, options_, context_, expanded_);
  }

  // Finishes the signed sum of a surface with faces that turn inwards. There are no norms and no
  // errors, but a count of the directions that meet the surface more than once.
  void finish_signed() {
    const int rays = options_.chart.center.rays;
    if (!seen_ && rays > 0) {
      expanded_.star = timed(expanded_.times, "rays",
                             [&] { return check_star(mesh_, center(), rays, context_); });
    }
    transform().expansion.signed_sum = true;
    finish_transform(transform_options(options_), center(), transform());
  }

  void set_counts() {
    expanded_.diagonal = diagonal_of(mesh_, context_);
    expanded_.vertices = mesh_.n_vertices;
    expanded_.faces = mesh_.n_faces;
    expanded_.edges = mesh_.n_faces / 2 * 3;
  }

  const MeshView& mesh_;
  const ExpandOptions& options_;
  MeshPassOptions pass_options_;  // includes the centre, once it is found
  const Context& context_;
  const bool prepared_;
  std::optional<StarReport> seen_;  // set for a prepared mesh, or one without a kernel
  std::optional<ExactNorms> norms_;
  FaceSizes sizes_;  // with the norms, if errors are wanted
  Expanded expanded_;
};

// Adds to the error that the mesh was turned, also if no centre sees it.
template <typename Seek>
auto timed_center(const PreparedMesh& mesh, StageTimes& times, const Seek& seek) {
  try {
    return timed(times, "center", seek);
  } catch (const Error& error) {
    const bool is_of_mesh =
        error.code() == ErrorCode::kInvalidInput || error.code() == ErrorCode::kNotStarShaped;
    if (!mesh.shape.flipped || !is_of_mesh) throw;
    throw Error(error.code(), std::string("the mesh was inside out and has been turned right side "
                                          "out; then: ") +
                                  error.what());
  }
}

// Expands by other methods than the mesh pass: the gauge, and the oracles.
Expanded expand_by_chart(PreparedMesh& mesh, const ExpandOptions& options, const Context& context) {
  Expanded expanded;
  const Mesh& welded = mesh.shape.welded.mesh;
  const StarChart chart = timed_center(mesh, expanded.times, [&] {
    return make_star_chart(welded, std::move(mesh.edges), options.chart, context);
  });
  expanded.star = chart.report;
  expanded.vertices = chart.mesh.vertices.size();
  expanded.faces = chart.mesh.faces.size();
  expanded.edges = chart.edges.size();
  timed(expanded.times, "transform", [&] {
    if (options.tolerance) {
      set_found(expand(chart, *options.tolerance, transform_options(options), context), options,
                expanded);
    } else {
      expanded.transform = expand(chart, transform_options(options), context);
    }
  });
  if (chart.report.star_shaped) {
    ErrorSites sites(view_of(welded), expanded.transform.expansion.center, context.threads);
    add_errors(sites, true, options, context, expanded);
  }
  return expanded;
}

}  // namespace

std::variant<Expanded, NotInPlace> expand_in_place(const MeshView& mesh,
                                                   const ExpandOptions& options,
                                                   const MeshPassOptions& hooks,
                                                   const Context& context) {
  check(transform_options(options));
  if (options.tolerance) check(*options.tolerance);
  if (!uses_mesh_pass(transform_options(options)) || options.weld_tolerance != 0)
    return NotInPlace::kOptions;
  if (mesh.n_faces == 0) return NotInPlace::kUnusable;
  try {
    return Expand(mesh, options, hooks, context).run();
  } catch (const Error& error) {
    // The loops over triangles cannot continue with an invalid triangle, and throw in any thread.
    // All options have been checked, so that InvalidInput means an invalid triangle here.
    if (error.code() != ErrorCode::kInvalidInput) throw;
    return NotInPlace::kUnusable;
  }
}

PreparedMesh prepare(const Mesh& mesh, double weld_tolerance) {
  PreparedMesh prepared{.shape = outward(mesh, weld_tolerance), .edges = {}};
  Mesh& welded = prepared.shape.welded.mesh;
  welded.attributes.clear();
  // Thin faces have random planes, which would distort slopes and errors.
  swap_thin_faces(welded);
  prepared.edges = pair_edges(welded);
  return prepared;
}

Expanded expand(PreparedMesh& mesh, const ExpandOptions& options, const Context& context) {
  report_progress(context, "center", 0);
  if (!uses_mesh_pass(transform_options(options))) return expand_by_chart(mesh, options, context);
  // The star check is more precise than a pass: it uses the rounding error of each face.
  const Mesh& welded = mesh.shape.welded.mesh;
  StageTimes times;
  const StarReport star =
      timed_center(mesh, times, [&] { return seen_surface(welded, options.chart, context); });
  if (options.tolerance) require_one_sheet(star);
  Expanded expanded = std::get<Expanded>(Expand(view_of(welded), options, {}, context, star).run());
  expanded.times.merge(times);
  return expanded;
}

}  // namespace rholm
