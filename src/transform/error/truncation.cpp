#include "rholm/truncation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "shape/vertex_range.h"
#include "transform/error/distance_check.h"
#include "transform/error/error_peaks.h"
#include "transform/error/error_points.h"
#include "transform/error/error_sites.h"
#include "transform/norms/parseval.h"

namespace rholm {
namespace {

// sqrt(||f - f_L||^2 / 4 pi), if the error of the coefficients leaves a hundredth of it.
std::optional<double> parseval_rms(const Expansion& expansion, double precision) {
  if (!expansion.norm_squared) return std::nullopt;
  const double norm_squared = *expansion.norm_squared;
  const CoefficientErrors errors =
      coefficient_errors(norm_squared, expansion.coefficients, precision, precision);
  return rms_of(parseval_rest(norm_squared, expansion.coefficients, errors), 50);
}

void predict(const Expansion& expansion, ErrorSites& sites, TruncationErrors& errors) {
  if (!shows_its_edges(sites.mesh(), expansion.coefficients.degree())) return;
  const ErrorStrengths& strengths = sites.strengths();
  const double per = 1 / (2 * std::numbers::pi * (expansion.coefficients.degree() + 1.0));
  if (expansion.function == RadialFunction::kRadius) errors.predicted_max = strengths.radius * per;
  errors.predicted_max_distance = strengths.distance * per;
}

// Enough for smooth meshes, whose points are dense; climbs cost as much as a hundredth of a whole
// analysis.
constexpr std::size_t kPeaks = 3;

// The largest errors between points. Of distances those from the shape to the model: to the shape
// they are to the planes of faces, which are not the faces.
void climb(const ErrorPoints& points, const PointErrors& found, const Expansion& expansion,
           double precision, ErrorSites& sites, TruncationErrors& errors) {
  const Context context{.threads = 1};  // waking others takes longer than a hundred points
  const int degree = expansion.coefficients.degree();
  const auto highest = [&](const std::vector<double>& values, bool slopes) {
    return highest_peak(
        sites.mesh(), sites.center(), points, values, degree, kPeaks, [&](const ErrorPoints& at) {
          PointErrors there = point_errors(at, expansion, degree, slopes, precision, context);
          return slopes ? std::move(there.to_model) : std::move(there.radial);
        });
  };
  errors.measured_max = std::max(*errors.measured_max, highest(found.radial, false));
  errors.measured_max_distance =
      std::max(*errors.measured_max_distance, highest(found.to_model, true));
}

// Distances by closest points where those to first order may mislead.
void refine_distances(const ErrorPoints& points, const PointErrors& found,
                      const Expansion& expansion, double precision, const Context& context,
                      ErrorSites& sites, TruncationErrors& errors) {
  const int degree = expansion.coefficients.degree();
  if (!may_be_refined(sites.mesh(), expansion, *errors.measured_max, errors.diagonal)) return;
  const std::size_t extreme = points.size() - sites.over_area().size();
  if (!is_coarse(sites.mesh())) {
    const SecondOrder second = second_order(points, found, extreme, expansion, degree, precision);
    if (second.first_order_holds()) return;
    if (second.suffices(sites.mesh())) {
      *errors.distance_rms *= second.rms_ratio;
      *errors.measured_max_distance *= second.max_ratio;
      errors.distances_are_closest = true;
      return;
    }
  }
  const SurfaceDistances distances =
      sites.closest(true).measure(expansion, degree, points.first(extreme), precision, context);
  errors.distance_rms = distances.rms;
  errors.measured_max_distance = distances.max;
  errors.distances_are_closest = true;
}

}  // namespace

TruncationErrors truncation_errors(const MeshView& mesh, const Expansion& expansion,
                                   const TruncationOptions& options, const Context& context) {
  validate(mesh);
  ErrorSites sites(mesh, expansion.center);
  return truncation_errors(expansion, options, sites, context);
}

TruncationErrors truncation_errors(const Expansion& expansion, const TruncationOptions& options,
                                   ErrorSites& sites, const Context& context) {
  TruncationErrors errors;
  errors.diagonal = diagonal_of(sites.mesh());
  const int degree = expansion.coefficients.degree();
  const Context silent{.threads = context.threads};
  // A ten thousandth of the truncation error would do; it is not known yet.
  const double precision = std::clamp(options.precision, 1e-12, 1e-6);
  report_progress(context, "errors", 0);
  // Those over the area for the largest errors too: at a degree too low for any face to be long the
  // middle of one may err more than its corners.
  const ErrorPoints& points = sites.all(degree);
  const std::size_t extreme = points.size() - sites.over_area().size();
  const PointErrors found = point_errors(points, expansion, degree, true, precision, silent);
  errors.points = points.size();
  errors.measured_max = largest(found.radial);
  errors.measured_max_distance = std::max(largest(found.to_model), largest(found.to_shape));
  errors.distance_rms = rms_distance(found, extreme);
  errors.rms = rms_over_solid_angle(points, found, extreme);
  if (expansion.function == RadialFunction::kRadius) {
    if (const std::optional<double> exact = parseval_rms(expansion, options.precision)) {
      errors.rms = exact;
      errors.rms_is_exact = true;
    }
  }
  climb(points, found, expansion, precision, sites, errors);
  refine_distances(points, found, expansion, precision, silent, sites, errors);
  report_progress(context, "errors", 0.9);
  if (options.predict) predict(expansion, sites, errors);
  return errors;
}

}  // namespace rholm
