#include "rholm/region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/refuse.h"
#include "edit/region/fading.h"
#include "edit/region/local_mesh.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Converts distances from the region, not positive inside, to weights.
std::vector<double> faded(std::vector<double> distance, double transition) {
  for (double& d : distance) d = d <= 0 ? 1 : transition > 0 ? fading(d / transition) : 0;
  return distance;
}

// Spreads known distances along the surface, in the part of the mesh within `reach` of a box.
std::vector<double> spread(const Mesh& mesh, std::vector<double> distance, const Bounds& box,
                           double reach) {
  const Vec3 margin = {reach, reach, reach};
  const LocalMesh local = cut_out(mesh, {box.min - margin, box.max + margin});
  std::vector<double> at(local.points.size(), kInfinity);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (const std::uint32_t v : local.members_of(i)) at[i] = std::min(at[i], distance[v]);
  }
  march(local, reach, at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (const std::uint32_t v : local.members_of(i)) distance[v] = at[i];
  }
  return distance;
}

void check_radius(double radius) {
  if (!(radius > 0) || !std::isfinite(radius)) {
    refuse(fmt::format("the radius of a region must be positive, not {:g}", radius));
  }
}

// Returns weights of a region in space; throws with the nearest distance if no vertex is inside.
template <class Distance>
std::vector<double> in_space(const Mesh& mesh, const Distance& distance_of, const char* kind,
                             double transition) {
  std::vector<double> distance(mesh.vertices.size());
  double least = kInfinity;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    distance[i] = distance_of(mesh.vertices[i]);
    least = std::min(least, distance[i]);
  }
  if (!(least <= 0)) {
    refuse(fmt::format("no vertex lies in the {}; the nearest is {:g} outside", kind, least));
  }
  return faded(std::move(distance), transition);
}

std::vector<double> weights_of(const Mesh& mesh, const BallRegion& ball, double transition) {
  check_radius(ball.radius);
  return in_space(
      mesh, [&](const Vec3& p) { return norm(p - ball.center) - ball.radius; }, "ball", transition);
}

std::vector<double> weights_of(const Mesh& mesh, const BoxRegion& box, double transition) {
  const auto outside = [](double x, double low, double high) {
    return std::max({0.0, low - x, x - high});
  };
  return in_space(
      mesh,
      [&](const Vec3& p) {
        return norm({outside(p.x, box.min.x, box.max.x), outside(p.y, box.min.y, box.max.y),
                     outside(p.z, box.min.z, box.max.z)});
      },
      "box", transition);
}

std::vector<double> weights_of(const Mesh& mesh, const DiscRegion& disc, double transition) {
  check_radius(disc.radius);
  if (disc.vertex >= mesh.vertices.size()) {
    refuse(fmt::format("there is no vertex {}: the mesh has {}, counted from 0", disc.vertex,
                       mesh.vertices.size()));
  }
  const Vec3& at = mesh.vertices[disc.vertex];
  std::vector<double> distance(mesh.vertices.size(), kInfinity);
  distance[disc.vertex] = 0;
  distance = spread(mesh, std::move(distance), {at, at}, disc.radius + transition);
  for (double& d : distance) d -= disc.radius;
  return faded(std::move(distance), transition);
}

// Returns weights for a set of vertices; distance is 0 in the set, infinite outside.
std::vector<double> around(const Mesh& mesh, std::vector<double> distance, double transition) {
  Bounds box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] > 0) continue;
    const Vec3& p = mesh.vertices[i];
    box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
    box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
  }
  return faded(spread(mesh, std::move(distance), box, transition), transition);
}

const Attribute& attribute(const Mesh& mesh, const std::string& name) {
  const Attribute* const found = find_attribute(mesh.attributes, name);
  if (found != nullptr) return *found;
  std::string names;
  for (const Attribute& a : mesh.attributes) names += (names.empty() ? "" : ", ") + a.name;
  refuse(fmt::format("the vertices have no property '{}'; they have {}", name,
                     names.empty() ? "none" : names));
}

std::vector<double> weights_of(const Mesh& mesh, const PropertyRegion& property,
                               double transition) {
  std::vector<double> values = attribute(mesh, property.name).values;
  bool mask = true, any = false;
  for (double& v : values) {
    mask = mask && (v == 0 || v == 1);
    v = v > 0 ? std::min(v, 1.0) : 0;  // NaN becomes 0
    any = any || v > 0;
  }
  if (!any) refuse(fmt::format("the property '{}' is nowhere above 0", property.name));
  if (!mask) return values;
  for (double& v : values) v = v > 0 ? 0 : kInfinity;
  return around(mesh, std::move(values), transition);
}

std::vector<double> weights_of(const Mesh& mesh, const ColorRegion& color, double transition) {
  std::vector<double> distance(mesh.vertices.size(), 0);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Attribute& channel = attribute(mesh, k == 0 ? "red" : k == 1 ? "green" : "blue");
    const bool parts = channel.type == ScalarType::kFloat32 || channel.type == ScalarType::kFloat64;
    const bool to_one = parts && std::all_of(channel.values.begin(), channel.values.end(),
                                             [](double v) { return v <= 1; });
    const double wanted = (color.rgb >> (16 - 8 * k)) & 0xff;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const double value = to_one ? 255 * channel.values[i] : channel.values[i];
      // The tolerance is half a step of 8 bits. NaN matches no colour.
      if (!(std::abs(value - wanted) <= 0.5)) distance[i] = kInfinity;
    }
  }
  if (std::find(distance.begin(), distance.end(), 0) == distance.end()) {
    refuse(fmt::format("no vertex has the color {:06x}", color.rgb));
  }
  return around(mesh, std::move(distance), transition);
}

}  // namespace

std::vector<double> region_weights(const Mesh& mesh, std::span<const Region> regions,
                                   double transition) {
  if (!(transition >= 0) || !std::isfinite(transition)) {
    refuse(fmt::format("the width of the transition must not be negative, it is {:g}", transition));
  }
  std::vector<double> rest(mesh.vertices.size(), 1);
  for (const Region& region : regions) {
    const std::vector<double> one =
        std::visit([&](const auto& r) { return weights_of(mesh, r, transition); }, region);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] *= 1 - one[i];
  }
  for (double& w : rest) w = 1 - w;
  return rest;
}

}  // namespace rholm
