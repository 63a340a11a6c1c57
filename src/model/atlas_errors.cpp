#include "model/atlas_errors.h"

#include <algorithm>
#include <cmath>

#include "rholm/compare.h"

namespace rholm {

AtlasErrors measure(const Mesh& shape, const Mesh& surface, std::size_t samples,
                    const Context& context) {
  const Comparison found = compare(shape, surface, {.samples = samples}, context);
  return {found.a_to_b.rms, found.a_to_b.max, found.b_to_a.rms, found.b_to_a.max};
}

AtlasErrors measure(const std::vector<Vec3>& outer, const Mesh& shape, const Mesh& surface,
                    std::size_t samples, const Context& context) {
  const AtlasErrors back = measure(shape, surface, samples, context);
  AtlasErrors errors = measure(outer, surface, context);
  errors.rms_to = back.rms_to, errors.max_to = back.max_to;
  return errors;
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

}  // namespace rholm
