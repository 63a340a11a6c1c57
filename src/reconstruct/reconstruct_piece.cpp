#include "reconstruct/reconstruct_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "atlas/cover/cap_cover.h"
#include "atlas/cover/cap_size.h"
#include "base/check_fields.h"
#include "base/stopwatch.h"
#include "reconstruct/output/surface_confidence.h"
#include "reconstruct/points/known_spacings.h"
#include "reconstruct/points/reconstruct_rules.h"
#include "reconstruct/reconstruct_points.h"
#include "rholm/error.h"
#include "shape/measure.h"
#include "surface/atlas_surface.h"

namespace rholm {
namespace {

// Of a point with its normal, its part of trees and caps: 297 bytes (scripts/memory-figures).
constexpr std::size_t kMemoryOfPoint = 300;

// Caps for the points, without those near the surface that belong to none.
Cover fit_caps(WorkingPoints& points, const ReconstructOptions& options, CapSize& size,
               ReconstructReport& report, const Context& context) {
  const auto measure = [&] {
    size = choose_cap_size(points.ordered(), kDegree, context);
    if (options.noise) size.noise = *options.noise;
  };
  measure();
  const auto fit = [&] { return cover(points.ordered(), cover_options(options, size), context); };
  const auto n = static_cast<double>(points.size());
  const auto strays = static_cast<double>(report.outliers);
  const double wrong = !options.keep_outliers ? n * points.wrong_normals(context) : 0;
  if (!are_suspicious(n, strays, wrong)) return fit();
  std::size_t found = points.remove_outliers(size.noise, most_outliers(strays, wrong), {}, context);
  Cover caps;
  if (found == 0) {
    caps = fit();
    found = points.remove_outliers(size.noise, 2 * caps.rejected.size(), caps.rejected, context);
    if (found == 0 && !caps.caps.empty()) return caps;
  }
  report.outliers += found;
  measure();
  return fit();
}

// The box of the points that are finite.
Bounds finite_bounds(const std::vector<Vec3>& points) {
  Bounds box;
  bool any = false;
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    if (!any) box = {.min = p, .max = p};
    any = true;
    for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      box.min.*axis = std::min(box.min.*axis, p.*axis);
      box.max.*axis = std::max(box.max.*axis, p.*axis);
    }
  }
  return box;
}

// The supports of most caps are at least this.
double typical_support(const Atlas& atlas) {
  std::vector<double> supports;
  supports.reserve(atlas.caps.size());
  for (const Cap& cap : atlas.caps) supports.push_back(cap.frame.support);
  const auto fifth = supports.begin() + static_cast<std::ptrdiff_t>(supports.size() / 5);
  std::nth_element(supports.begin(), fifth, supports.end());
  return *fifth;
}

// The area with larger errors is kSparseShare of the whole.
double error_of_sparse(const Atlas& atlas) {
  struct Part {
    double error, area;
  };
  std::vector<Part> parts;
  parts.reserve(atlas.caps.size());
  double area = 0;
  for (const Cap& cap : atlas.caps) {
    parts.push_back({cap.error, cap.area});
    area += cap.area;
  }
  const auto larger = [](const Part& a, const Part& b) { return a.error > b.error; };
  double sum = 0;
  // The first few will do: no more are sorted.
  for (auto part = parts.begin(); part != parts.end();) {
    const auto end = part + (parts.end() - part + 15) / 16;
    if (end != parts.end()) std::nth_element(part, end, parts.end(), larger);
    std::sort(part, end, larger);
    for (; part != end; ++part) {
      sum += part->area;
      if (sum > kSparseShare * area) return part->error;
    }
  }
  return 0;
}

}  // namespace

