// From the worst of the points at which errors are measured up to the local maxima around them:
// method 5.
#pragma once

#include <functional>
#include <vector>

#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"

namespace rholm {

// Of points of the mesh: the error whose largest value is looked for.
using ErrorAt = std::function<std::vector<double>(const ErrorPoints&)>;

// The largest value found on the faces around the worst points, at least that of the worst.
// `values`: the error at the points; `n_sites`: how many of them, apart from each other, are worst.
// Steps are a part of the waves of the degree.
double highest_peak(const MeshView& mesh, const Vec3& center, const ErrorPoints& points,
                    const std::vector<double>& values, int degree, std::size_t n_sites,
                    const ErrorAt& error);

}  // namespace rholm
