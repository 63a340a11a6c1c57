#include "report/page/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/check_fields.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"
#include "transform/error/error_sites.h"

namespace rholm::report {
namespace {

constexpr int kRays = 20'000;  // chosen: the share of directions to a hundredth, in 20 ms

// Returns the result of a computation, or nothing where the surface does
// not exist (a gauge that is not positive, coordinates that overflow).
template <typename Function>
auto unless_refused(const Function& function) -> std::optional<decltype(function())> {
  try {
    return function();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalidInput) throw;
    return std::nullopt;
  }
}

// Measures errors at points of the shape, and by Parseval where it applies.
std::optional<TruncationErrors> measured_errors(ErrorSites& sites, const Expansion& expansion,
                                                int degree, bool predict, const Context& context) {
  if (degree > kHighestDrawn) return std::nullopt;
  return unless_refused([&] {
    return truncation_errors(cut_off(expansion, degree), {.predict = predict}, sites, context);
  });
}

DegreeRow row_of(int degree, const Expansion& expansion, const Data& data,
                 const std::optional<TruncationErrors>& errors) {
  DegreeRow row;
  row.degree = degree;
  if (errors) {
    row.rms = errors->rms;
    row.rms_is_exact = errors->rms_is_exact;
    row.max = errors->measured_max;
    row.max_distance = errors->measured_max_distance;
  }
  if (expansion.function != RadialFunction::kRadius) return row;
  // Figures measured at points are kept, unless an exact one exists.
  const RmsBeyond& beyond = data.beyond;
  const std::optional<double>& rms = beyond.rms[static_cast<std::size_t>(degree)];
  if (rms && (!row.rms || beyond.is_exact(degree))) {
    row.rms = rms;
    row.rms_is_exact = beyond.is_exact(degree);
  }
  if (!row.rms) row.rms_at_most = beyond.bound();
  return row;
}

}  // namespace

void check(const Mesh* shape, const ReportOptions& options) {
  check_fields(options);
  if (shape != nullptr && shape->faces.empty()) {
    throw Error(ErrorCode::kInvalidInput, "the shape has no face: there is nothing to draw");
  }
}

ShapeFigures shape_figures(const Mesh& mesh, const Vec3& center, double weld_tolerance,
                           const Context& context) {
  validate(mesh);
  ShapeFigures figures;
  figures.mesh = outward(mesh, weld_tolerance).welded.mesh;
  figures.mesh.attributes.clear();
  figures.inspection = inspect(figures.mesh);
  figures.star = check_star(figures.mesh, center, kRays, context);
  return figures;
}

bool may_be_of(const Expansion& expansion, const ShapeFigures& shape) {
  // Chosen: a format of floats rounds lengths to 6e-8, and twice that in their squares.
  constexpr double kSame = 1e-6;
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); };
  if (expansion.errors && expansion.errors->diagonal > 0 &&
      !same(shape.inspection.bounds.diagonal(), expansion.errors->diagonal)) {
    return false;
  }
  if (!expansion.norm_squared) return true;
  // Only a star-shaped surface has a norm.
  if (!shape.is_star()) return false;
  return expansion.function != RadialFunction::kRadius ||
         same(radius_norm_squared(view_of(shape.mesh), expansion.center), *expansion.norm_squared);
}

std::vector<int> degree_ladder(int degree) {
  std::vector<int> degrees;
  for (int l = 1; l < degree; l *= 2) degrees.push_back(l);
  degrees.push_back(degree);
  return degrees;
}

Expansion cut_off(const Expansion& expansion, int degree) {
  if (degree >= expansion.coefficients.degree()) return expansion;
  Expansion cut = expansion;
  cut.coefficients = expansion.coefficients.resized(degree);
  cut.errors.reset();
  return cut;
}

Data find_data(const Expansion& expansion, std::optional<ShapeFigures> shape,
               const Context& context) {
  const int degree = expansion.coefficients.degree();
  Data data;
  data.errors = expansion.errors;
  data.diagonal = expansion.errors ? expansion.errors->diagonal : 0;
  report_progress(context, "figures", 0);
  data.shape = std::move(shape);
  if (data.shape) data.diagonal = data.shape->inspection.bounds.diagonal();
  std::optional<ErrorSites> sites;  // shared by all degrees
  if (data.shape && data.shape->is_star()) {
    sites.emplace(view_of(data.shape->mesh), expansion.center, context.threads);
  }
  // Errors stored in the model were found with the precision of its coefficients.
  if (!data.errors && sites) {
    data.errors = measured_errors(*sites, expansion, degree, true, context);
  }
  data.energy = power_spectrum(expansion.coefficients);
  Expansion known = expansion;
  known.errors = data.errors;
  data.beyond = rms_beyond(known);
  data.rms = data.beyond.figures();
  for (const int l : degree_ladder(degree)) {
    std::optional<TruncationErrors> errors = l == degree ? data.errors : std::nullopt;
    if (l < degree && sites) errors = measured_errors(*sites, expansion, l, false, context);
    data.rows.push_back(row_of(l, expansion, data, errors));
  }
  if (degree <= kHighestDrawn) {
    data.model = unless_refused([&] { return measure(expansion, context); });
  }
  if (expansion.function == RadialFunction::kRadius && !expansion.signed_sum) {
    data.mean_radius = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  }
  return data;
}

}  // namespace rholm::report
