#include "fixed_nodes.h"

#include <vector>

#include "harmonic/legendre/order_sums.h"
#include "paper/monte_carlo/edge_terms.h"
#include "transform/methods/sources.h"
#include "transform/rules/bernstein_rules.h"

namespace rholm::paper {

Coefficients edge_rule_sum(const StarGeometry& geometry, int degree, int points,
                           const Context& context) {
  const FieldEdges field = field_edges(geometry);
  const GaussRule rule = gauss_legendre(points);
  const std::size_t per_edge = rule.nodes.size(), n = per_edge * field.edges.size();
  Coefficients sum(degree);
  OrderTable table;
  const std::size_t chunk = chunk_size(degree);
  for (std::size_t first = 0; first < n; first += chunk) {
    const std::size_t size = std::min(chunk, n - first);
    std::vector<Vec3> directions(size, Vec3{0, 0, 1});
    table.reset(degree, DirectionBlock(directions));
    parallel_for(size, 64, {.threads = context.threads}, {},
                 [&](std::size_t begin, std::size_t end) {
                   FieldScratch scratch;
                   std::vector<std::complex<double>> terms(degree + std::size_t{1});
                   for (std::size_t j = begin; j < end; ++j) {
                     const std::size_t edge = (first + j) / per_edge, node = (first + j) % per_edge;
                     const double t = (1 + rule.nodes[node]) / 2, weight = rule.weights[node] / 2;
                     directions[j] =
                         field_at(field, field.edges[edge], t, FieldStart::kNormal, terms, scratch);
                     for (int m = 0; m <= degree; ++m) {
                       table.re_row(m)[j] = weight * terms[m].real();
                       table.im_row(m)[j] = weight * terms[m].imag();
                     }
                   }
                 });
    const double part = static_cast<double>(first) / static_cast<double>(n);
    add_order_sums(DirectionBlock(directions), table, sum, context, {"transform", part, part});
  }
  return sum;
}

Coefficients triangle_rule_sum(const StarGeometry& geometry, int degree, int exactness,
                               const Context& context) {
  Sources sources({.degree = degree}, context);
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (face.degenerate || face.d == 0) continue;
    const std::array<Vec3, 3> p = geometry.corners(t);
    const double factor = face.d * norm(face.twice_area) / 2;
    visit_triangle_rule(exactness, [&](double a, double b, double c, double weight) {
      const Vec3 x = a * p[0] + b * p[1] + c * p[2];
      sources.add(x, weight * factor / dot(x, x));
    });
  }
  return sources.finish();
}

std::size_t triangle_rule_points(int exactness) {
  std::size_t points = 0;
  visit_triangle_rule(exactness, [&](double, double, double, double) { ++points; });
  return points;
}

}  // namespace rholm::paper
