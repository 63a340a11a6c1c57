#include "transform/error/largest_radial.h"

#include <algorithm>

#include "transform/error/worst_points.h"

namespace rholm {
namespace {

// Number of places, apart from each other, where climbs begin (chosen: they take some
// milliseconds).
constexpr std::size_t kSites = 48;
// Number of points kept of a degree: other degrees err much there, too (chosen).
constexpr std::size_t kWorst = 24;

}  // namespace

ErrorPoints LargestRadial::worst(int degree) const {
  return peaks.points.subset(worst_apart(peaks.points, peaks.values, degree, kWorst));
}

LargestRadial largest_radial(const Expansion& expansion, const RadialModel& model,
                             const ErrorPoints& known, const std::vector<double>& values,
                             double rms, ErrorSites& sites, const Context& context) {
  LargestRadial found;
  found.value = largest(values);
  DensePoints dense =
      dense_points(sites.mesh(), sites.scan(), expansion, rms, found.value, context);
  found.seen = dense.seen;
  std::vector<double> errors = point_errors(dense.points, model, false, context).radial;
  ErrorPoints starts = std::move(dense.points);
  starts.append(known);
  errors.insert(errors.end(), values.begin(), values.end());
  const Context alone{.threads = 1};  // waking threads takes longer than some hundred points
  found.peaks = local_maxima(
      sites.mesh(), sites.center(), starts,
      {.values = errors,
       .error =
           [&](const ErrorPoints& at) { return point_errors(at, model, false, alone).radial; }},
      model.degree, kSites, {.threads = sites.threads()});
  found.value = std::max({found.value, largest(errors), largest(found.peaks.values)});
  return found;
}

}  // namespace rholm
