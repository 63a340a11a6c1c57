// Computes coefficients of the radius by edges and faces, face by face as in (M8). By (M6):
//   l(l+1) c_lm = sum_e W_e <conj Y>_e + sum_T F_T <conj Y>_T,   <> = flat mean,
//   W_e = (a x b) . (n_left/d_left - n_right/d_right),   F_T = -2 |T| / d_T.
// Faces seen at a grazing angle have large W and F that cancel, and so have large faces near the
// centre. These faces are taken out of the sum. Their int r conj(Y) dOmega is added without the
// division by l(l+1). The divided sum gets the terms of Green's formula that neighbours would have
// cancelled (method 3e):
//   - int_0^1 (a x b) . grad conj(Y)(x/|x|) dt  per half-edge a -> b.
// So all terms stay bounded, also for d_T = 0.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "harmonic/coefficients/laplacian.h"
#include "transform/geometry/star_geometry.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

enum class FaceKind { kNone, kFlat, kGrazing };

// `allowed` is the rounding error that a face may have.
FaceKind kind_of(const StarGeometry& geometry, std::size_t t, double allowed) {
  const FaceGeometry& face = geometry.faces[t];
  if (face.degenerate) return FaceKind::kNone;
  if (kWeightRounding * norm(face.twice_area) > allowed * std::abs(face.d)) {
    return FaceKind::kGrazing;
  }
  double nearest = INFINITY;
  for (const Vec3& corner : geometry.corners(t)) nearest = std::min(nearest, norm(corner));
  return std::abs(face.d) < kGrazingSlope * nearest ? FaceKind::kGrazing : FaceKind::kFlat;
}

// Weights of the terms of the divided sum: means over faces and edges, gradient terms of edges.
struct Weights {
  std::vector<FaceKind> kind;
  std::vector<double> of_face;      // F_T
  std::vector<double> of_edge;      // W_e
  std::vector<double> of_gradient;  // sign of -(a x b) . grad; 0: no such term
  double total = 0;                 // sum of the moduli, as they enter the error
};

Weights weights_of(const StarGeometry& geometry, double allowed) {
  Weights w;
  const auto& edges = geometry.chart->edges;
  const auto n_faces = static_cast<double>(geometry.faces.size());
  w.kind.resize(geometry.faces.size());
  w.of_face.assign(geometry.faces.size(), 0.0);
  w.of_edge.assign(edges.size(), 0.0);
  w.of_gradient.assign(edges.size(), 0.0);
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    w.kind[t] = kind_of(geometry, t, allowed / std::sqrt(n_faces));
    if (w.kind[t] == FaceKind::kFlat) {
      w.of_face[t] = -norm(geometry.faces[t].twice_area) / geometry.faces[t].d;
    }
    w.total += std::abs(w.of_face[t]);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    const Vec3 across = cross(geometry.vertices[edge.a], geometry.vertices[edge.b]);
    const auto add_side = [&](std::uint32_t t, double side) {
      const FaceGeometry& face = geometry.faces[t];
      if (w.kind[t] == FaceKind::kFlat) {
        w.of_edge[e] += side * dot(across, face.twice_area) / (norm(face.twice_area) * face.d);
      } else if (w.kind[t] == FaceKind::kGrazing) {
        w.of_gradient[e] += side;
      }
    };
    add_side(edge.left, 1);
    add_side(edge.right, -1);
    w.total += std::abs(w.of_edge[e]);
    if (w.of_gradient[e] != 0) {
      // A gradient is up to sqrt(l(l+1)) times the harmonic. Against the division by l(l+1) this
      // costs a factor of at most sqrt(2) at low degrees. |x| is at least the distance.
      const double r = segment_distance(geometry.vertices[edge.a], geometry.vertices[edge.b]);
      w.total += 2 * norm(across) / std::max(r, 1e-300);
    }
  }
  return w;
}

