// Computes the gauge q = 1/r by integrals over the arcs of the edges alone:
//   c_lm(q) = 1/(2 - l(l+1)) sum_e s_e int_arc conj(Y_lm) ds,  l != 1      (M4).
// Degree 1 has a closed form (M5).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compensated_sum.h"
#include "rholm/error.h"
#include "transform/methods/methods.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

// Smallest distance of a face's plane from the centre, as a part of the radius. Below it, the gauge
// is beyond what double precision can sum with the other faces: 1/d against 1/r, squared in the
// norm.
constexpr double kSmallestSlope = 1e-12;

void check_planes(const StarGeometry& geometry) {
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (!face.degenerate && std::abs(face.d) < kSmallestSlope) {
      throw Error(ErrorCode::kInvalidInput,
                  "the plane of face " + std::to_string(t) +
                      " passes through the centre, where the gauge 1/r is not defined: choose "
                      "another centre, or the method edge");
    }
  }
}

Vec3 degree_one(const StarGeometry& geometry) {
  CompensatedSum x, y, z;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (face.degenerate) continue;
    const Vec3 a = face.twice_area / (norm(face.twice_area) * face.d);
    const Vec3 v = second_moment(geometry.corners(t), face.solid_angle, a);
    x.add(v.x);
    y.add(v.y);
    z.add(v.z);
  }
  return {x.value(), y.value(), z.value()};
}

struct ArcJumps {
  std::vector<EdgeJump> of_edge;
  double total = 0;   // sum of |s_e| times the arcs
  double square = 0;  // sum of the squares of s_e times the arcs
};

ArcJumps jumps_of(const StarGeometry& geometry) {
  ArcJumps jumps;
  jumps.of_edge.reserve(geometry.chart->edges.size());
  for (const Edge& edge : geometry.chart->edges) {
    const EdgeJump jump = edge_jump(geometry, edge);
    jumps.of_edge.push_back(jump);
    jumps.total += std::abs(jump.jump) * jump.angle;
    jumps.square += std::pow(jump.jump * jump.angle, 2);
  }
  return jumps;
}

// Equals divided_allowance() of the radius, with |2 - l(l+1)| >= 2/3 l(l+1) from l = 2 on. On an
// arc, low degrees lose nothing that degree L does not lose.
Allowance arc_allowance(const MethodOptions& options, double total) {
  const double root = std::sqrt(4 * std::numbers::pi);
  return {.allowed = options.allowed / std::max(total, 1e-300),
          .first = 0,
          .last = 1.5 / (root * std::max(options.degree, 1)),
          .degree = options.degree,
          .growth = Growth::kArc};
}

// Half of the error may come from the sums, because the rules of the other half are generous. Sums
// of squares count each edge as one node. Dividing by l(l+1) - 2 brings generic sums down to 1 /
// sqrt(4 pi).
AdjointNeeds sum_needs(const MethodOptions& options, const ArcJumps& jumps) {
  const double root = std::sqrt(4 * std::numbers::pi);
  const double generic = 1.5 * std::sqrt(std::max(jumps.square, 1e-300)) / root;
  return {.degree = options.degree,
          .engine = options.engine,
          .allowed = 0.5 * options.allowed / generic,
          .sources = 4 * jumps.of_edge.size()};
}

// Adds int_arc conj(Y) ds times the jump, for the arc that begins at p. Arcs too long for one rule
// are cut into equal parts.
void add_arc(const Vec3& p, const EdgeJump& jump, const Allowance& allowance, Sources& sources) {
  const Vec3 q = cross(jump.normal, p);
  int parts = 1, exactness = 0;
  while ((exactness = exactness_for(allowance, jump.angle / (2 * parts), 1)) == 0) parts *= 2;
  const GaussRule& rule = segment_rule(exactness);
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double s = (part + rule.nodes[i]) / parts * jump.angle;
      sources.add(std::cos(s) * p + std::sin(s) * q,
                  rule.weights[i] / parts * jump.angle * jump.jump);
    }
  }
}

// Divides by 2 - l(l+1). Degree 1, where this divisor is 0, becomes 0.
void divide_by_eigenvalue_of_gauge(Coefficients& c) {
  for (int l = 0; l <= c.degree(); ++l) {
    const double factor = l == 1 ? 0.0 : 1 / (2 - static_cast<double>(l) * (l + 1));
    for (int m = 0; m <= l; ++m) {
      c.c(l, m) *= factor;
      c.s(l, m) *= factor;
    }
  }
}

void set_degree_one(const StarGeometry& geometry, Coefficients& c) {
  const Vec3 v = std::sqrt(3 / (4 * std::numbers::pi)) * degree_one(geometry);
  c.c(1, 0) = v.z;
  c.c(1, 1) = v.x;
  c.s(1, 1) = v.y;
}

}  // namespace

MethodResult gauge_method(const StarGeometry& geometry, const MethodOptions& options,
                          const Context& context) {
  check_planes(geometry);
  const auto& edges = geometry.chart->edges;
  const ArcJumps jumps = jumps_of(geometry);
  const Allowance allowance = arc_allowance(options, jumps.total);
  Sources sources(sum_needs(options, jumps), context);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeJump& jump = jumps.of_edge[e];
    if (jump.jump == 0) continue;
    sources.set_progress(static_cast<double>(e) / static_cast<double>(edges.size()));
    add_arc(normalized(geometry.vertices[edges[e].a]), jump, allowance, sources);
  }
  MethodResult result;
  result.edge_nodes = sources.count();
  result.coefficients = sources.finish();
  divide_by_eigenvalue_of_gauge(result.coefficients);
  if (options.degree >= 1) set_degree_one(geometry, result.coefficients);
  return result;
}

}  // namespace rholm