Reconstruction reconstruct_piece(PointCloud cloud, const ReconstructOptions& options,
                                 const Context& context) {
  check_fields(options);
  const std::size_t least = kMemoryOfPoint * cloud.points.size();
  if (least > options.max_memory) {
    constexpr double kGibibyte = 0x1p30;
    throw Error(ErrorCode::kOutOfMemory,
                fmt::format("{} points in one piece need more than {:.2g} GiB, and {:.2g} are "
                            "allowed: allow more memory",
                            cloud.points.size(), static_cast<double>(least) / kGibibyte,
                            static_cast<double>(options.max_memory) / kGibibyte));
  }
  Reconstruction result;
  ReconstructReport& report = result.report;
  StageTimes& times = report.times;
  report.bounds = finite_bounds(cloud.points);
  WorkingPoints points = timed(
      times, "points", [&] { return WorkingPoints(std::move(cloud), options, report, context); });
  CapSize size;
  Cover caps =
      timed(times, "caps", [&] { return fit_caps(points, options, size, report, context); });
  if (caps.caps.empty()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("no surface goes with these {} points: no cap fits any of them; are "
                            "their normals right (rholm orient)?",
                            points.size()));
  }
  timed(times, "caps",
        [&] { note_crossings(points.crossings(size.noise, context), points.diagonal(), report); });
  Atlas& atlas = result.model.atlas;
  atlas.caps = std::move(caps.caps);
  atlas.coefficients = std::move(caps.coefficients);
  const Spacing spacing = points.spacing(context);
  atlas.spacing = spacing.median, atlas.noise = size.noise;
  atlas.diagonal = points.diagonal();
  atlas.blend = options.blend, atlas.band = kBandOfNoise * size.noise;
  report.caps = atlas.caps.size();
  report.spacing = spacing.median, report.noise = size.noise;
  report.normal_noise_degrees = size.normal_noise * 180 / std::numbers::pi;
  report.neighbours = size.neighbours;
  report.step = options.step;
  if (options.step == 0) {
    const double wanted = is_even(size, options) ? error_of_sparse(atlas) : typical_support(atlas);
    report.step = choose_step(spacing.fine, wanted, is_even(size, options));
  }

  std::optional<SeenSpace> seen;
  if (options.holes == HolePolicy::kFill) {
    seen = points.seen_space(kCubesOfSpacing * spacing.median,
                             kEndOfSight * std::max(spacing.median, size.noise), context);
  }
  const WallPatches patches = points.patches(context);
  if (!options.confidence) points.keep_tree();
  NotedSpacings noted;
  const Resolution resolution{.typical = std::max(spacing.median, report.step),
                              .at = [&](const Vec3& place) {
                                const double found = points.spacing_at(place);
                                noted.note(place, found);
                                return std::max(found, report.step);
                              }};
  const auto judge = [&](Mesh& mesh) {
    note_walls(check_walls(patches, mesh, report.step, context), report);
  };
  const AtlasSurfaceOptions wanted{.step = report.step,
                                   .keep_holes = options.holes == HolePolicy::kKeep,
                                   .min_component = options.min_component,
                                   .simplify = options.simplify,
                                   .resolution = &resolution,
                                   .seen = seen ? &*seen : nullptr,
                                   .judge = judge,
                                   .max_memory = options.max_memory,
                                   .memory_in_use = kMemoryOfPoint * points.size()};
  AtlasSurface surface =
      timed(times, "surface", [&] { return extract_atlas(atlas, wanted, context); });
  if (surface.mesh.triangles.empty()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("a grid with steps of {:.3g} finds no surface of these points, {:.3g} "
                            "apart, with a diagonal of {:.3g}: take smaller steps",
                            report.step, spacing.median, atlas.diagonal));
  }
  result.mesh = std::move(surface.mesh);
  report.holes = surface.holes, report.smooth_holes = surface.smooth_holes;
  report.cut_handles = surface.cut_handles;
  report.dropped_components = surface.dropped_components;
  report.faces = surface.faces, report.simplify_error = surface.simplify_error;
  report.memory = surface.memory;
  report.vertices = result.mesh.vertices.size();
  report.triangles = result.mesh.triangles.size();
  report.coefficients = atlas.coefficients.size();
  const Sizes sums =
      measure_sizes(view_of(result.mesh), unit_frame(bounds(result.mesh.vertices)), context);
  report.volume = sums.volume, report.area = sums.area, report.points_area = spacing.area;
  if (options.holes == HolePolicy::kFill) report.closed_area = surface.guessed * report.area;
  SurfaceRules rules = kept_rules(options);
  keep_spacings(noted.take(), rules);
  if (seen) rules.seen = seen->kept();
  timed(times, "attributes", [&] {
    points.carry_attributes(result.mesh, context);
    if (options.confidence) {
      put_areas(add_confidence(points.ordered(), result.mesh, context), report);
    }
  });
  rules.left_out = carried_names(result.mesh.attributes);
  result.model.rules = std::move(rules);
  result.model.step = report.step, result.model.tolerance = options.tolerance;
  result.model.input_numbers = 3 * report.points;
  result.model.method = "reconstruct";
  return result;
}

}  // namespace rholm