// The error E(p; l) of each mean enters c_lm divided by l(l+1). With E(p; l) <= E(p; 1) +
// (l/L)^2 E(p; L) the l2 norm over all degrees is at most
//   E(p; 1) sqrt(sum (2l+1)/(4 pi l^2 (l+1)^2)) + E(p; L) sqrt(sum (2l+1)/(4 pi L^4))
//   <= (E(p; 1) + E(p; L) / L) / sqrt(4 pi).
Allowance divided_allowance(double allowed, double weight, int degree) {
  const double root = std::sqrt(4 * std::numbers::pi);
  return {.allowed = allowed / std::max(weight, 1e-300),
          .first = 1 / root,
          .last = 1 / (root * std::max(degree, 1)),
          .degree = degree,
          .growth = Growth::kFlat};
}

// Returns the sum over edges with a gradient term of -+ (a x b)/|x| . grad_S conj(Y)(u), up to
// degree L.
Coefficients gradient_terms(const StarGeometry& geometry, const Weights& w,
                            const MethodOptions& options, const Allowance& allowance,
                            std::size_t& nodes, const Context& context) {
  std::vector<Vec3> directions, vectors;
  const auto& edges = geometry.chart->edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (w.of_gradient[e] == 0) continue;
    const Vec3& a = geometry.vertices[edges[e].a];
    const Vec3& b = geometry.vertices[edges[e].b];
    const Vec3 across = -w.of_gradient[e] * cross(a, b);
    visit_segment(a, b, allowance, segment_distance, [&](const Vec3& x, double weight) {
      const double r = norm(x);
      directions.push_back(x / r);
      vectors.push_back((weight / r) * across);
    });
  }
  Coefficients sum(options.degree);
  const Context silent{.threads = context.threads};
  if (!directions.empty())
    add_adjoint({.directions = directions, .gradients = vectors}, sum, {.engine = Engine::kDirect},
                silent);
  nodes += directions.size();
  return sum;
}

void add(Coefficients& to, const Coefficients& from) {
  for (std::size_t i = 0; i < to.values().size(); ++i) to.values()[i] += from.values()[i];
}

// Returns int r conj(Y) dOmega over the grazing faces.
Coefficients grazing_faces(const StarGeometry& geometry, const Weights& w,
                           const MethodOptions& options, std::size_t& nodes,
                           const Context& context) {
  double weight = 0;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    if (w.kind[t] == FaceKind::kGrazing) weight += radius_weight(geometry, t);
  }
  const Context silent{.threads = context.threads};
  Sources sources({.degree = options.degree}, silent);
  if (weight > 0) {
    const Allowance allowance = undivided_allowance(options.allowed / 4, weight, options.degree);
    for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
      if (w.kind[t] != FaceKind::kGrazing) continue;
      visit_radius(geometry, t, allowance,
                   [&](const Vec3& x, double rdomega) { sources.add(x, rdomega); });
    }
  }
  nodes += sources.count();
  return sources.finish();
}

}  // namespace

MethodResult edge_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context) {
  const Weights w = weights_of(geometry, options.allowed / 2);
  const Allowance allowance = divided_allowance(options.allowed / 2, w.total, options.degree);
  const auto& edges = geometry.chart->edges;
  const double work = static_cast<double>(edges.size() + geometry.faces.size());
  MethodResult result;
  Sources sources({.degree = options.degree}, context);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (w.of_edge[e] == 0) continue;
    sources.set_progress(static_cast<double>(e) / work);
    visit_segment(geometry.vertices[edges[e].a], geometry.vertices[edges[e].b], allowance,
                  segment_distance,
                  [&](const Vec3& x, double weight) { sources.add(x, weight * w.of_edge[e]); });
  }
  result.edge_nodes = sources.count();
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    if (w.of_face[t] == 0) continue;
    sources.set_progress(static_cast<double>(edges.size() + t) / work);
    visit_triangle(geometry.corners(t), allowance,
                   [&](const Vec3& x, double weight) { sources.add(x, weight * w.of_face[t]); });
  }
  result.face_nodes = sources.count() - result.edge_nodes;
  result.coefficients = sources.finish();
  add(result.coefficients,
      gradient_terms(geometry, w, options, allowance, result.edge_nodes, context));
  divide_by_eigenvalue(result.coefficients);
  add(result.coefficients, grazing_faces(geometry, w, options, result.face_nodes, context));
  result.coefficients.c(0, 0) = radius_mean_coefficient(geometry, options.mean_allowed);
  return result;
}

}  // namespace rholm
