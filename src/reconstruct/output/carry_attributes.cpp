#include "reconstruct/output/carry_attributes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

void carry_attributes(const PointTree& tree, std::span<const Attribute> attributes, Mesh& mesh,
                      const Context& context) {
  const std::size_t n = mesh.vertices.size(), first = mesh.attributes.size();
  for (const Attribute& attribute : attributes) {
    mesh.attributes.push_back({attribute.name, attribute.type, std::vector<double>(n)});
  }
  if (mesh.attributes.size() == first) return;
  parallel_for(n, 1024, context, {.name = "attributes"}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    std::vector<double> weights;
    const auto blended = [&](const Attribute& attribute) {
      // A scanner may write no number where it has no value: only the other points count.
      double value = 0, sum = 0;
      for (std::size_t j = 0; j < near.size(); ++j) {
        const double own = attribute.values[tree.order()[near[j].index]];
        if (!std::isfinite(own)) continue;
        value += weights[j] * own;
        sum += weights[j];
      }
      return value / sum;
    };
    for (std::size_t v = begin; v < end; ++v) {
      tree.nearest(mesh.vertices[v], kCircle, near);
      // The weight of method 7.5, its support a little beyond the farthest.
      const double support2 = 1.3 * std::max(1e-300, static_cast<double>(near.back().distance2));
      weights.clear();
      for (const Neighbor& p : near) {
        const double rest = 1 - p.distance2 / support2;
        weights.push_back(rest * rest * rest);
      }
      for (std::size_t a = 0; a < attributes.size(); ++a) {
        mesh.attributes[first + a].values[v] = blended(attributes[a]);
      }
    }
  });
  // Values keep to their type: whole numbers stay whole, floats floats.
  for (std::size_t a = first; a < mesh.attributes.size(); ++a) {
    Attribute& attribute = mesh.attributes[a];
    if (attribute.type == ScalarType::kFloat64) continue;
    const bool real = attribute.type == ScalarType::kFloat32;
    for (double& value : attribute.values) {
      value = real ? static_cast<double>(static_cast<float>(value)) : std::round(value);
    }
  }
}

}  // namespace rholm
