#include "surface/field/atlas_dipoles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "base/parallel.h"
#include "shape/points/point_tree.h"

namespace rholm {
namespace {

constexpr double kMostPoints = 20000;  // per cap: limits memory for extreme resolutions
constexpr double kLeastShare = 1e-3;   // least share of a foot point's area; the others are skipped

struct Feet {
  std::vector<Vec3> points, normals;
  std::vector<double> areas;
  std::vector<double> own;  // blend weight of the foot point's own cap
};

// Places foot points on a cap: a sunflower pattern of equal areas in the tangent plane of the
// seed, carried along the rays. An area dA in the plane becomes dA (R_0 / q)^3 (r / R_0)^2 /
// (n . u) on the surface. Here q is the distance from the centre to the point in the plane.
Feet feet_of(const Cap& cap, std::span<const double> coefficients, double spacing) {
  const CapFrame& f = cap.frame;
  const double radius =
      std::min(f.support, std::hypot(cap.where.px, cap.where.py) + longer_half_axis(cap.where));
  const double wanted = std::numbers::pi * radius * radius / (spacing * spacing);
  const auto n = static_cast<std::size_t>(std::ceil(std::clamp(wanted, 1.0, kMostPoints)));
  CapPoints plane;
  for (std::size_t k = 0; k < n; ++k) {
    const double r = radius * std::sqrt((static_cast<double>(k) + 0.5) / static_cast<double>(n));
    const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
    plane.add(
        (cap.where.px + r * std::cos(angle)) * f.x + (cap.where.py + r * std::sin(angle)) * f.y,
        f.z, 1);
  }
  plane.pad();
  const std::size_t stride = plane.padded();
  std::vector<double> at(3 * stride), across(3 * stride);
  cap_surface(cap, coefficients, plane, at, across);
  const double area = std::numbers::pi * radius * radius / static_cast<double>(n);
  Feet feet;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 offset{at[k], at[stride + k], at[2 * stride + k]};
    const Vec3 normal{across[k], across[stride + k], across[2 * stride + k]};
    const double rest = 1 - place(cap, offset);
    if (!(rest > 0)) continue;  // also skips rays that miss the surface
    const Vec3 ray = offset + f.radius * f.z;
    const Vec3 straight = plane.offset(k) + f.radius * f.z;
    const double facing = dot(normal, ray) / norm(ray);
    if (!(facing > 0.1)) continue;  // on steeper rays rounding errors dominate the area
    const double q = f.radius / norm(straight), r = norm(ray) / f.radius;
    feet.points.push_back(f.seed() + offset);
    feet.normals.push_back(normal);
    feet.areas.push_back(area * q * q * q * r * r / facing);
    feet.own.push_back(cap.weight * rest * rest * rest);
  }
  return feet;
}

}  // namespace

AtlasDipoles spread_dipoles(const Atlas& atlas, double spacing, double band,
                            const Context& context) {
  std::vector<Feet> feet(atlas.caps.size());
  parallel_for(feet.size(), 16, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      feet[c] = feet_of(atlas.caps[c], atlas.coefficients_of(atlas.caps[c]), spacing);
    }
  });
  AtlasDipoles dipoles;
  std::vector<Vec3> points;
  for (const Feet& own : feet) points.insert(points.end(), own.points.begin(), own.points.end());
  if (points.empty()) return dipoles;
  // Sums the weights of all caps at all foot points, in the tree's order.
  const PointTree tree(points, context);
  std::vector<Vec3> ordered;
  for (const std::uint32_t i : tree.order()) ordered.push_back(points[i]);
  std::vector<CapWeights> of_caps(atlas.caps.size());
  parallel_for(of_caps.size(), 16, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      of_caps[c] =
          weights_of(atlas.caps[c], atlas.coefficients_of(atlas.caps[c]), tree, ordered, band);
    }
  });
  std::vector<double> weights(points.size());
  for (const CapWeights& own : of_caps) {
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      weights[tree.order()[own.samples[i]]] += own.weights[i];
    }
  }
  std::size_t next = 0;
  for (std::size_t c = 0; c < feet.size(); ++c) {
    for (std::size_t i = 0; i < feet[c].points.size(); ++i, ++next) {
      const double share = feet[c].own[i] / std::max(weights[next], feet[c].own[i]);
      if (share < kLeastShare) continue;
      const Vec3& normal = feet[c].normals[i];
      dipoles.feet.push_back(
          {feet[c].points[i], normal, std::min(spacing, atlas.caps[c].frame.support)});
      dipoles.points.push_back(feet[c].points[i]);
      dipoles.area_normals.push_back(share * feet[c].areas[i] * normal);
    }
  }
  return dipoles;
}

}  // namespace rholm
