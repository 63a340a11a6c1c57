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

}  // namespace rholm
