#include "transform/mesh_pass/pass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/stopwatch.h"
#include "rholm/error.h"
#include "shape/queries/triangle_order.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/plan/plan.h"
#include "transform/mesh_pass/run_pass.h"
#include "transform/mesh_pass/sampled_error.h"

namespace rholm {
namespace {

// Largest number of tries to keep the precision: a second is rare, a third needs no sample.
constexpr int kMostTries = 3;

// The error from a sample, times this or with its uncertainty, must be within the precision
// (chosen).
constexpr double kSampleMargin = 2;

// A mesh with a sample of it. Faces in random order are sorted: otherwise every corner misses the
// cache, and neighbours, which are not known, are not seen to cancel.
struct PassInput {
  MeshView mesh;
  MeshPassOptions options;
  MeshSample sample;
  std::optional<OrderedTriangles> ordered;
};

// Smaller meshes fit into the cache, and are sampled whole.
constexpr std::size_t kWorthOrdering = 8192;

PassInput pass_input(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                     StageTimes& times) {
  PassInput input{.mesh = mesh,
                  .options = options,
                  .sample = sample_mesh(mesh, options.center, options.degree),
                  .ordered = {}};
  const auto order = [&](TriangleKey key) {
    const StageTimer timer(times, "order");
    const auto check = [&](std::size_t first, std::size_t n) {
      check_triangles(input.options, first, n);
    };
    input.ordered = order_triangles(mesh, key, check, input.options.release, context);
    input.mesh = input.ordered->view;
    input.options.check = {};
    input.options.release = {};
    input.options.executor = nullptr;
    input.sample = sample_mesh(input.mesh, options.center, options.degree);
  };
  const auto in_order = [&] { return input.sample.edge_share > 0; };
  if (in_order() || mesh.n_faces < kWorthOrdering) return input;
  if (vertices_in_order(mesh)) order(TriangleKey::kVertex);
  if (!in_order()) order(TriangleKey::kPosition);
  return input;
}

// Returns the factor that divides the allowed errors of the next pass, after a pass that missed the
// precision. The plan may have allowed far more error than the pass made; the new limit must be
// below the latter. It is half as much again, because not all errors follow the limit.
double tightened(double error, double modelled, const MeshPlan& plan, double precision,
                 double norm) {
  const double planned =
      std::hypot(plan.allowed.rules, plan.allowed.window, plan.quanta_error) / plan.block.scale;
  const double slack = std::max(1.0, planned / (modelled * norm));
  return 1.5 * slack * error / precision;
}

// Measures the error of rules on a sample of a large mesh, and window errors that add up. Returns
// the error that must be within the precision, relative as in FastReport::error.
double measure(const PassInput& input, const MeshPlan& plan, const Context& context, double norm,
               MeshPassResult& result) {
  FastReport& report = result.report;
  const bool sampled = input.mesh.n_faces > kMostVerified && result.closed;
  if (!sampled || plan.divided.degree == 0 || !(norm > 0)) {
    return report.error;
  }
  const SampledError sample = timed(result.times, "verify", [&] {
    return sample_error(input.mesh, input.options, plan, result.transform, result.block_errors,
                        context);
  });
  const double unscale = 1 / plan.block.scale;
  const int degree = plan.divided.degree;
  const double band = norm_of_degrees(result.coefficients, 3 * degree / 4 + 1, degree);
  const double rules = unscale * sample.rules, uncertainty = unscale * sample.uncertainty;
  const double windows = unscale * sample.windows;
  const auto with_all_else = [&](double measured) {
    return std::hypot(measured, result.error_beside) / norm;
  };
  report.measured_share = sample.share;
  report.error = with_all_else(std::hypot(rules, windows));
  report.error_uncertainty = with_all_else(std::hypot(rules + uncertainty, windows)) - report.error;
  report.band_error =
      band > 0 ? std::hypot(unscale * sample.band, result.band_error_beside) / band : 0;
  return with_all_else(
      std::hypot(std::max(kSampleMargin * rules, rules + uncertainty), kSampleMargin * windows));
}

}  // namespace

MeshPassResult mesh_pass(const MeshView& mesh, const MeshPassOptions& options,
                         const Context& caller) {
  if (mesh.n_faces == 0) {
    throw Error(ErrorCode::kInvalidInput, "the mesh has no faces");
  }
  StageTimes times;
  PassInput input = pass_input(mesh, options, caller, times);
  // The progress of a second pass does not go back.
  double furthest = 0;
  Context context = caller;
  if (caller.progress) {
    context.progress = [&](std::string_view stage, double fraction) {
      furthest = std::max(furthest, fraction);
      return caller.progress(stage, furthest);
    };
  }
  PlanLimits limits;
  for (int passes = 1, tries = 1;; ++passes) {
    const MeshPlan plan = plan_mesh(input.mesh, input.sample, options.center, options.degree,
                                    options.precision, limits);
    MeshPassResult result;
    result.times = std::move(times);
    const Outcome outcome = run_pass(input.mesh, input.options, plan, context, result);
    result.report.passes = passes;
    if (outcome == Outcome::kOutOfRange) limits.forbid_single = true;  // happens at most once
    if (outcome == Outcome::kDone) {
      // The sample may have missed large errors, or taken the norm for larger than it is.
      const double norm = norm_of_degrees(result.coefficients, 1, options.degree);
      result.least_error = norm > 0 ? plan.allowed.rounding / norm : 1.0;
      const double precision = std::max(options.precision, result.least_error);
      const double modelled = result.report.error;
      const double error = measure(input, plan, context, norm, result);
      result.report.reached = !(error > precision);
      if (result.report.reached || tries++ == kMostTries) return result;
      limits.tighten *= tightened(error, modelled, plan, precision, norm);
      limits.no_lumps = tries == kMostTries;  // the last try does not trust the sample's lumps
    }
    times = std::move(result.times);
  }
}

}  // namespace rholm
