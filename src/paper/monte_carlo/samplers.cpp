#include "paper/monte_carlo/samplers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "paper/monte_carlo/spherical_triangle.h"

namespace rholm {
namespace {

// Returns a random number of a sample. Numbers run through places first, so that more samples do
// not change earlier ones.
double random_of(std::uint64_t seed, std::size_t places, std::size_t place, std::size_t sample,
                 int which) {
  return random_uniform(seed, 2 * (sample * places + place) + static_cast<std::uint64_t>(which));
}

struct SampledFace {
  SphericalTriangle triangle;
  Vec3 n;  // n and d are turned so that n . u > 0; the weight has the sign
  double d = 0;
  double weight = 0;  // solid angle, signed
  double largest_radius = 0;
};

std::vector<SampledFace> sampled_faces(const StarGeometry& geometry) {
  std::vector<SampledFace> faces;
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (face.degenerate || face.d == 0 || face.solid_angle == 0) continue;
    std::array<Vec3, 3> p = geometry.corners(t);
    const double side = face.d < 0 ? -1 : 1;
    if (side < 0) std::swap(p[1], p[2]);
    faces.push_back({.triangle = spherical_triangle(p, std::abs(face.solid_angle)),
                     .n = (side / norm(face.twice_area)) * face.twice_area,
                     .d = side * face.d,
                     .weight = face.solid_angle,
                     .largest_radius = std::max({norm(p[0]), norm(p[1]), norm(p[2])})});
  }
  return faces;
}

// Draws r times the solid angle, and its cosines and sines of m phi.
Vec3 draw_in(const SampledFace& face, double along, double across, SampleScratch& scratch) {
  const Vec3 u = uniform_direction(face.triangle, along, across);
  // Rounding may put u slightly outside of a face seen nearly edge on.
  const double r = std::min(face.largest_radius, face.d / std::max(dot(face.n, u), 1e-300));
  const double s = std::hypot(u.x, u.y);
  const std::complex<double> turn = s > 0 ? std::complex<double>(u.x / s, u.y / s) : 1.0;
  std::complex<double> term = face.weight * r;
  for (std::complex<double>& out : scratch.terms) {
    out = term;
    term *= turn;
  }
  return u;
}

}  // namespace

Sampler edge_sampler(const StarGeometry& geometry, std::uint64_t seed, FieldStart start) {
  FieldEdges field = field_edges(geometry);
  const std::size_t places = field.edges.size();
  return {.places = places,
          .draw = [field = std::move(field), places, seed, start](
                      std::size_t place, std::size_t sample, SampleScratch& scratch) {
            const double t = random_of(seed, places, place, sample, 0);
            return field_at(field, field.edges[place], t, start, scratch.terms, scratch.field);
          }};
}

Sampler triangle_sampler(const StarGeometry& geometry, std::uint64_t seed) {
  std::vector<SampledFace> faces = sampled_faces(geometry);
  const std::size_t places = faces.size();
  return {.places = places,
          .draw = [faces = std::move(faces), places, seed](std::size_t place, std::size_t sample,
                                                           SampleScratch& scratch) {
            return draw_in(faces[place], random_of(seed, places, place, sample, 0),
                           random_of(seed, places, place, sample, 1), scratch);
          }};
}

}  // namespace rholm
