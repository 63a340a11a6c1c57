// Geometry of faces and edges for the transforms, in coordinates scaled to about 1.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "base/rounding.h"
#include "rholm/coefficients.h"
#include "rholm/star.h"

namespace rholm {

struct FaceGeometry {
  Vec3 twice_area;          // normal of length 2 |T|
  double d = 0;             // d_T, signed distance of its plane from the centre
  double solid_angle = 0;   // signed
  bool degenerate = false;  // has no area: its solid angle is 0
};

struct StarGeometry {
  const StarChart* chart = nullptr;
  double scale = 1;  // a power of two: lengths here = scale * lengths of the chart
  std::vector<Vec3> vertices;
  std::vector<FaceGeometry> faces;

  std::array<Vec3, 3> corners(std::size_t t) const {
    const Triangle& triangle = chart->mesh.faces[t];
    return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
  }
};

// Returns the power of two that brings lengths seen from the centre to about 1. Throws InvalidInput
// outside 1e-150 ... 1e150, or for a coordinate that is not finite.
double unit_scale(const MeshView& mesh, const Vec3& center, const Context& context);

// Throws InvalidInput for a chart whose size is outside 1e-150 ... 1e150.
StarGeometry star_geometry(const StarChart& chart);

// Returns the signed solid angle of a triangle seen from the origin (Van Oosterom, Strackee 1983).
double solid_angle(const std::array<Vec3, 3>& corners);

// Below this d_T / r, terms of (M6) may be large and cancel (method 3c).
inline constexpr double kGrazingSlope = 0.25;

// Rounding error of a coefficient, for each unit of 2 |T| / d_T. In (M6) a face and its edges are
// four terms of up to that size, which cancel where the face is large and near.
inline constexpr double kWeightRounding = 4 * rounding_of_sum(8) / (2 / std::numbers::inv_sqrtpi);

// Returns the d_T / r below which a face is taken out of (M6) and summed by bounded terms (method
// 3e). These terms have gradients, which count gradient_as_weight() times as much in the window
// error of the fast sums. So terms of (M6), about r / d_T, may be larger by that factor.
double grazing_slope(int degree);

// M_T v = int_T u (u . v) dOmega
//       = (Omega/3) v - (1/6) sum_edges (nu (w.v) + w (nu.v)), (M5), nu = -N.
Vec3 second_moment(const std::array<Vec3, 3>& corners, double omega, const Vec3& v);

// Jump s_e = (a_left - a_right) . N of an edge, a_T = n_T/d_T, N = a x b / |a x b|, and its arc. A
// face without area, or seen exactly edge on, takes no part: it counts as a_T = 0.
struct EdgeJump {
  double jump = 0;
  double angle = 0;  // angle of the arc
  Vec3 normal;       // N; zero if the ends are in one direction
};
EdgeJump edge_jump(const StarGeometry& geometry, const Edge& edge);

// Returns |sum_e s_e int_arc u ds| / sum_e |s_e| int_arc ds, (M5).
double closure_residual(const StarGeometry& geometry);

// Mean over directions and sqrt(int (f - mean)^2 dOmega) for f = r or 1/r, by a rule of four points
// per face (degree 1: corners and centroid). They give the scale of a wanted precision and are not
// results.
struct MeanAndNorm {
  double mean = 0;
  double norm = 0;
};
MeanAndNorm mean_and_norm(const StarGeometry& geometry, RadialFunction function);

}  // namespace rholm
