#include <string>
#include <utility>
#include <variant>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "chart/center/view_center.h"
#include "chart/center/view_scan.h"
#include "rholm/error.h"
#include "rholm/mapped_mesh.h"
#include "rholm/model.h"
#include "rholm/shape_io.h"
#include "transform/analyze.h"
#include "transform/norms/exact_norms.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {
namespace {

struct Topology {
  Welded welded;
  std::vector<Edge> edges;
  bool flipped = false;
};

Topology topology_of(const Mesh& mesh, double weld_tolerance) {
  validate(mesh);
  Topology topology;
  topology.welded = weld(mesh, weld_tolerance);
  topology.welded.mesh.attributes.clear();
  if (enclosed_volume(topology.welded.mesh) < 0) {
    flip(topology.welded.mesh);
    topology.flipped = true;
  }
  topology.edges = pair_edges(topology.welded.mesh);
  return topology;
}

// Says that the mesh was turned even where it is refused afterwards.
StarChart chart_of(Topology& topology, const ChartOptions& options, const Context& context) {
  try {
    return make_star_chart(topology.welded.mesh, std::move(topology.edges), options, context);
  } catch (const Error& error) {
    if (!topology.flipped || error.code() == ErrorCode::kCancelled) throw;
    throw Error(error.code(), std::string("the mesh was inside out and has been turned right side "
                                          "out; then: ") +
                                  error.what());
  }
}

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

// The alternating sum of a surface some of whose faces turn their backs: no norms, no errors, but
// how many directions meet it more than once.
void finish_signed(const MeshView& mesh, const EncodeOptions& options, const Context& context,
                   Encoded& encoded) {
  const int rays = options.chart.center.rays;
  if (rays > 0) {
    encoded.star = timed(encoded.times, "rays",
                         [&] { return check_star(mesh, encoded.star.center, rays, context); });
  }
  finish_analysis(options.analyze, encoded.star.center, encoded.analysis);
}

void set_counts(const MeshView& mesh, Encoded& encoded) {
  encoded.diagonal = diagonal_of(mesh);
  encoded.vertices = mesh.n_vertices;
  encoded.faces = mesh.n_triangles;
  encoded.edges = mesh.n_triangles / 2 * 3;
}

// What a search for a degree has found.
void keep(ToleranceAnalysis found, const EncodeOptions& options, Encoded& encoded) {
  encoded.tolerance = ToleranceReport{.allowed = found.allowed,
                                      .reached = found.reached,
                                      .met = found.met,
                                      .degrees = std::move(found.degrees)};
  const StageTimes times = std::move(encoded.analysis.times);
  encoded.analysis = std::move(found.analysis);
  encoded.analysis.times.insert(times.begin(), times.end());
  if (!options.errors) encoded.analysis.expansion.errors.reset();
}

void add_errors(const MeshView& mesh, bool predict, const Context& context, Encoded& encoded) {
  Analysis& analysis = encoded.analysis;
  if (analysis.expansion.errors) return;  // a search for a degree has measured them
  const double precision = known_error(analysis);
  analysis.expansion.errors = timed(encoded.times, "errors", [&] {
    return truncation_errors(mesh, analysis.expansion, {.precision = precision, .predict = predict},
                             context);
  });
}

// Everything from the mesh as it lies; none if it is not a closed, outward mesh of triangles,
// star-shaped or to be taken as it is: then it must be looked at more closely.
std::optional<Encoded> encode_as_it_lies(const MeshView& mesh, const EncodeOptions& options,
                                         const MeshPassOptions& hooks, const Context& context) {
  if (!uses_mesh_pass(options.analyze) || options.weld_tolerance != 0 || mesh.n_triangles == 0) {
    return std::nullopt;
  }
  check(options.analyze);
  if (options.tolerance) check(*options.tolerance);
  Encoded encoded;
  report_progress(context, "center", 0);
  const std::optional<Vec3> center = timed(encoded.times, "center", [&]() -> std::optional<Vec3> {
    if (options.chart.center.kind == CenterKind::kNone) return Vec3{};
    if (options.chart.center.kind == CenterKind::kGiven) return options.chart.center.point;
    const FoundCenter found =
        search_center(local_view(mesh, context), options.chart.center, context);
    return found.kernel_empty ? std::nullopt : std::optional(found.point);
  });
  if (!center) return std::nullopt;
  MeshPassOptions wanted = hooks;
  wanted.degree = options.analyze.degree;
  wanted.precision = options.analyze.precision;
  wanted.center = *center;
  Analysis& analysis = encoded.analysis;
  // A tolerance decides how precise coefficients must be.
  std::optional<ExactNorms> norms;
  const auto find_norms = [&] {
    norms = timed(analysis.times, "norms", [&] { return exact_norms(mesh, *center, context); });
  };
  ToleranceProblem problem;
  if (options.tolerance) {
    find_norms();
    problem = tolerance_problem(mesh, *center, *norms, options.analyze.precision);
    const TransformTarget pilot = first_pilot(problem, *options.tolerance);
    wanted.degree = pilot.degree;
    wanted.precision = pilot.precision;
  }
  MeshPassResult pass =
      timed(encoded.times, "transform", [&] { return mesh_pass(mesh, wanted, context); });
  if (!pass.closed || !(pass.volume > 0)) return std::nullopt;
  if (pass.bad_triangles > 0) {
    if (!options.chart.allow_signed || options.tolerance) return std::nullopt;
    encoded.star = star_report(pass, *center);
    set_pass(pass, analysis);
    analysis.precision = wanted.precision;
    finish_signed(mesh, options, context, encoded);
    set_counts(mesh, encoded);
    return encoded;
  }
  if (!norms) find_norms();
  // Faces that all turn outwards cover every direction equally often: a second sheet may have few.
  if (!covers_once(*norms)) return std::nullopt;
  encoded.star = star_report(pass, *center);
  set_pass(pass, analysis);
  analysis.precision = wanted.precision;
  if (options.tolerance) {
    problem.transform = [&](const TransformTarget& target) {
      wanted.degree = target.degree;
      wanted.precision = target.precision;
      MeshPassResult next = mesh_pass(mesh, wanted, context);
      Analysis result;
      set_pass(next, result);
      result.precision = target.precision;
      return result;
    };
    problem.pilot = problem.transform;
    timed(encoded.times, "transform", [&] {
      keep(search_tolerance(problem, *options.tolerance, analysis, context), options, encoded);
    });
  }
  analysis.expansion.norm_squared = norms->radius_squared;
  const bool paired = mesh.n_triangles <= kMostPredicted;
  if (paired) {
    analysis.expansion.tail_strength =
        timed(analysis.times, "norms", [&] { return tail_strength(mesh, *center); });
  }
  finish_analysis(options.analyze, *center, analysis);
  if (options.errors) add_errors(mesh, paired, context, encoded);
  set_counts(mesh, encoded);
  return encoded;
}

// Whatever is wrong with a mesh, the slow way says it best.
std::optional<Encoded> encode_if_possible(const MeshView& mesh, const EncodeOptions& options,
                                          const MeshPassOptions& hooks, const Context& context) {
  try {
    return encode_as_it_lies(mesh, options, hooks, context);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return std::nullopt;
  }
}

}  // namespace

