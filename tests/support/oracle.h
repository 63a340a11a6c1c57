// Slow, plain cubature over the flat faces of a star-shaped mesh: the reference for all methods.
// Its nodes and weights are independent of the library's.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "harmonic/legendre/legendre_kernels.h"
#include "rholm/harmonic.h"
#include "rholm/transform.h"

namespace rholm::test {

// Calls visit(x, dOmega) for n x n Gauss nodes x per face, in coordinates that are collapsed at the
// first corner of the face.
template <typename Visit>
void visit_oracle_nodes(const Mesh& mesh, int n, const Visit& visit) {
  const GaussRule rule = gauss_legendre(n);
  for (const Triangle& t : mesh.faces) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const double s = (1 + rule.nodes[i]) / 2, v = (1 + rule.nodes[k]) / 2;
        const Vec3 across = (1 - v) * b + v * c;
        const Vec3 x = a + s * (across - a);
        const double r = norm(x);
        // dOmega = x . (dx/ds x dx/dv) / r^3 ds dv
        visit(x, dot(x, cross(across - a, s * (c - b))) / (r * r * r) * rule.weights[i] *
                     rule.weights[k] / 4);
      }
    }
  }
}

inline double value_at(const Vec3& x, RadialFunction function) {
  return function == RadialFunction::kRadius ? norm(x) : 1 / norm(x);
}

// Returns int f conj(Y) dOmega.
inline Coefficients oracle_coefficients(const Mesh& mesh, int degree, RadialFunction function,
                                        int n) {
  Coefficients sum(degree);
  std::vector<Vec3> directions;
  std::vector<double> weights;
  visit_oracle_nodes(mesh, n, [&](const Vec3& x, double solid) {
    directions.push_back(x / norm(x));
    weights.push_back(value_at(x, function) * solid);
  });
  add_adjoint({.directions = directions, .weights = weights}, sum, {.engine = Engine::kDirect});
  return sum;
}

// Adds the coefficients of one order m only, which is cheap at high degrees.
inline void add_oracle_order(const Mesh& mesh, int m, RadialFunction function, int n,
                             Coefficients& sum) {
  std::vector<double> x, s, re, im;
  visit_oracle_nodes(mesh, n, [&](const Vec3& point, double solid) {
    const Vec3 u = point / norm(point);
    const double w = value_at(point, function) * solid;
    const double phi = std::atan2(u.y, u.x);
    x.push_back(u.z);
    s.push_back(std::hypot(u.x, u.y));
    re.push_back(w * std::cos(m * phi));
    im.push_back(w * std::sin(m * phi));
  });
  const std::size_t padded = (x.size() + kLegendreLanes - 1) / kLegendreLanes * kLegendreLanes;
  x.resize(padded, 0.0);
  s.resize(padded, 1.0);
  re.resize(padded, 0.0);
  im.resize(padded, 0.0);
  const int degree = sum.degree();
  std::vector<double> c(degree + 1, 0.0), sn(degree + 1, 0.0);
  legendre_adjoint(legendre_order(m, degree, legendre_mu(degree)[m]), x.data(), s.data(), padded,
                   re.data(), im.data(), c.data(), sn.data());
  for (int l = m; l <= degree; ++l) {
    sum.c(l, m) = c[l - m];
    if (m > 0) sum.s(l, m) = sn[l - m];
  }
}

// Returns the l2 norm of the difference over 1 <= l <= L, relative to the norm of `b` without b_00.
inline double relative_error(const Coefficients& a, const Coefficients& b) {
  double difference = 0, norm = 0;
  for (int l = 1; l <= b.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      difference += std::pow(a.c(l, m) - b.c(l, m), 2) + std::pow(a.s(l, m) - b.s(l, m), 2);
      norm += std::pow(b.c(l, m), 2) + std::pow(b.s(l, m), 2);
    }
  }
  return std::sqrt(difference / norm);
}

inline StarChart chart_about(const Mesh& mesh, const Vec3& center) {
  return make_star_chart(mesh,
                         {.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0}});
}

}  // namespace rholm::test
