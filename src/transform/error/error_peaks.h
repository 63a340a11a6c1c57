// Climbs from the worst points at which errors are measured to the local maxima around them: method
// 5.
#pragma once

#include <functional>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"

namespace rholm {

// Returns, at points of the mesh, the error whose largest value is searched.
using ErrorAt = std::function<std::vector<double>(const ErrorPoints&)>;

// Returns the indices of the worst points at n places that are at least 2/L apart, the worst first.
// If a place has several points, it returns all of them.
std::vector<std::size_t> worst_apart(const ErrorPoints& points, const std::vector<double>& values,
                                     int degree, std::size_t n);

struct PeakSearch {
  std::vector<double> values;  // the error at the points
  ErrorAt error;
};
// Returns for each search the largest value on the faces of the worst points, or the worst value if
// that is larger. `n_sites` is the number of worst points, which are apart from each other. Steps
// are a part of the waves of the degree.
std::vector<double> highest_peaks(const MeshView& mesh, const Vec3& center,
                                  const ErrorPoints& points,
                                  const std::vector<PeakSearch>& searches, int degree,
                                  std::size_t n_sites, const Context& context);

// Points on faces, and the errors there.
struct Peaks {
  ErrorPoints points;
  std::vector<double> values;
};
// Climbs from the worst points to the top, on their faces and the faces around, also along edges.
// Returns where climbs ended, among them the highest local maxima, to 1e-4 of their heights.
Peaks local_maxima(const MeshView& mesh, const Vec3& center, const ErrorPoints& points,
                   const PeakSearch& search, int degree, std::size_t n_sites,
                   const Context& context);

}  // namespace rholm
