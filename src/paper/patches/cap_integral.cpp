// r dOmega of flat triangles is d_T dS / |x|, and the dilation multiplies dOmega by the square of
// its conformal factor d theta' / d theta = sin theta' / sin theta.
#include "paper/patches/cap_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "chart/cap/cap_frame.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "shape/points/plane_fit.h"
#include "transform/geometry/star_geometry.h"
#include "transform/methods/methods.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

using Corners = std::array<Vec3, 3>;

struct Face {
  Corners corners;
  double density = 0;  // d_T |T|: the factor of a mean over the triangle, for dS d_T
  double omega = 0;    // solid angle
};

void check(const CapFrame& frame, const CapIntegralOptions& options) {
  if (options.degree < 0 || options.degree > kMaxIntegralDegree) {
    throw Error(ErrorCode::kInvalidInput,
                "the degree of a patch is " + std::to_string(options.degree) +
                    "; it must be 0 ... " + std::to_string(kMaxIntegralDegree));
  }
  if (!(options.precision >= 1e-14 && options.precision <= 0.1)) {
    throw Error(ErrorCode::kInvalidInput, "the precision of a patch is " +
                                              std::to_string(options.precision) +
                                              "; it must be 1e-14 ... 0.1");
  }
  if (!(frame.radius > 0) || !std::isfinite(frame.radius) || !(frame.dilation > 0) ||
      !std::isfinite(frame.dilation) || !is_finite(frame.center)) {
    throw Error(ErrorCode::kInvalidInput, "a patch's sphere has the radius " +
                                              std::to_string(frame.radius) + " and the dilation " +
                                              std::to_string(frame.dilation) +
                                              "; both must be above 0 and finite");
  }
}

Corners corners_of(const CapFrame& frame, const PatchMesh& patch, std::size_t t) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = patch.faces[t][k];
    if (v >= patch.points.size()) {
      throw Error(ErrorCode::kInvalidInput, "triangle " + std::to_string(t) + " has the corner " +
                                                std::to_string(v) + " of " +
                                                std::to_string(patch.points.size()) + " points");
    }
    corners[k] = in_frame(frame, patch.points[v]);
    // At lengths far from the sphere's radius, squares would overflow or underflow.
    const double length = norm(corners[k]);
    if (!(length > 1e-100 && length < 1e100)) {
      throw Error(ErrorCode::kInvalidInput,
                  "point " + std::to_string(v) + " is " + std::to_string(length) +
                      " radii of the patch's sphere from its centre; take another sphere");
    }
  }
  return corners;
}

std::vector<Face> faces_of(const CapFrame& frame, const PatchMesh& patch) {
  std::vector<Face> faces;
  for (std::size_t t = 0; t < patch.faces.size(); ++t) {
    Face face{.corners = corners_of(frame, patch, t)};
    const auto& [a, b, c] = face.corners;
    face.density = dot(a, cross(b - a, c - a)) / 2;
    face.omega = solid_angle(face.corners);
    if (face.density < 0 && face.omega < 0) {
      throw Error(ErrorCode::kNotStarShaped,
                  "triangle " + std::to_string(t) + " of a patch (solid angle " +
                      std::to_string(face.omega) +
                      ") turns its outer side to the centre; split the patch");
    }
    if (face.density > 0 && face.omega > 0) faces.push_back(face);
  }
  return faces;
}

// Returns a bound of the conformal factor on a triangle. The factor is monotone in cos theta, which
// differs from a corner's value by at most the longest edge.
double largest_factor(const CapFrame& frame, const Corners& corners) {
  if (frame.dilation == 1) return 1;
  double low = 1, high = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 u = normalized(corners[k]), v = normalized(corners[(k + 1) % 3]);
    low = std::min(low, u.z - norm(u - v));
    high = std::max(high, u.z + norm(u - v));
  }
  return std::max(conformal_factor(frame.dilation, std::clamp(low, -1.0, 1.0)),
                  conformal_factor(frame.dilation, std::clamp(high, -1.0, 1.0)));
}

// Estimates int r dOmega' over the triangles.
double total_weight(const CapFrame& frame, const std::vector<Face>& faces) {
  double total = 0;
  for (const Face& face : faces) {
    double radius = 0;
    for (const Vec3& corner : face.corners) radius = std::max(radius, norm(corner));
    const double factor = largest_factor(frame, face.corners);
    total += face.omega * radius * factor * factor;
  }
  return total;
}