std::optional<Encoded> encode_mapped(const MappedMesh& mesh, const EncodeOptions& options,
                                     const Context& context) {
  MeshPassOptions hooks;
  hooks.check = [&](std::size_t first, std::size_t n) { return mesh.counts_are_three(first, n); };
  hooks.release = [&](std::size_t first, std::size_t n) { mesh.release(first, n); };
  return encode_if_possible(mesh.view(), options, hooks, context);
}

Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, std::vector<std::string>* warnings) {
  if (const std::optional<MappedMesh> mapped = map_mesh(path, context)) {
    if (std::optional<Encoded> encoded = encode_mapped(*mapped, options, context)) {
      return std::move(*encoded);
    }
  }
  StageTimes times;
  ShapeFile file = timed(times, "read", [&] { return read_shape(path, {}, context); });
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), file.warnings.begin(), file.warnings.end());
  }
  const Mesh* mesh = std::get_if<Mesh>(&file.shape);
  if (mesh == nullptr) {
    throw Error(ErrorCode::kInvalidInput, path.string() + " holds points, not a mesh");
  }
  Encoded encoded = encode(*mesh, options, context);
  encoded.times.merge(times);
  return encoded;
}

Encoded encode(const Mesh& mesh, const EncodeOptions& options, const Context& context) {
  validate(mesh);
  if (std::optional<Encoded> encoded = encode_if_possible(view_of(mesh), options, {}, context)) {
    return std::move(*encoded);
  }
  Encoded encoded;
  encoded.diagonal = bounds(mesh.vertices).diagonal();
  report_progress(context, "topology", 0);
  Topology topology =
      timed(encoded.times, "topology", [&] { return topology_of(mesh, options.weld_tolerance); });
  report_progress(context, "center", 0);
  const StarChart chart =
      timed(encoded.times, "center", [&] { return chart_of(topology, options.chart, context); });
  encoded.star = chart.report;
  encoded.vertices = chart.mesh.vertices.size();
  encoded.faces = chart.mesh.triangles.size();
  encoded.edges = chart.edges.size();
  encoded.merged_vertices = topology.welded.merged_vertices;
  encoded.collapsed_triangles = topology.welded.collapsed_triangles;
  encoded.flipped = topology.flipped;
  timed(encoded.times, "transform", [&] {
    if (options.tolerance) {
      keep(analyze(chart, *options.tolerance, options.analyze, context), options, encoded);
    } else {
      encoded.analysis = analyze(chart, options.analyze, context);
    }
  });
  if (options.errors && chart.report.star_shaped) {
    add_errors(view_of(topology.welded.mesh), true, context, encoded);
  }
  return encoded;
}

}  // namespace rholm
