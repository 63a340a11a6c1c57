#include "model/encode/expand.h"

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
#include "transform/analyze.h"
#include "transform/error/error_sites.h"
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

// Returns the fault that a pass finds in the mesh, if there is one.
std::optional<NotInPlace> fault_in(const MeshPassResult& pass, const EncodeOptions& options) {
  if (!pass.closed) return NotInPlace::kNotClosed;
  if (!(pass.volume > 0)) return NotInPlace::kInsideOut;
  if (pass.bad_triangles > 0 && !may_fold(options)) return NotInPlace::kFolded;
  return std::nullopt;
}

// Stores the result of a search for a degree; `encoded` keeps its times.
void set_found(ToleranceAnalysis found, const EncodeOptions& options, Encoded& encoded) {
  encoded.tolerance = ToleranceReport{.allowed = found.allowed,
                                      .reached = found.reached,
                                      .met = found.met,
                                      .degrees = std::move(found.degrees)};
  const StageTimes times = std::move(encoded.analysis.times);
  encoded.analysis = std::move(found.analysis);
  encoded.analysis.times.insert(times.begin(), times.end());
  if (!options.errors) encoded.analysis.expansion.errors.reset();
}

// Measures the errors of the surface, unless they are not wanted or a search has done so. `sites`
// belong to the mesh about the centre of its expansion. If `predict`, the largest errors are also
// predicted from the edges.
void add_errors(ErrorSites& sites, bool predict, const EncodeOptions& options,
                const Context& context, Encoded& encoded) {
  Analysis& analysis = encoded.analysis;
  if (!options.errors || analysis.expansion.errors) return;
  const double precision = known_error(analysis);
  analysis.expansion.errors = timed(encoded.times, "errors", [&] {
    return truncation_errors(analysis.expansion, {.precision = precision, .predict = predict},
                             sites, context);
  });
}

// Expands one mesh, from its centre to the errors of its coefficients. `prepared` has the centre
// of a closed, outward mesh and its star report. Without it, a pass checks all of these
// properties.
class Expand {
 public:
  Expand(const MeshView& mesh, const EncodeOptions& options, const MeshPassOptions& hooks,
         const Context& context, const std::optional<StarReport>& prepared = {})
      : mesh_(mesh),
        options_(options),
        pass_options_(hooks),
        context_(context),
        prepared_(prepared.has_value()),
        seen_(prepared) {
    if (seen_) pass_options_.center = seen_->center;
  }

  std::variant<Encoded, NotInPlace> run() {
    if (!prepared_ && !find_center()) return NotInPlace::kNoCenter;
    const std::optional<ToleranceProblem> problem = tolerance_problem();
    const TransformTarget first =
        problem ? first_pilot(*problem, *options_.tolerance)
                : TransformTarget{options_.analyze.degree, options_.analyze.precision};
    MeshPassResult pass = timed(encoded_.times, "transform", [&] { return pass_to(first); });
    const bool star_shaped = prepared_ ? seen_->star_shaped : pass.bad_triangles == 0;
    if (!prepared_) {
      if (const std::optional<NotInPlace> fault = fault_in(pass, options_)) return *fault;
      // If all faces turn outwards, all directions are covered equally often: a second sheet may
      // have few faces.
      if (star_shaped && !covers_once(norms())) return NotInPlace::kCoveredTwice;
    }
    if (!problem) {
      timed(encoded_.times, "transform",
            [&] { verify_pass(mesh_, pass_options_, context_, pass); });
    }
    if (seen_ && (prepared_ || !star_shaped)) {
      encoded_.star = *seen_;
    } else {
      encoded_.star = star_report(pass, center());
      encoded_.star.center_fell_back = seen_.has_value();
    }
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

  // Returns true if there is a centre.
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
    seen_ = better_center(view, program, wanted.rays, context_);
    pass_options_.center = seen_->center;
    return true;
  }

  // A tolerance needs the norms before the first pass, everything else after it.
  const ExactNorms& norms() {
    if (!norms_) {
      norms_ = timed(analysis().times, "norms", [&] {
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

  // Finishes the signed sum of a surface with faces that turn inwards. There are no norms and no
  // errors, but a count of the directions that meet the surface more than once.
  void finish_signed() {
    const int rays = options_.chart.center.rays;
    if (!seen_ && rays > 0) {
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
  MeshPassOptions pass_options_;  // includes the centre, once it is found
  const Context& context_;
  const bool prepared_;
  std::optional<StarReport> seen_;  // set for a prepared mesh, or one without a kernel
  std::optional<ExactNorms> norms_;
  FaceSizes sizes_;  // with the norms, if errors are wanted
  Encoded encoded_;
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
Encoded expand_by_chart(PreparedMesh& mesh, const EncodeOptions& options, const Context& context) {
  Encoded encoded;
  const Mesh& welded = mesh.shape.welded.mesh;
  const StarChart chart = timed_center(mesh, encoded.times, [&] {
    return make_star_chart(welded, std::move(mesh.edges), options.chart, context);
  });
  encoded.star = chart.report;
  encoded.vertices = chart.mesh.vertices.size();
  encoded.faces = chart.mesh.triangles.size();
  encoded.edges = chart.edges.size();
  timed(encoded.times, "transform", [&] {
    if (options.tolerance) {
      set_found(analyze(chart, *options.tolerance, options.analyze, context), options, encoded);
    } else {
      encoded.analysis = analyze(chart, options.analyze, context);
    }
  });
  if (chart.report.star_shaped) {
    ErrorSites sites(view_of(welded), encoded.analysis.expansion.center, context.threads);
    add_errors(sites, true, options, context, encoded);
  }
  return encoded;
}

}  // namespace

std::variant<Encoded, NotInPlace> expand_in_place(const MeshView& mesh,
                                                  const EncodeOptions& options,
                                                  const MeshPassOptions& hooks,
                                                  const Context& context) {
  check(options.analyze);
  if (options.tolerance) check(*options.tolerance);
  if (!uses_mesh_pass(options.analyze) || options.weld_tolerance != 0) return NotInPlace::kOptions;
  if (mesh.n_triangles == 0) return NotInPlace::kUnusable;
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

Encoded expand(PreparedMesh& mesh, const EncodeOptions& options, const Context& context) {
  report_progress(context, "center", 0);
  if (!uses_mesh_pass(options.analyze)) return expand_by_chart(mesh, options, context);
  // The star check is more precise than a pass: it uses the rounding error of each face.
  const Mesh& welded = mesh.shape.welded.mesh;
  StageTimes times;
  const StarReport star =
      timed_center(mesh, times, [&] { return seen_surface(welded, options.chart, context); });
  if (options.tolerance) require_one_sheet(star);
  Encoded encoded = std::get<Encoded>(Expand(view_of(welded), options, {}, context, star).run());
  encoded.times.merge(times);
  return encoded;
}

}  // namespace rholm
