#include "model/atlas/atlas_errors.h"

#include <algorithm>
#include <cmath>

#include "rholm/compare.h"
#include "surface/star/area_samples.h"

namespace rholm {

AtlasErrors measure(const Mesh& shape, const Mesh& surface, std::size_t samples,
                    const Context& context) {
  const Comparison found = compare(shape, surface, {.samples = samples}, context);
  return {found.a_to_b.rms, found.a_to_b.max, found.b_to_a.rms, found.b_to_a.max};
}

AtlasErrors measure(const std::vector<Vec3>& points, const Mesh& surface, const Context& context) {
  AtlasErrors errors;
  for (const double d : distances_to_surface(points, surface, context)) {
    errors.rms_from += d * d;
    errors.max_from = std::max(errors.max_from, d);
  }
  errors.rms_from = std::sqrt(errors.rms_from / static_cast<double>(points.size()));
  return errors;
}

// Searches from points inside the solid are slow and of no use, because the surface is equally far
// in many directions. Distances back are measured from samples of the surface alone.
AtlasErrors measure(const std::vector<Vec3>& outer, const Mesh& shape, const Mesh& surface,
                    std::size_t samples, const Context& context) {
  AtlasErrors errors = measure(outer, surface, context);
  const AtlasErrors back =
      measure(sample_by_area(surface, samples, CompareOptions{}.seed).points, shape, context);
  errors.rms_to = back.rms_from, errors.max_to = back.max_from;
  return errors;
}

}  // namespace rholm