// Calls visit(direction on the dilated sphere, weight of r dOmega', r) for the nodes of a face.
template <typename Visit>
void visit_nodes(const CapFrame& frame, const Face& face, const Allowance& allowance,
                 const Visit& visit) {
  // The dilation makes harmonics vary faster on a triangle by the conformal factor.
  Allowance own = allowance;
  const double factor = std::max(1.0, largest_factor(frame, face.corners));
  own.degree = static_cast<int>(std::ceil(std::min(1e9, allowance.degree * factor)));
  visit_triangle(face.corners, own, [&](const Vec3& x, double w) {
    const Vec3 u = normalized(x);
    const double conformal = conformal_factor(frame.dilation, u.z);
    visit(dilated(frame.dilation, u), w * face.density / dot(x, x) * conformal * conformal,
          norm(x));
  });
}

}  // namespace

CapFrame patch_frame(const PatchSphere& seen, std::span<const Vec3> points, double opened) {
  CapFrame frame;
  frame.center = seen.sphere.center;
  frame.radius = seen.sphere.radius;
  frame.z = seen.axis;
  frame.x = perpendicular(seen.axis);
  frame.y = cross(frame.z, frame.x);
  double half_angle = 0;
  for (const Vec3& p : points) {
    frame.support = std::max(frame.support, norm(p - frame.seed()));
    const Vec3 u = normalized(in_frame(frame, p));
    half_angle = std::max(half_angle, std::atan2(std::hypot(u.x, u.y), u.z));
  }
  if (opened > 0 && opened < std::numbers::pi && half_angle > 0 && half_angle < opened) {
    frame.dilation = dilation_between(half_angle, opened);
  }
  return frame;
}

CapIntegral cap_integral(const CapFrame& frame, const PatchMesh& patch,
                         const CapIntegralOptions& options, const Context& context) {
  check(frame, options);
  CapIntegral result;
  const std::vector<Face> faces = faces_of(frame, patch);
  result.coefficients = Coefficients(options.degree);
  if (faces.empty() && options.extension == CapExtension::kZero) return result;

  const double weight = total_weight(frame, faces);
  const Allowance allowance =
      undivided_allowance(options.precision * weight, weight, options.degree);
  for (const Face& face : faces) {
    result.solid_angle += face.omega;
    visit_nodes(frame, face, allowance, [&](const Vec3&, double, double) { ++result.nodes; });
  }
  Sources sources({.degree = options.degree,
                   .engine = Engine::kFast,
                   .allowed = options.precision,
                   .sources = result.nodes},
                  context);
  for (std::size_t t = 0; t < faces.size(); ++t) {
    sources.set_progress(static_cast<double>(t) / static_cast<double>(faces.size()));
    visit_nodes(frame, faces[t], allowance, [&](const Vec3& u, double w, double r) {
      // If the sphere itself extends the patch, the function is r - R_0.
      sources.add(u, options.extension == CapExtension::kZero ? w : w * (1 - 1 / r));
    });
  }
  result.coefficients = sources.finish();
  if (options.extension == CapExtension::kSphere) {
    result.coefficients.c(0, 0) += std::sqrt(4 * std::numbers::pi);
  }
  for (double& value : result.coefficients.values()) value *= frame.radius;
  return result;
}

CapErrors cap_errors(const CapFrame& frame, const Coefficients& coefficients,
                     std::span<const Vec3> points, const Context& context) {
  std::vector<Vec3> directions;
  directions.reserve(points.size());
  for (const Vec3& p : points) {
    directions.push_back(dilated(frame.dilation, normalized(in_frame(frame, p))));
  }
  CapErrors errors;
  errors.along_rays = evaluate(coefficients, directions, {}, context);
  // Relative to the largest error, squares neither overflow nor underflow.
  for (std::size_t i = 0; i < points.size(); ++i) {
    double& error = errors.along_rays[i];
    error = norm(points[i] - frame.center) - error;
    errors.max = std::max(errors.max, std::abs(error));
  }
  if (!(errors.max > 0)) return errors;
  double squares = 0;
  for (const double e : errors.along_rays) squares += (e / errors.max) * (e / errors.max);
  errors.sum = errors.max * std::sqrt(squares);
  errors.rms = errors.sum / std::sqrt(static_cast<double>(points.size()));
  return errors;
}

}  // namespace rholm
