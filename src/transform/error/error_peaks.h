// From the worst of the points at which errors are measured up to the local maxima around them:
// method 5.
#pragma once

#include <functional>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"

namespace rholm {

// Of points of the mesh: the error whose largest value is looked for.
using ErrorAt = std::function<std::vector<double>(const ErrorPoints&)>;

// The indices of the worst of n places that are at least 2/L apart, the worst first: of a place
// with several points all.
std::vector<std::size_t> worst_apart(const ErrorPoints& points, const std::vector<double>& values,
                                     int degree, std::size_t n);

struct PeakSearch {
  std::vector<double> values;  // the error at the points
  ErrorAt error;
};
// Of each search the largest value found on the faces around the worst points, at least that of the
// worst. `n_sites`: how many of them, apart from each other, are worst. Steps are a part of the
// waves of the degree.
std::vector<double> highest_peaks(const MeshView& mesh, const Vec3& center,
                                  const ErrorPoints& points,
                                  const std::vector<PeakSearch>& searches, int degree,
                                  std::size_t n_sites, const Context& context);

// Points of faces, and the errors there.
struct Peaks {
  ErrorPoints points;
  std::vector<double> values;
};
// Climbs from the worst points to the top, on their faces and on those around, along edges as well:
// where climbs ended, among them the local maxima that are highest, to 1e-4 of their heights.
Peaks local_maxima(const MeshView& mesh, const Vec3& center, const ErrorPoints& points,
                   const PeakSearch& search, int degree, std::size_t n_sites,
                   const Context& context);

}  // namespace rholm
