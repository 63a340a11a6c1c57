// From a star chart to its coefficients. Layer: transform.
//
// Source: Mousa, Chaine, Akkouche, Galin 2007 ("the paper"), corrected and extended:
// docs/method.md, whose equations (M1)-(M8) are cited.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/star.h"

namespace rholm {

enum class Method {
  kEdge,   // r by integrals over flat edges and faces, divided by l(l+1), (M6)
  kGauge,  // q = 1/r by integrals over the arcs of the edges alone, (M4)-(M5)
  kCurl,   // r by the paper's field, made right, (M1)-(M3): slow, edges only
  kArea    // r by cubature of r dOmega over the faces
};
const char* to_string(Method method);          // "edge", "gauge", "curl", "area"
Method parse_method(const std::string& name);  // throws InvalidInput

struct AnalyzeOptions {
  int degree = 64;  // L, 0 ... kMaxDegree
  Method method = Method::kEdge;
  // Wanted error of the coefficients 1 <= l <= L: l2 norm of the error / norm of the function
  // without its mean; for c_00 relative to c_00. 1e-14 ... 1e-1. Rounding adds about 1e-15 c_00
  // times the largest r / d_T.
  double precision = 1e-10;
};

struct Analysis {
  Expansion expansion;
  std::size_t edge_nodes = 0;  // quadrature nodes on edges
  std::size_t face_nodes = 0;  // and on faces
  // |sum_e s_e int_arc u ds| / sum_e |s_e| int_arc ds: zero for a closed, consistently
  // oriented mesh, whatever its shape; free check of mesh and orientation, (M5).
  double closure_residual = 0;
  // Exact truncation error over solid angle, sqrt(||f - f_L||^2 / 4 pi), in the unit of f;
  // none if the surface is not star-shaped, for there (M7) is not the norm.
  std::optional<double> truncation_rms;
};

// Throws InvalidInput for a degree or precision out of range, a centre on a vertex, or (gauge) a
// face seen edge on.
Analysis analyze(const StarChart& chart, const AnalyzeOptions& options = {},
                 const Context& context = {});

// int r^2 dOmega and int q^2 dOmega of a star-shaped surface in closed form, (M7).
double radius_norm_squared(const StarChart& chart);
double gauge_norm_squared(const StarChart& chart);

// S = sum_e int_e (r^2 s_e)^2 ds for the radius, sum_e int_e s_e^2 ds for the gauge: the energy
// per degree is about S / (pi l^4) beyond the mesh's own resolution, method 5.
double tail_strength(const StarChart& chart, RadialFunction function);

}  // namespace rholm
